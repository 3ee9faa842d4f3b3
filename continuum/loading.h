// diptych: what is done to the continuum's sample
// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <array>
#include <functional>
#include <optional>
#include <variant>
#include <vector>

#include <Eigen/Core>

#include "continuum/choices.h"

namespace diptych::continuum
{
  // What the progress of a loading is.
  enum class Walk
  {
    axial_strain, // descent of the upper platen / initial height
    shear_strain, // its travel to the right / initial height
    time
  };
  constexpr auto choices(Walk)
  {
    return std::array{std::pair{Walk::axial_strain, "axial_strain"}, std::pair{Walk::shear_strain, "shear_strain"},
                      std::pair{Walk::time, "time"}};
  }

  // "2.5 % axial strain", "1 % shear strain", "time 3": for messages.
  std::string text_of(Walk walk, double progress);

  // The loading is a function of one progress. One component of a platen's motion:
  struct Drive
  {
    bool                          is_force = false; // the platen moves freely in this component and carries the value as a force
    std::function<double(double)> value;            // progress -> displacement since the start [length], or force on the platen
  };

  // A pressure on both sides that acts horizontally per unit of current height, as Moreau's containing action on the grains.
  struct SidePressure
  {};
  // Rigid smooth side walls: the left one stands still, the right one carries pressure x current height or is moved.
  struct RigidSides
  {
    std::function<double(double)> widening = {}; // progress -> displacement of the right wall, outwards [length]; none: pressure
  };
  // The right side moves as the left one plus a change of the width, which is free under pressure x current height or given.
  // The sides must carry equally many element edges at equal heights. A free width needs smooth platens.
  struct PeriodicSides
  {
    std::optional<double> widening = 0.; // of the width per unit progress [length]
  };
  struct FreeSides
  {};
  using LateralCondition = std::variant<SidePressure, RigidSides, PeriodicSides, FreeSides>;

  struct Loading
  {
    double                              pressure = 1;  // lateral; also the isotropic initial stress [pressure]
    std::function<double(double)>       side_pressure; // progress -> lateral pressure, where it is not constant [pressure]
    std::array<std::array<Drive, 2>, 2> platens;       // [lower, upper][x, y]; no function: at rest. Smooth platens leave x alone
    LateralCondition                    lateral;
    Eigen::Vector2d                     body_force = Eigen::Vector2d::Zero(); // weight per initial area [pressure / length]
    std::vector<double>                 stages; // values of the progress at which the panel halts, ascending; last: the end
    Walk                                walk              = Walk::axial_strain;
    double                              time_per_progress = 1; // where the walk is a strain: 1 / strain rate
  };

  // The upper platen moves by `travel` [length] per unit progress, the lower one is at rest. The progress is the descent / height
  // where it descends, else the travel / height.
  Loading straight_loading(double pressure, const Eigen::Vector2d &travel, std::vector<double> stages);

  // Throws std::invalid_argument naming the value and what is allowed.
  void validate(const Loading &loading);
} // namespace diptych::continuum
