// diptych: the fields of both panels on one set of cells
// SPDX-License-Identifier: LGPL-2.1-or-later
#include "coupling/fields/cell_fields.h"

#include <cmath>

#include "coupling/cells/cell_overlap.h"
#include "coupling/fields/continuum_averaging.h"
#include "coupling/fields/strain_increment.h"

namespace diptych::coupling
{
  namespace
  {
    // Adds the continuum's affine fit at the cells' centres, which GrainFields has for the grains.
    void add_kinematics(const StagePair &stage, CellFields &fields)
    {
      LocalMotion moved         = local_motion(displacement_field(stage.nodes_from, stage.nodes_to), cell_centres(fields.mesh),
                                               strain_radius(stage.grains_to.mean_diameter));
      fields.continuum_gradient = std::move(moved.gradient);
      fields.continuum_shear    = std::move(moved.shear);
      fields.continuum_spin     = std::move(moved.spin);
      fields.continuum_relative = std::move(moved.relative_rotation);
    }

    QuadMesh grid_over(const QuadMesh &mesh, const double size)
    {
      Eigen::Vector2d lower = mesh.node[0], upper = lower;
      for (const Eigen::Vector2d &x : mesh.node)
        {
          lower = lower.cwiseMin(x);
          upper = upper.cwiseMax(x);
        }
      return regular_grid(lower, upper, size);
    }

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

    SampleScale scale_of(const StagePair &stage)
    {
      return {stage.grains_to.mean_diameter, period_of(stage.grains_to)};
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
      StressPair              pair{grains.stress,
                      averaged_continuum({on_mesh.mesh, on_mesh.own}, grid, scale_of(stage), averaging, &overlap).stress,
                      grains.stress_standard_error};
      for (std::size_t k = 0; k < inside.size(); ++k)
        if (!inside[k])
          pair.grains[k].setConstant(NAN);
      return stress_difference(grid, pair);
    }
  } // namespace

  std::vector<Eigen::Matrix2d> strain_increments(const std::vector<Eigen::Matrix2d> &displacement_gradient)
  {
    std::vector<Eigen::Matrix2d> strain;
    for (const Eigen::Matrix2d &g : displacement_gradient)
      strain.push_back(-0.5 * (g + g.transpose()));
    return strain;
  }

  CellFields mesh_fields(const QuadMesh &mesh, const StagePair &stage, const AveragingOptions &averaging)
  {
    CellFields fields;
    fields.mesh      = mesh;
    fields.grains    = grain_fields(mesh, stage.grains_from, stage.grains_to, averaging, /* judge_nodes */ true);
    fields.own       = continuum_fields(stage.nodes_from, stage.nodes_to);
    fields.continuum = averaged_continuum({fields.mesh, fields.own}, fields.mesh, scale_of(stage), averaging);
    add_kinematics(stage, fields);
    return fields;
  }

  CellFields grid_fields(const CellFields &on_mesh, const StagePair &stage, const AveragingOptions &averaging, const double size)
  {
    CellFields fields;
    fields.mesh   = grid_over(on_mesh.mesh, size);
    fields.grains = grain_fields(fields.mesh, stage.grains_from, stage.grains_to, averaging);
    const OwnFields   own{on_mesh.mesh, on_mesh.own};
    const CellOverlap overlap = cell_overlap(fields.mesh, on_mesh.mesh);
    fields.own                = averaged_continuum(own, fields.mesh, scale_of(stage), {}, &overlap);
    fields.continuum          = averaged_continuum(own, fields.mesh, scale_of(stage), averaging, &overlap);
    add_kinematics(stage, fields);
    for (std::size_t k = 0; k < fields.mesh.cell.size(); ++k)
      if (!fields.own.stress[k].allFinite()) // the cell lies outside the mesh, where a fit would extrapolate and a kernel would
                                             // fade
        {
          fields.continuum_shear[k] = fields.continuum_spin[k] = fields.continuum.dissipation[k] = NAN;
          fields.continuum.rotation_increment[k] = fields.continuum_relative[k] = NAN;
          fields.continuum_gradient[k].setConstant(NAN);
          fields.continuum.stress[k].setConstant(NAN);
          fields.continuum.couple_stress[k].setConstant(NAN);
          fields.continuum.displacement_increment[k].setConstant(NAN);
        }
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
