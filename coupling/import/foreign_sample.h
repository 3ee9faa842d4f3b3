// diptych: a granular sample as another code's files tell it
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

  // Everything in the file's own units; forces and masses of the whole thickness of the sample. What a file does not hold stays
  // NaN or empty.
  struct ForeignGrain
  {
    long            id       = 0;
    Eigen::Vector2d position = {not_told, not_told};    // [length]
    double          radius = not_told, mass = not_told; // [length], [mass]
    Eigen::Vector2d velocity  = {not_told, not_told};   // [length/time]
    double          spin      = not_told;               // counter-clockwise [rad/time]
    double          rotation  = not_told;               // counter-clockwise [rad]
    Eigen::Vector2d resultant = {not_told, not_told};   // of all contact forces, as the code knew it
    int             line      = 0;                      // of the file, from 1; 0: it has none
  };

  struct ForeignContact
  {
    long                    first = 0, second = 0;             // ids of grains; second is not looked at where there is a wall
    int                     wall    = -1;                      // place in ForeignFrame::walls
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
    std::string         name;                         // as the file calls it
    std::optional<Side> side   = {};                  // none: found from the grains that touch it
    double              place  = not_told;            // of its inner face: y of lower and upper, x of left and right [length]
    double              travel = 0;                   // along itself since the first frame, to the right [length]
    Eigen::Vector2d     force = {not_told, not_told}; // between wall and sample, of either sign: walls push, so the sign is found
  };

  struct ForeignFrame
  {
    std::string                 name;                     // as the files tell it from others: "step 120000", "_3"
    std::string                 grain_file, contact_file; // for messages
    std::string                 wall_file;                // likewise, where not the grains' file tells where walls stand
    std::optional<double>       time = {};
    std::optional<long>         step = {};
    std::vector<ForeignGrain>   grains;
    std::vector<ForeignContact> contacts;
    bool                        has_contacts = false;
    std::vector<ForeignWall>    walls;
  };

  struct ForeignSample
  {
    std::string               format;
    bool                      is_spheres   = false;    // one layer of them: stresses need a thickness
    double                    density      = not_told; // of the material [mass/length^2 of discs, mass/length^3 of spheres]
    bool                      counts_steps = false;    // frames know their step: a timestep makes a time of it
    std::vector<std::string>  unnamed;                 // kinds of tables whose columns the files may leave without names
    std::vector<ForeignFrame> frames;                  // ascending
    std::vector<std::string>  remarks;                 // what the reader left out or took in another way than it stood
    std::vector<std::string>  lacking;                 // what this format never holds, beside what is NaN
  };

  // Normals in the plane, of files with seven digits.
  inline bool is_unit(const Eigen::Vector2d &normal)
  {
    return std::abs(normal.squaredNorm() - 1) < 1e-5;
  }

  // What the command line says beside the files.
  struct ForeignOptions
  {
    std::vector<std::string> files;
    std::vector<std::string> columns;   // "contacts=index,id1,..." where files do not name their columns
    std::optional<double>    timestep;  // of codes that count steps [time]
    std::optional<double>    thickness; // of the sample [length]
    std::optional<double>    density;   // where no file tells masses
    std::optional<double>    pressure;  // lateral; none: that of the first frame
    std::optional<double>    mean_diameter;
    bool                     walls_touch = false; // walls stand where the grains reach farthest
  };
} // namespace diptych::coupling
