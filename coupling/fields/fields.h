// diptych: the grains' fields on cells between two stages, all by the same averaging
// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <cstdint>
#include <cmath>
#include <vector>

#include <Eigen/Core>

#include "coupling/averaging/averaging.h"
#include "coupling/averaging/cell_cover.h"
#include "coupling/cells/mesh_cells.h"
#include "discrete/snapshot.h"

namespace diptych::coupling
{
  // Each vector has n_cells entries. A value is NaN where grains cover less than half of a cell (CellCover) or the field has no
  // weight. <q> is the mean over the grains of a cell, weighted by their shares in it. Tensors are positive in compression.
  struct GrainFields
  {
    // Mean over the window of `to`, since the preceding snapshot. Unsymmetric: row index = force [pressure]. The dynamic part of
    // the stress is -<spin term> 1 (Moreau 1997). A kinetic (streaming) stress is not included.
    std::vector<Eigen::Matrix2d> stress, contact_stress; // with and without the dynamic part
    // Couple stress (averaging/carriers.h) [pressure * length]. It is power-conjugate to the gradient of the grains' rotation, as
    // the stress is to that of displacement. Mechanics uses the opposite sign.
    std::vector<Eigen::Vector2d> couple_stress;
    std::vector<double>          dissipation; // by friction, over the window, per area [pressure]; NaN: not known

    // At the instant of `to`. velocity = <m v> / <m>; granular temperature = <m |v'|^2 / 2> / <m> [velocity^2]. Rattlers are
    // included. |v'|^2 / 2 is taken about the affine motion around each grain, see fluctuation_energy() in grain_kinematics.h.
    std::vector<Eigen::Vector2d> velocity;
    std::vector<double>          granular_temperature;

    // From `from` to `to`. A grain that is a rattler at either instant counts in none of these fields. The mean displacement and
    // rotation are weighted by disc area.
    std::vector<Eigen::Vector2d> displacement_increment; // [length]
    std::vector<Eigen::Matrix2d> displacement_gradient;  // d u_k / d x_l, affine fit over 2.5 d around the cell's centre
    std::vector<double>          shear_strain_increment; // eps_1 - eps_2 >= 0 of this gradient
    std::vector<double>          rotation_increment;     // of the grains, anticlockwise [radians]
    std::vector<double>          spin_increment;         // rotation of the medium: half the curl of the displacement increment
                                                         // [radians]
    std::vector<double> relative_rotation; // mean_rotation() of the grains over 2.5 d minus spin_increment [radians]

    // At the instant of `to`, from the contacts that carry force in its last step. coordination_number = <number of contacts>,
    // with rattlers. A contact with a platen counts for its grain. fabric = mean of n (x) n over half branches, trace 1.
    std::vector<double>          coordination_number;
    std::vector<Eigen::Matrix2d> fabric;
    std::vector<double>          solid_fraction; // area of discs / area of the cell; also given where the cell is not covered
    std::vector<double>          grain_count;    // sum of shares; also given where the cell is not covered

    // Standard errors of the means over a cell, for independent grains. Neighbours share force chains, so these are lower bounds.
    // Formula: grains per area x deviation of their moments / sqrt(n - 1), n = CellSums::joined; NaN for n <= 1.
    std::vector<double> standard_error;        // of the mean pressure [pressure]
    std::vector<double> stress_standard_error; // of the mean stress, Frobenius norm [pressure]

    std::vector<std::uint8_t> covered;                  // see CellCover
    double                    total_relative_error = 0; // deviation of the sum of |K| stress from the sum of the grains' mean
                                                        // moments
    double outside_share  = 0;                          // see CellSums, of |f| x length
    double nodal_residual = NAN, couple_residual = NAN; // see CellSums, of the window's forces and couples
  };

  // Fields of the grains between two stages, on the cells of a mesh in its shape at `to`. The period is that of `to`.
  // `judge_nodes`: compute nodal_residual. Throws as distribute() does, and std::invalid_argument for snapshots of different
  // grains.
  GrainFields grain_fields(const QuadMesh           &mesh,
                           const discrete::Snapshot &from,
                           const discrete::Snapshot &to,
                           const AveragingOptions   &options,
                           bool                      judge_nodes = false);
} // namespace diptych::coupling
