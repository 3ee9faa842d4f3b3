// diptych: loading of a prepared sample
// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <array>
#include <string>
#include <vector>

#include <Eigen/Core>

#include "discrete/bodies/boundary.h"
#include "discrete/choices.h"
#include "discrete/loading_variable.h"

namespace diptych::discrete
{
  enum class LoadingMode
  {
    descent,     // the upper platen moves down and sideways at constant speed
    shear,       // the upper platen moves sideways at constant height
    plane_shear, // the upper platen moves sideways under normal_pressure x width, free to rise and sink
    time,        // walls move as their keys specify; stages are times
    path         // a cell follows prescribed strains and stresses; stages are values of the path's progress
  };

  constexpr auto choices(LoadingMode)
  {
    return std::array{std::pair{LoadingMode::descent, "descent"}, std::pair{LoadingMode::shear, "shear"},
                      std::pair{LoadingMode::plane_shear, "plane_shear"}, std::pair{LoadingMode::time, "time"},
                      std::pair{LoadingMode::path, "path"}};
  }

  constexpr LoadingVariable loading_variable_of(const LoadingMode mode)
  {
    return mode == LoadingMode::descent ? LoadingVariable::axial_strain
           : mode == LoadingMode::time  ? LoadingVariable::time
           : mode == LoadingMode::path  ? LoadingVariable::path
                                        : LoadingVariable::shear_strain;
  }

  // Values of three controls of a cell, row by row and linear in between; the first row is the start under an isotropic pressure.
  // A control is a linear form of the logarithmic strains (exx, eyy, 2 exy) since the start or of the stresses (sxx, syy, sxy),
  // both positive in compression. No control may follow from the others, whatever the response of the grains.
  struct CellPath
  {
    Eigen::Matrix3d              form      = Eigen::Matrix3d::Identity(); // one row per control
    std::array<bool, 3>          is_stress = {true, true, true};
    std::vector<Eigen::Vector3d> values;   // at least two rows; empty: no path
    std::vector<double>          progress; // of each row, ascending: the loading variable
  };

  // Throws WrongKeys if there are too few rows, or one does not lead on.
  void validate(const CellPath &path);

  // Time of each row, from 0 on. A row takes the time in which the strain rate reaches its largest change of exx, eyy, 2 exy or
  // volume. A change of a stress by the pressure counts as a strain of 0.01.
  std::vector<double> times_of(const CellPath &path, double pressure, double strain_rate);

  struct Loading
  {
    double              pressure                 = 1;    // P of the lateral condition
    double              inertial_number          = 3e-5; // I = rate d sqrt(rho/P), rate = speed of the upper platen / height
    double              horizontal_over_vertical = 1;    // descent: travel to the right per descent; 1: 45 degrees
    std::vector<double> stages;                 // strains (mode time: times) of the snapshots, ascending; the last one is the end
    bool                affine_start    = true; // grains start with the velocities of the affine field between the platens
    LoadingMode         mode            = LoadingMode::descent;
    double              strain_rate     = 0;  // if not 0, replaces the rate that follows from inertial_number [1/time]
    double              normal_pressure = 1;  // plane_shear, on the upper platen
    CellPath            path            = {}; // mode path
  };

  // True if the mode is a path that prescribes no normal stress: the stress then follows from the stiffness of the grains.
  bool has_no_pressure(const Loading &loading);

  // Motion of one component of a wall, as written in a scene. "auto" follows from the loading and the lateral condition.
  // "velocity V" and "force F" take a number or a CSV file with the columns time and velocity (or force), piecewise linear. Times
  // count from the start of the loading. Forces act on the wall, per unit thickness.
  struct DriveOption
  {
    enum class Kind
    {
      automatic,
      velocity,
      force
    };
    Kind        kind = Kind::automatic;
    std::string value; // a number, or the path of a table

    DriveOption() = default;
    // Throws std::invalid_argument if the text is not one of these three.
    DriveOption(const std::string &text);
    DriveOption(const char *text)
        : DriveOption(std::string(text))
    {}

    bool is_auto() const { return kind == Kind::automatic; }
    bool names_a_file() const; // the value is not a number
  };
  std::string text_of(const DriveOption &option);

  struct WallDriveOptions
  {
    DriveOption lower_x, lower_y, upper_x, upper_y, left_x, left_y, right_x, right_y;
  };

  // The only list of the eight drives: visit(wall as in State::walls, axis, key, option).
  template <class Options, class Visit> void for_each_drive(Options &o, Visit &&visit)
  {
    visit(0, 0, "drive_lower_x", o.lower_x);
    visit(0, 1, "drive_lower_y", o.lower_y);
    visit(1, 0, "drive_upper_x", o.upper_x);
    visit(1, 1, "drive_upper_y", o.upper_y);
    visit(2, 0, "drive_left_x", o.left_x);
    visit(2, 1, "drive_left_y", o.left_y);
    visit(3, 0, "drive_right_x", o.right_x);
    visit(3, 1, "drive_right_y", o.right_y);
  }

  template <class Visitor> void visit_parameters(WallDriveOptions &o, Visitor &&visitor)
  {
    constexpr const char *wall[] = {"lower platen", "upper platen", "left wall of lateral = rigid_walls",
                                    "right wall of lateral = rigid_walls"};
    for_each_drive(o, [&](const int w, const int axis, const char *key, DriveOption &option) {
      const std::string meaning = std::string(axis == 0 ? "horizontal" : "vertical") + " motion of the " + wall[w] +
                                  ": auto, velocity V or force F. V and F are a number or a CSV file with the columns time and "
                                  "velocity (or force). A component under a force moves freely";
      visitor(key, option, "-", meaning.c_str());
    });
  }

  // Throws std::invalid_argument with the key and the error in its value. `key` is only for the message.
  Drive read_drive(const std::string &key, const DriveOption &option);
  void  validate(const WallDriveOptions &options);

  // Strain rate of the loading [1/time]: given, or from the inertial number. In mode time it is 1, so that stages are times.
  double strain_rate(const Loading &loading, double mean_diameter, double density);

  // Sets the drives of walls and cell, the wall velocities and, if wanted, the affine velocity field of the grains. `height` is
  // that of the prepared sample.
  struct LoadingStart
  {
    const Loading          &loading;
    const LateralOptions   &lateral;
    const WallDriveOptions &drives;
    double                  rate; // from strain_rate()
  };
  void start_loading(State &state, const LoadingStart &start);

  // Sets only drives and masses and keeps the velocities. For a restart.
  void set_drives(State &state, const LoadingStart &start);

  // Value of the loading variable: descent or travel of the upper platen / initial height, or the time.
  double loading_progress(const State           &state,
                          const Loading         &loading,
                          const Eigen::Vector2d &initial_platen,
                          double                 initial_height);

  // Time between two values of the loading variable. `rate`: from strain_rate().
  double duration_between(const State &state, const Loading &loading, double rate, double from, double to);
} // namespace diptych::discrete
