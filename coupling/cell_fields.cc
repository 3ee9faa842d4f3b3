// diptych: every field of both panels on one set of cells
// SPDX-License-Identifier: LGPL-2.1-or-later
#include "coupling/cell_fields.h"

#include <cmath>

#include "coupling/cell_overlap.h"
#include "coupling/strain_increment.h"

namespace diptych::coupling
{
  namespace
  {
    // The affine fit at the cells' centres that GrainFields has of the grains.
    void add_kinematics(const StagePair &stage, CellFields &fields)
    {
      std::vector<Eigen::Vector2d> centres;
      for (unsigned int k = 0; k < fields.mesh.cell.size(); ++k)
        centres.push_back(cell_centre(fields.mesh, k));
      const auto gradient = displacement_gradient(displacement_field(stage.nodes_from, stage.nodes_to), centres,
                                                  strain_radius(stage.grains_to.mean_diameter));
      for (const Eigen::Matrix2d &g : gradient)
        {
          fields.continuum_shear.push_back(std::hypot(g(0, 0) - g(1, 1), g(0, 1) + g(1, 0)));
          fields.continuum_spin.push_back(0.5 * (g(1, 0) - g(0, 1)));
        }
    }

    QuadMesh grid_over(const QuadMesh &mesh, const double size)
    {
      Eigen::Vector2d lower = mesh.node[0], upper = lower;
      for (const Eigen::Vector2d &x : mesh.node)
        lower = lower.cwiseMin(x), upper = upper.cwiseMax(x);
      return regular_grid(lower, upper, size);
    }

    ContinuumFields carried(const CellOverlap &overlap, const ContinuumFields &fields)
    {
      const Eigen::Matrix2d no_tensor = Eigen::Matrix2d::Constant(NAN);
      const Eigen::Vector2d no_vector = Eigen::Vector2d::Constant(NAN);
      return {carried_over<Eigen::Matrix2d>(overlap, fields.stress, no_tensor),
              carried_over<Eigen::Vector2d>(overlap, fields.couple_stress, no_vector),
              carried_over<Eigen::Vector2d>(overlap, fields.displacement_increment, no_vector),
              carried_over<double>(overlap, fields.rotation_increment, NAN),
              carried_over<double>(overlap, fields.dissipation, NAN)};
    }

    // Whether a cell lies in the mesh to at least nine tenths.
    std::vector<bool> mostly_inside(const CellOverlap &overlap)
    {
      std::vector<bool> inside;
      for (std::size_t row = 0; row + 1 < overlap.begin.size(); ++row)
        {
          double area = 0;
          for (std::size_t k = overlap.begin[row]; k < overlap.begin[row + 1]; ++k)
            area += overlap.area[k];
          inside.push_back(area >= 0.9 * overlap.row_area[row]);
        }
      return inside;
    }

    StressDifference difference_on_grid(const CellFields       &on_mesh,
                                        const StagePair        &stage,
                                        const AveragingOptions &averaging,
                                        const double            size)
    {
      const QuadMesh          grid    = grid_over(on_mesh.mesh, size);
      const CellOverlap       overlap = cell_overlap(grid, on_mesh.mesh);
      const std::vector<bool> inside  = mostly_inside(overlap);
      const GrainFields       grains  = grain_fields(grid, stage.grains_from, stage.grains_to, averaging);
      const Eigen::Matrix2d   none    = Eigen::Matrix2d::Constant(NAN);
      StressPair              pair{grains.stress, carried_over<Eigen::Matrix2d>(overlap, on_mesh.continuum.stress, none),
                      grains.stress_standard_error};
      for (std::size_t k = 0; k < inside.size(); ++k)
        if (!inside[k])
          pair.grains[k] = none;
      return stress_difference(grid, pair);
    }
  } // namespace

  CellFields mesh_fields(const QuadMesh &mesh, const StagePair &stage, const AveragingOptions &averaging)
  {
    CellFields fields;
    fields.mesh      = mesh;
    fields.grains    = grain_fields(mesh, stage.grains_from, stage.grains_to, averaging);
    fields.continuum = continuum_fields(stage.nodes_from, stage.nodes_to);
    add_kinematics(stage, fields);
    return fields;
  }

  CellFields grid_fields(const CellFields &on_mesh, const StagePair &stage, const AveragingOptions &averaging, const double size)
  {
    CellFields fields;
    fields.mesh      = grid_over(on_mesh.mesh, size);
    fields.grains    = grain_fields(fields.mesh, stage.grains_from, stage.grains_to, averaging);
    fields.continuum = carried(cell_overlap(fields.mesh, on_mesh.mesh), on_mesh.continuum);
    add_kinematics(stage, fields);
    for (std::size_t k = 0; k < fields.mesh.cell.size(); ++k)
      if (!fields.continuum.stress[k].allFinite()) // outside the mesh the fit would extrapolate
        fields.continuum_shear[k] = fields.continuum_spin[k] = NAN;
    return fields;
  }

  std::vector<StressDifference> stress_differences(const CellFields       &on_mesh,
                                                   const StagePair        &stage,
                                                   const AveragingOptions &averaging)
  {
    StressDifference cells = stress_difference(
      on_mesh.mesh, {on_mesh.grains.stress, on_mesh.continuum.stress, on_mesh.grains.stress_standard_error});
    cells.label = "cells";
    std::vector<StressDifference> differences{cells};
    for (const int diameters : {3, 6})
      {
        differences.push_back(difference_on_grid(on_mesh, stage, averaging, diameters * stage.grains_to.mean_diameter));
        differences.back().label = std::to_string(diameters) + " d";
      }
    return differences;
  }
} // namespace diptych::coupling
