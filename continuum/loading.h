// diptych: loading of the continuum sample
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
  // The loading variable, called progress.
  enum class LoadingVariable
  {
    axial_strain, // descent of the upper platen / initial height
    shear_strain, // travel of the upper platen to the right / initial height
    time
  };
  constexpr auto choices(LoadingVariable)
  {
    return std::array{std::pair{LoadingVariable::axial_strain, "axial_strain"},
                      std::pair{LoadingVariable::shear_strain, "shear_strain"}, std::pair{LoadingVariable::time, "time"}};
  }

  // Text for messages, such as "2.5 % axial strain", "1 % shear strain" or "time 3".
  std::string text_of(LoadingVariable loading_variable, double progress);

  // One component of a platen's motion, a function of the progress.
  struct Drive
  {
    bool                          is_force = false; // the component is free and carries the value as a force
    std::function<double(double)> value;            // progress -> displacement since the start [length], or force on the platen
  };

  // A pressure on both sides. It acts horizontally per unit of current height, like Moreau's containing action on the grains.
  struct SidePressure
  {};
  // Rigid smooth side walls. The left one is fixed. The right one carries pressure x current height or has a given motion.
  struct RigidSides
  {
    std::function<double(double)> widening = {}; // progress -> outward displacement of the right wall [length]; empty: pressure
  };
  // The right side moves like the left one plus the change of width. The width is given, or free under pressure x current
  // height. Both sides must have equally many element edges at equal heights. A free width needs smooth platens.
  struct PeriodicSides
  {
    std::optional<double> widening = 0.; // change of width per unit progress [length]; empty: free
  };
  struct FreeSides
  {};
  using LateralCondition = std::variant<SidePressure, RigidSides, PeriodicSides, FreeSides>;

  inline bool sides_carry_pressure(const LateralCondition &lateral)
  {
    if (const auto *rigid = std::get_if<RigidSides>(&lateral))
      return !rigid->widening;
    if (const auto *periodic = std::get_if<PeriodicSides>(&lateral))
      return !periodic->widening;
    return std::holds_alternative<SidePressure>(lateral);
  }

  struct Loading
  {
    double                              pressure = 1;  // lateral pressure, also the isotropic initial stress [pressure]
    std::function<double(double)>       side_pressure; // progress -> lateral pressure [pressure]; empty: constant
    std::array<std::array<Drive, 2>, 2> platens;       // [lower, upper][x, y]; empty: at rest. Smooth platens leave x free
    LateralCondition                    lateral;
    Eigen::Vector2d                     body_force = Eigen::Vector2d::Zero(); // weight per initial area [pressure / length]
    std::vector<double>                 stages; // values of the progress, ascending; the last one ends the loading
    LoadingVariable                     loading_variable  = LoadingVariable::axial_strain;
    double                              time_per_progress = 1; // 1 / strain rate if the progress is a strain
  };

  void validate(const Loading &loading);
} // namespace diptych::continuum
