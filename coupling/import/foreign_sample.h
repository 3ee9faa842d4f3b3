// diptych: the door of the import: a granular sample as a reader of another code's files returns it
// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <cmath>
#include <limits>
#include <optional>
#include <string>
#include <vector>

#include <Eigen/Core>

#include "discrete/snapshot.h"

namespace diptych::coupling
{
  inline constexpr double not_told = std::numeric_limits<double>::quiet_NaN();

  // All numbers are in the units of the file; forces and masses are those of the whole thickness. Numbers that the file does
  // not contain are NaN or empty.
  struct ForeignGrain
  {
    long            id       = 0;
    Eigen::Vector2d position = {not_told, not_told};    // [length]
    double          radius = not_told, mass = not_told; // [length], [mass]
    Eigen::Vector2d velocity  = {not_told, not_told};   // [length/time]
    double          spin      = not_told;               // counter-clockwise [rad/time]
    double          rotation  = not_told;               // counter-clockwise [rad]
    Eigen::Vector2d resultant = {not_told, not_told};   // of all contact forces, computed by the code
    int             line      = 0;                      // of the file, from 1; 0: none
  };

  struct ForeignContact
  {
    long                    first = 0, second = 0;             // ids of grains; second is unused in a wall contact
    int                     wall    = -1;                      // index in ForeignFrame::walls; -1: two grains
    Eigen::Vector2d         force   = Eigen::Vector2d::Zero(); // on `first`, normal and tangential part
    Eigen::Vector2d         point   = {not_told, not_told};    // [length]
    double                  overlap = not_told;                // of the two surfaces [length]
    discrete::ContactStatus status  = discrete::ContactStatus::unknown;
    int                     line    = 0;
  };

  // In the order of State::walls.
  enum class Side
  {
    lower,
    upper,
    left,
    right
  };
  inline constexpr const char *side_names[] = {"lower", "upper", "left", "right"};

  struct ForeignWall
  {
    std::string         name;                          // its name in the file
    std::optional<Side> side   = {};                   // if empty, the grains that touch it give the side
    double              place  = not_told;             // of its inner face: y of lower and upper, x of left and right [length]
    double              travel = 0;                    // along itself since the first frame, to the right [length]
    Eigen::Vector2d     force  = {not_told, not_told}; // between wall and sample; the sign is found later, because walls push
  };

  struct ForeignFrame
  {
    std::string                 name;                     // unique name from the files: "step 120000", "_3"
    std::string                 grain_file, contact_file; // for messages
    std::string                 wall_file;                // for messages; file that places the walls, if not the grains' file
    std::optional<double>       time    = {};
    std::optional<long>         step    = {};
    Eigen::Vector2d             gravity = {not_told, not_told}; // acceleration of every grain [length/time^2]
    std::vector<ForeignGrain>   grains;
    std::vector<ForeignContact> contacts;
    bool                        has_contacts = false;
    std::vector<ForeignWall>    walls;
  };

  struct ForeignSample
  {
    std::string               format;
    bool                      is_spheres = false; // one layer of spheres: stresses need a thickness
    std::vector<ForeignFrame> frames;             // ascending
    std::vector<std::string>  remarks;            // notes on data that were reordered, reversed or left out
    std::vector<std::string>  lacking;            // quantities that this format never contains, besides NaN
  };

  // Options of the command line besides the files.
  struct ForeignOptions
  {
    std::vector<std::string>       files;
    std::optional<double>          thickness; // of the sample [length]
    std::optional<double>          density;   // if no file contains masses
    std::optional<double>          pressure;  // lateral; empty: that of the first frame with forces
    std::optional<double>          mean_diameter;
    std::optional<Eigen::Vector2d> gravity;             // replaces that of the files [length/time^2]
    bool                           walls_touch = false; // place missing walls at the outermost grains
  };
} // namespace diptych::coupling
