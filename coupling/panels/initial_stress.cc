// diptych: the prepared grains' stress as the continuum's initial stress
// SPDX-License-Identifier: LGPL-2.1-or-later
#include "coupling/panels/initial_stress.h"

#include "coupling/averaging/cell_cover.h"
#include "coupling/averaging/periodic.h"
#include "coupling/averaging/segments.h"

namespace diptych::coupling
{
  std::vector<Eigen::Matrix2d> grain_stress_on_cells(const discrete::Snapshot  &grains,
                                                     const continuum::Snapshot &nodes,
                                                     const double               pressure)
  {
    const QuadMesh     mesh   = quad_mesh(nodes);
    const MappedMoment mapped = map_grains(mesh, grains).moment;
    const CellCover    cover  = grain_cover(mesh, grains);

    std::vector<Eigen::Matrix2d> stress = cell_stress(mesh, mapped);
    for (std::size_t k = 0; k < stress.size(); ++k)
      if (cover.covered[k])
        stress[k] = (0.5 * (stress[k] + stress[k].transpose())).eval();
      else
        stress[k] = pressure * Eigen::Matrix2d::Identity();
    return stress;
  }

  std::vector<double> grain_solid_fraction_on_cells(const discrete::Snapshot &grains, const continuum::Snapshot &nodes)
  {
    const CellCover     cover    = grain_cover(quad_mesh(nodes), grains);
    std::vector<double> fraction = cover.solid_fraction;
    for (std::size_t k = 0; k < fraction.size(); ++k)
      if (!cover.covered[k])
        fraction[k] = cover.typical_solid_fraction;
    return fraction;
  }
} // namespace diptych::coupling
