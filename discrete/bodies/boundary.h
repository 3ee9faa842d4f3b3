// diptych: lateral condition of the grain sample, forces and motions of its walls
// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <variant>

#include "discrete/choices.h"
#include "discrete/bodies/state.h"

namespace diptych::discrete
{
  // Free sides: the outermost grains carry the pressure (Moreau 1997, section 3, "containing action").
  struct EndGrains
  {
    double band_height = 3; // height of a horizontal layer [mean diameters]
    int    end_grains  = 5; // at each end of a layer
  };
  // Two smooth rigid walls. The left one, walls[2], does not move. The right one, walls[3], is free or moves at a given speed.
  struct RigidSides
  {
    std::optional<double> velocity =
      {};            // of the right wall, positive to the right; without a value it is free under the pressure [length/time]
    double mass = 0; // of the right wall; 0: sqrt(number of grains) x mean grain mass
  };
  // The sample repeats itself along x.
  struct PeriodicSides
  {
    bool   free_width = false; // under the pressure
    double velocity   = 0;     // rate of a width that is not free [length/time]
    double mass       = 0;     // inertia of the free width; 0: sqrt(number of grains) x mean grain mass
  };
  // The sample repeats itself in both directions: no platens, no sides.
  struct CellSides
  {};
  struct NoSides
  {};
  using LateralCondition = std::variant<EndGrains, RigidSides, PeriodicSides, CellSides, NoSides>;

  enum class Lateral
  {
    end_grains,
    rigid_walls,
    periodic,
    cell,
    none
  };

  constexpr auto choices(Lateral)
  {
    return std::array{std::pair{Lateral::end_grains, "end_grains"}, std::pair{Lateral::rigid_walls, "rigid_walls"},
                      std::pair{Lateral::periodic, "periodic"}, std::pair{Lateral::cell, "cell"},
                      std::pair{Lateral::none, "none"}};
  }

  enum class SideMotion
  {
    pressure, // free under the pressure
    velocity  // prescribed
  };

  constexpr auto choices(SideMotion)
  {
    return std::array{std::pair{SideMotion::pressure, "pressure"}, std::pair{SideMotion::velocity, "velocity"}};
  }

  struct LateralOptions
  {
    Lateral    lateral       = Lateral::end_grains;
    double     band_height   = 3;
    int        end_grains    = 5;
    SideMotion side_motion   = SideMotion::pressure;
    double     side_velocity = 0;
    double     wall_mass     = 0;
  };

  template <class Visitor> void visit_parameters(LateralOptions &o, Visitor &&visitor)
  {
    visitor(
      "lateral", o.lateral, "-",
      "condition at the sides: the end grains of horizontal layers carry the pressure (free sides), two rigid walls, periodic "
      "sides, a cell that is periodic in both directions (no platens; loading/mode = path), or nothing");
    visitor(
      "band_height", o.band_height, "mean diameters", {0.5, 100.},
      "end_grains: height of a horizontal layer; 1.5 to 3 are equivalent, and from 8 on grains escape between five end grains");
    visitor("end_grains", o.end_grains, "-", {1, 100},
            "grains at each end of a layer that share the force (height of the layer) x pressure");
    visitor("side_motion", o.side_motion, "-",
            "rigid_walls: the right wall is free under pressure x height, or moves at side_velocity; periodic: the width is "
            "free under the pressure, or changes at side_velocity (0: fixed)");
    visitor("side_velocity", o.side_velocity, "length/time", {-1e12, 1e12},
            "velocity of the right wall, or rate of the width, after the preparation; positive outwards");
    visitor("wall_mass", o.wall_mass, "mass", {0., 1e15},
            "mass of a wall, platen or cell width that moves under a force; 0: sqrt(number of grains) x mean grain mass");
  }

  LateralCondition lateral_condition(const LateralOptions &options);

  // Adds the containing action to `force` (one entry per grain) [pressure x length]. Equal layers, as near to band_height as
  // fits, divide the height between the platens walls[0] and walls[1]. In each layer the `end_grains` outermost grains of a
  // side share (height of the layer) x pressure, in proportion to their masses. Those on the left are pushed to the right, and
  // vice versa. If a layer has fewer than twice as many grains, half of them belong to each side. A grain belongs to the layer
  // of its centre, also beyond the end of a platen. Fixed grains carry nothing.
  void add_lateral_forces(const State                  &state,
                          const EndGrains              &action,
                          double                        pressure,
                          double                        mean_diameter,
                          std::vector<Eigen::Vector2d> &force);

  // Force on the free components of wall `index` at the present positions and at `time` [pressure x length]; 0 on the others.
  Eigen::Vector2d applied_wall_force(const State &state, std::size_t index, double time);

  Eigen::Vector2d prescribed_wall_velocity(const Wall &wall, double time);

  // Height between the platens, or y of the second vector of a lattice; width between the side walls or of the cell. Throws
  // std::invalid_argument without these bodies.
  double sample_height(const State &state);
  double sample_width(const State &state);

  // Throws std::invalid_argument for a mass that is not positive and for a pressure on a wall without neighbouring walls. Also
  // for a wall whose contacts would couple their normal and tangential parts (state.h).
  void validate_walls(const State &state);
} // namespace diptych::discrete
