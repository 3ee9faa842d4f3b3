// diptych: state of the discrete panel at one instant
// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <cmath>
#include <cstdint>
#include <limits>
#include <vector>

#include <Eigen/Core>

#include "discrete/loading_variable.h"

namespace diptych::discrete
{
  // A contact with the force that it transmits. Grains are bodies 0 .. n_grains-1, platens and walls follow from n_grains on.
  // Body i is always a grain, body j may be a wall. The normal points from j to i.
  struct ContactForce
  {
    int             i, j;
    Eigen::Vector2d point;       // contact point [length]
    Eigen::Vector2d normal;      // unit, from j to i
    Eigen::Vector2d force;       // on i = impulse / step [pressure * length, unit thickness]
    double          shift   = 0; // x of the touching image of j minus x of j; not 0 only across the edge of a periodic cell
    double          couple  = 0; // of rolling resistance on i, counter-clockwise; the opposite acts on j [pressure * length^2]
    double          shift_y = 0; // y of that image minus y of j; not 0 only in a cell that is periodic in both directions

    double acting_couple() const { return std::isnan(couple) ? 0 : couple; } // NaN: not in the files of another code
  };

  enum class ContactStatus : std::uint8_t
  {
    open,
    sticking,
    slipping,
    unknown // a force-carrying contact in a file of another code
  };

  // Sides of the sample's outline: points from the lower platen up to the upper one.
  struct Outline
  {
    std::vector<Eigen::Vector2d> left, right;
  };

  // One instant of the discrete panel. Tensors are positive in compression.
  struct Snapshot
  {
    LoadingVariable loading_variable = LoadingVariable::axial_strain; // loading variable
    double          progress         = 0;                             // its value: one of axial_strain, shear_strain and time
    double          axial_strain     = 0;                             // platen descent / initial height
    double          time             = 0;
    double          step             = 0; // h of the last step
    double          residual         = 0; // natural map relative to |r|, of the last step
    double          mean_diameter    = 1;
    double          shear_strain     = 0; // travel of the upper platen to the right / initial height

    // Accuracy of the last step's grain stress. `stress_error`: estimated rms error / rms value (NaN: not estimated, infinity:
    // unknown). `error_over_residual`: measured once per run on a step that was solved further (NaN: not measured).
    double stress_error = std::numeric_limits<double>::quiet_NaN(), error_over_residual = stress_error;
    double stress_change =
      stress_error; // relative change of the grain stress in the last doubling of the sweeps; known even if the error is not

    // grains, n_grains entries each
    std::vector<Eigen::Vector2d> position, displacement /* since the start of loading */, velocity;
    std::vector<double>          rotation, spin, radius, mass;
    std::vector<Eigen::Matrix2d> internal_moment;      // last step, spin term included [pressure * length^2]
    std::vector<Eigen::Matrix2d> mean_internal_moment; // of the mean contact forces of the window, mean spin term included
    std::vector<double>       mean_spin_term; // mean over the window of (1/2) J omega^2 >= 0, which M contains with a minus sign
    std::vector<std::uint8_t> rattler;        // 1 where the grain carries no contact force
    std::vector<std::uint8_t> fixed;          // 1: held at its velocity; 2 and 3: part of the lower and upper platen

    // Candidate contacts of the last step with impulse / step. Open contacts carry zero force.
    std::vector<ContactForce>    contacts;
    std::vector<double>          gap;
    std::vector<ContactStatus>   status;
    std::vector<Eigen::Vector2d> applied_force; // on each grain in the last step: lateral action and gravity

    // Mean force of every pair that touched since the preceding snapshot (sum of impulses / window time). The force is placed at
    // the present contact point of the pair.
    std::vector<ContactForce> window_forces;
    double                    window_time = 0; // 0: the window has not started

    // Dissipation by friction and rolling resistance of each entry of window_forces, summed over the steps of the window [energy,
    // unit thickness]. It is zero if the window has not started, and empty if a file does not contain it. One step contributes
    // -r_t (u_t + u_t')/2 - r_m (w + w')/2: the work of tangential impulse and couple on the mean velocity (penalty: the work of
    // sliding and of rolling at the bound). The ledger sums the same terms, so all entries of all windows add up to
    // friction_dissipation + rolling_dissipation of discrete.csv. The law only requires -r_t (u_t' + e_t u_t) >= 0 and -r_m w' >=
    // 0. Single entries may therefore be negative (discrete/notes/energy.md).
    std::vector<double> window_dissipation;
    std::vector<double> window_impact_dissipation; // the same for -r_n (u_n + u_n')/2: impact_dissipation of discrete.csv

    // Platens: forces on the sample.
    double          lower_y = 0, upper_y = 0;
    Eigen::Vector2d upper_platen_displacement = Eigen::Vector2d::Zero();
    Eigen::Vector2d lower_platen_force = Eigen::Vector2d::Zero(), upper_platen_force = Eigen::Vector2d::Zero();

    // Side walls: NaN without them. `cell_width`: 0 without a periodic cell.
    double left_x = std::numeric_limits<double>::quiet_NaN(), right_x = left_x, cell_width = 0;

    // Cell that is periodic in both directions: its vectors (columns a1 and a2); 0 without one. Then the platens above are the
    // ends of the parallelogram.
    Eigen::Matrix2d cell_vectors = Eigen::Matrix2d::Zero();

    Outline outline;
    double  area = 0; // of the outline [length^2]
  };
} // namespace diptych::discrete
