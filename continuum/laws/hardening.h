// diptych: friction, dilatancy and cohesion as functions of plastic strain
// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <optional>

#include "continuum/laws/law.h"
#include "continuum/laws/options.h"

namespace diptych::continuum
{
  inline HardeningState hardening_state(const MaterialState &state)
  {
    HardeningState s;
    s.equivalent_plastic_strain = state.equivalent_plastic_strain;
    s.nonlocal_plastic_strain   = part_of<NonlocalState>(state).plastic_strain;
    const auto *critical        = std::get_if<CriticalState>(&state.own);
    if (!critical)
      critical = std::get_if<KinematicState>(&state.own);
    if (critical)
      {
        s.stress_ratio_gain = critical->stress_ratio_gain;
        s.densification     = critical->densification;
      }
    return s;
  }

  // Hardening of any kind, as a law reads it.
  class Hardening
  {
  public:
    // Options as stresses (in_units). A gradient law has a `nonlocal_weight` m > 0. Values that fall are then read at the
    // softening variable max(0, (1 - m) kappa + m kbar), values that rise at kappa.
    explicit Hardening(const LawOptions &options, double nonlocal_weight = 0);

    // Strength at a state with an equivalent plastic strain >= 0.
    Strength        at(const HardeningState &state) const;
    Strength        at(const double equivalent_plastic_strain) const { return at(HardeningState{equivalent_plastic_strain}); }
    StrengthBySines sines_at(const HardeningState &state) const;
    // As sines_at(), but the rates are derivatives by the nonlocal hardening variable at a constant local one.
    StrengthBySines sines_by_nonlocal(const HardeningState &state) const;

    // A lower bound of sin psi at any state. Only critical_state contracts.
    double least_dilation() const { return critical() ? -CriticalStateHardening::largest_sine : 0; }

    // Solid fraction of a critical-state law; 0 for any other.
    double solid_fraction(const HardeningState &state) const { return critical() ? critical()->solid_fraction(state) : 0; }

    // The state after plastic shear strain `multiplier` >= 0.
    HardeningState after(const HardeningState &state, double multiplier) const;

    // Writes the hardening variable and the state of a critical-state law.
    void write(const HardeningState &from, MaterialState &state) const;

    // Mean dilation of a critical-state law over the step from `start` to `end` = after(start, multiplier). It keeps volume and
    // solid fraction consistent. The flow of any other law uses the dilation at the end: no value.
    std::optional<Rated> mean_dilation(const HardeningState &start, const HardeningState &end, double multiplier) const;

    const HardeningForm &form() const { return form_; }

  private:
    // critical_state or kinematic; nullptr: strength depends on the hardening variable alone.
    const CriticalStateHardening *critical() const
    {
      const auto *plain = std::get_if<CriticalStateHardening>(&form_);
      return plain ? plain : std::get_if<KinematicHardening>(&form_);
    }
    // Values with the rates of the falling part times `falls` and those of the rising part times `rises`.
    Strength angles(const HardeningState &state, double falls, double rises) const;

    HardeningForm form_;
    double        nonlocal_weight; // 0: local law
  };
} // namespace diptych::continuum
