// diptych: what the discrete panel hands over at one instant
// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <cstdint>
#include <limits>
#include <vector>

#include <Eigen/Core>

#include "discrete/walk.h"

namespace diptych::discrete
{
  // A contact with the force it transmits. Bodies are numbered 0 .. n_grains-1 for grains, n_grains and above for platens;
  // i is always a grain, j may be a platen. The normal points from j to i.
  struct ContactForce
  {
    int             i, j;
    Eigen::Vector2d point;     // contact point [length]
    Eigen::Vector2d normal;    // unit, from j to i
    Eigen::Vector2d force;     // on i = impulse / step [pressure * length, unit thickness]
    double          shift = 0; // x of the image of j that touches i minus x of j; not 0 only across the edge of a periodic cell
  };

  enum class ContactStatus : std::uint8_t
  {
    open,
    sticking,
    slipping,
    unknown // of a contact that carries force in a file of another code
  };

  // Side of the sample's outline: points from the lower platen upward to the upper one.
  struct Outline
  {
    std::vector<Eigen::Vector2d> left, right;
  };

  // One instant of the discrete panel. Tensors are positive in compression.
  struct Snapshot
  {
    Walk   walk          = Walk::axial_strain; // what the loading walks along
    double progress      = 0;                  // of it: one of axial_strain, shear_strain and time
    double axial_strain  = 0;                  // platen descent / initial height
    double time          = 0;
    double step          = 0; // h of the last step
    double residual      = 0; // natural map relative to |r|, of the last step
    double mean_diameter = 1;
    double shear_strain  = 0; // travel of the upper platen to the right / initial height

    // Accuracy of the last step's grain stress: estimated rms error relative to its rms value (NaN: not estimated, infinity: not
    // known), and the ratio of error to residual measured once in the run on a step solved further (NaN: not measured)
    double stress_error = std::numeric_limits<double>::quiet_NaN(), error_over_residual = stress_error;
    double stress_change = stress_error; // of the same in the last doubling of the sweeps: what is known where the error is not

    // grains, n_grains entries each
    std::vector<Eigen::Vector2d> position, displacement /* since the start of loading */, velocity;
    std::vector<double>          rotation, spin, radius, mass;
    std::vector<Eigen::Matrix2d> internal_moment;      // last step, spin term included [pressure * length^2]
    std::vector<Eigen::Matrix2d> mean_internal_moment; // of window_forces, mean spin term included
    std::vector<double>          mean_spin_term;       // mean over the window of (1/2) omega^2 I >= 0 (enters M as -1 times it)
    std::vector<std::uint8_t>    rattler;              // 1 where the grain carries no contact force
    std::vector<std::uint8_t>    fixed; // 1 where nothing moves the grain, 2 and 3 where it is part of the lower and upper platen

    // candidate contacts of the last step with their impulses / step; open ones carry zero force
    std::vector<ContactForce>    contacts;
    std::vector<double>          gap;
    std::vector<ContactStatus>   status;
    std::vector<Eigen::Vector2d> applied_force; // on each grain in the last step: containing action and gravity

    // mean force of every pair that touched in the window since the preceding snapshot (sum of impulses / window time),
    // placed at the pair's present contact point
    std::vector<ContactForce> window_forces;
    double                    window_time = 0; // 0: no window yet

    // Friction dissipation of each entry of window_forces, summed over the steps of the window [energy, unit thickness]; zeros
    // where there is no window yet, empty where a file does not tell. A step counts -r_t (u_t + u_t')/2, the work of the
    // tangential impulse on the mean of the velocities before and after it (penalty: the work of sliding), as the ledger does:
    // all entries of all windows sum up to friction_dissipation of discrete.csv. The law makes -r_t (u_t' + e_t u_t) >= 0, so
    // single entries may be negative unless e_t = 1 (discrete/README.md: how much).
    std::vector<double> window_dissipation;
    std::vector<double> window_impact_dissipation; // likewise -r_n (u_n + u_n')/2: impact_dissipation of discrete.csv

    // platens: lower and upper, force on the sample
    double          lower_y = 0, upper_y = 0;
    Eigen::Vector2d upper_platen_displacement = Eigen::Vector2d::Zero();
    Eigen::Vector2d lower_platen_force = Eigen::Vector2d::Zero(), upper_platen_force = Eigen::Vector2d::Zero();

    // side walls, NaN where there are none; width of a periodic cell, 0 where there is none
    double left_x = std::numeric_limits<double>::quiet_NaN(), right_x = left_x, cell_width = 0;

    Outline outline;
    double  area = 0; // of the outline [length^2]
  };
} // namespace diptych::discrete
