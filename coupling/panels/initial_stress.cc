// diptych: initial stress of the continuum from the prepared grains
// SPDX-License-Identifier: LGPL-2.1-or-later
#include "coupling/panels/initial_stress.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "coupling/averaging/cell_cover.h"
#include "coupling/averaging/periodic.h"
#include "coupling/averaging/segments.h"
#include "coupling/cells/bin_grid.h"
#include "coupling/panels/continuum_mesh.h"
#include "coupling/panels/processes.h"

namespace diptych::coupling
{
  namespace
  {
    double mean_diameter(const discrete::Snapshot &grains)
    {
      return 2 * std::accumulate(grains.radius.begin(), grains.radius.end(), 0.) / double(grains.radius.size());
    }

    // Cells without an edge on the mesh's rim, because the rim runs between grains; all cells if there are no others.
    std::vector<bool> inner_cells(const QuadMesh &mesh)
    {
      std::vector<bool> inside(mesh.cell.size(), true);
      for (const BoundaryEdge &edge : boundary_edges(mesh))
        inside[mesh.triangle[edge.triangle].cell] = false;
      if (std::find(inside.begin(), inside.end(), true) == inside.end())
        inside.assign(inside.size(), true);
      return inside;
    }

    BinGrid binned(const std::vector<Eigen::Vector2d> &points, const double size)
    {
      Eigen::Vector2d lower = points.front(), upper = points.front();
      for (const Eigen::Vector2d &x : points)
        {
          lower = lower.cwiseMin(x);
          upper = upper.cwiseMax(x);
        }
      BinGrid bins(lower, upper, size);
      bins.sort(points.size(), [&](const std::size_t k, const auto &put) { put(bins.bin_of(points[k])); });
      return bins;
    }

    void scale_to(const double mean, const std::vector<double> &area, std::vector<double> &values)
    {
      const double sum = std::inner_product(values.begin(), values.end(), area.begin(), 0.);
      const double by  = mean * std::accumulate(area.begin(), area.end(), 0.) / sum;
      for (double &value : values)
        value *= by;
    }
  } // namespace

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
    const QuadMesh            mesh    = quad_mesh(nodes);
    const CellCover           cover   = grain_cover(mesh, grains);
    const std::vector<double> area    = cell_areas(mesh);
    const std::vector<bool>   inside  = inner_cells(mesh);
    const auto                centres = cell_centres(mesh);
    const double              sigma = 0.5 * solid_fraction_width * mean_diameter(grains), reach = 3 * sigma;
    const BinGrid             bins = binned(centres, sigma);
    const Eigen::Vector2d     corner(reach, reach);
    std::vector<double>       fraction(centres.size(), cover.typical_solid_fraction);
    for (std::size_t k = 0; k < centres.size(); ++k)
      {
        double sum = 0, weights = 0;
        bins.for_each_in(bins.range(centres[k] - corner, centres[k] + corner), [&](const std::size_t other) {
          if (!cover.covered[other] || !inside[other])
            return;
          const double weight = area[other] * std::exp(-(centres[other] - centres[k]).squaredNorm() / (2 * sigma * sigma));
          sum += weight * cover.solid_fraction[other];
          weights += weight;
        });
        if (weights > 0)
          fraction[k] = sum / weights;
      }
    scale_to(solid_fraction(grains), area, fraction);
    return fraction;
  }

  void map_initial_state(const continuum::Options &options,
                         const double              pressure,
                         const discrete::Snapshot *grains,
                         continuum::Panel         &panel)
  {
    if (options.initial_stress == continuum::InitialStress::mapped)
      {
        const continuum::Snapshot    nodes = panel.snapshot();
        std::vector<Eigen::Matrix2d> stress;
        on_first_process([&] {
          stress = grain_stress_on_cells(*grains, nodes, pressure);
          return 0;
        });
        panel.set_initial_stress(stress);
      }
    const continuum::LawOptions &law = options.material;
    if (continuum::follows_solid_fraction(law.hardening) && !law.solid_fraction_start)
      {
        const continuum::Snapshot nodes = panel.snapshot();
        std::vector<double>       fraction;
        on_first_process([&] {
          fraction = grain_solid_fraction_on_cells(*grains, nodes);
          return 0;
        });
        panel.set_initial_solid_fraction(fraction);
      }
  }
} // namespace diptych::coupling
