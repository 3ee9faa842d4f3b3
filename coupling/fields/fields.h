// diptych: what the grains did on cells between two stages, every field by the same averaging
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
  // n_cells entries each. NaN where grains cover a cell to less than half (CellCover) or where a field has no weight. <q> is
  // the mean over the grains of a cell, weighted by their shares in it. Tensors are positive in compression.
  struct GrainFields
  {
    // Mean over the window of `to` (since the preceding snapshot), raw: row index = force [pressure]. The dynamic part of the
    // stress is -<spin term> 1 (Moreau 1997); a kinetic (streaming) stress is not included.
    std::vector<Eigen::Matrix2d> stress, contact_stress; // with and without the dynamic part
    // |K| mu_K = -sum_c integral over the branch in K of ((x_c - x) x f) ds, f on i, ds directed from i to j: the power-conjugate
    // of the gradient of the grains' rotation as the stress is of that of displacement; a mechanics sign is the opposite
    // [pressure * length].
    std::vector<Eigen::Vector2d> couple_stress;
    std::vector<double>          dissipation; // by friction, over the window, per area [pressure]; NaN: not known

    // At the instant of `to`. velocity = <m v> / <m>; granular temperature = <m |v'|^2 / 2> / <m> [velocity^2], rattlers
    // included, |v'|^2 / 2 of a grain about the affine motion around it: fluctuation_energy() in grain_kinematics.h.
    std::vector<Eigen::Vector2d> velocity;
    std::vector<double>          granular_temperature;

    // From `from` to `to`; rattlers of either instant count in none of them. The mean displacement and rotation are weighted
    // by disc area.
    std::vector<Eigen::Vector2d> displacement_increment; // [length]
    std::vector<Eigen::Matrix2d> displacement_gradient;  // d u_k / d x_l: affine fit over 2.5 d around the cell's centre
    std::vector<double>          shear_strain_increment; // eps_1 - eps_2 >= 0 of it
    std::vector<double>          rotation_increment;     // of the grains, anticlockwise [radians]
    std::vector<double>          spin_increment;         // of the medium: half the curl of the displacement increment [radians]
    std::vector<double>          relative_rotation;      // grains minus medium [radians]

    // At the instant of `to`: contacts that carry force in its last step. coordination_number = <number of contacts>, a contact
    // with a platen one of its grain's, rattlers included; fabric = mean of n (x) n, trace 1, over half branches.
    std::vector<double>          coordination_number;
    std::vector<Eigen::Matrix2d> fabric;
    std::vector<double>          solid_fraction; // area of discs / area of the cell; kept where the cell is not covered
    std::vector<double>          grain_count;    // sum of shares; kept where the cell is not covered

    // Standard errors of the means over a cell, the grains taken as independent: neighbours share force chains, so these are
    // lower bounds. Grains per area x deviation of their moments / sqrt(n - 1), n = CellSums::joined; NaN for n <= 1.
    std::vector<double> standard_error;        // of the mean pressure [pressure]
    std::vector<double> stress_standard_error; // of the mean stress, Frobenius norm [pressure]

    std::vector<std::uint8_t> covered;                    // CellCover
    double                    total_relative_error = 0;   // of the sum of |K| stress from the sum of the grains' mean moments
    double                    outside_share        = 0;   // CellSums, of |f| x length
    double                    nodal_residual       = NAN; // CellSums, of the window's forces
  };

  // Grains at two stages onto the cells of a mesh in its shape at `to`; the period is that of `to`. Throws std::invalid_argument
  // for snapshots of different grains and as distribute() does. judge_nodes: nodal_residual is wanted.
  GrainFields grain_fields(const QuadMesh           &mesh,
                           const discrete::Snapshot &from,
                           const discrete::Snapshot &to,
                           const AveragingOptions   &options,
                           bool                      judge_nodes = false);
} // namespace diptych::coupling
