// diptych: how a prepared sample is loaded
// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <string>
#include <vector>

#include "discrete/boundary.h"

namespace diptych::discrete
{
  enum class LoadingMode
  {
    descent,     // the upper platen moves down and sideways at constant speed
    shear,       // it moves sideways at constant height
    plane_shear, // it moves sideways and carries normal_pressure x width, free to rise and sink
    time         // walls move as their keys say; stages are times
  };

  struct Loading
  {
    double              pressure                 = 1;    // P of the lateral condition
    double              inertial_number          = 3e-5; // I = rate d sqrt(rho/P), rate = speed of the upper platen / height
    double              horizontal_over_vertical = 1;    // descent: travel to the right per descent; 1: 45 degrees
    std::vector<double> stages; // strains (mode time: times) at which a snapshot is made, ascending; the last is the end
    bool                affine_start    = true; // grains start with the velocities of the affine field between the platens
    LoadingMode         mode            = LoadingMode::descent;
    double              strain_rate     = 0; // if not 0, in the place of the one that follows from inertial_number [1/time]
    double              normal_pressure = 1; // plane_shear, on the upper platen
  };

  // One key for each component of motion: "auto" (what the loading and the lateral condition say), "velocity V" or "force F",
  // V and F a number or a CSV file with the columns time, velocity (or force), piecewise linear; times count from the start of
  // the loading. Forces act on the wall, per unit thickness.
  struct WallDriveOptions
  {
    std::string lower_x = "auto", lower_y = "auto", upper_x = "auto", upper_y = "auto";
    std::string left_x = "auto", left_y = "auto", right_x = "auto", right_y = "auto";
  };

  template <class Visitor> void visit_parameters(WallDriveOptions &o, Visitor &&visitor)
  {
    visitor("drive_lower_x", o.lower_x, "-", {},
            "horizontal motion of the lower platen: auto, velocity V or force F; V and F a number or a CSV file with the columns "
            "time and velocity (or force). A component under a force moves freely");
    visitor("drive_lower_y", o.lower_y, "-", {}, "its vertical motion, likewise");
    visitor("drive_upper_x", o.upper_x, "-", {}, "upper platen, likewise");
    visitor("drive_upper_y", o.upper_y, "-", {}, "upper platen, likewise");
    visitor("drive_left_x", o.left_x, "-", {}, "left wall of lateral = rigid_walls, likewise");
    visitor("drive_left_y", o.left_y, "-", {}, "left wall, likewise");
    visitor("drive_right_x", o.right_x, "-", {}, "right wall, likewise");
    visitor("drive_right_y", o.right_y, "-", {}, "right wall, likewise");
  }

  // Throws std::invalid_argument naming the key and what is allowed; `key` is for the message.
  Drive read_drive(const std::string &key, const std::string &text);
  void  validate(const WallDriveOptions &options);

  // Strain rate of the loading: given, or from the inertial number [1/time]. Mode time: 1, so that stages are times.
  double strain_rate(const Loading &loading, double mean_diameter, double density);

  // Sets the drives of walls and cell, wall velocities and, where wanted, the affine velocity field of the grains. `height`:
  // of the prepared sample.
  struct LoadingStart
  {
    const Loading          &loading;
    const LateralOptions   &lateral;
    const WallDriveOptions &drives;
    double                  rate; // of strain_rate()
  };
  void start_loading(State &state, const LoadingStart &start);

  // The drives and masses alone; velocities stay as they are. For a loading that goes on.
  void set_drives(State &state, const LoadingStart &start);

  // How far the loading is at the present positions: descent or travel of the upper platen / initial height, or the time.
  double loading_progress(const State &state, LoadingMode mode, const Eigen::Vector2d &initial_platen, double initial_height);
} // namespace diptych::discrete
