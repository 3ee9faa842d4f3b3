// diptych: friction, dilatancy and cohesion as functions of plastic strain
// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <optional>
#include <vector>

#include "continuum/laws/law.h"
#include "continuum/laws/options.h"

namespace diptych::continuum
{
  // Strength at one value of the hardening variable. A `_rate` is the derivative by that variable.
  struct Strength
  {
    double friction = 0, friction_rate = 0;   // phi [radians]
    double dilatancy = 0, dilatancy_rate = 0; // psi [radians]
    double cohesion = 0, cohesion_rate = 0;   // c [pressure]
  };

  // The same with the sines of the angles in place of the angles.
  struct StrengthBySines
  {
    double friction = 0, friction_rate = 0;   // sin phi
    double dilatancy = 0, dilatancy_rate = 0; // sin psi
    double cohesion = 0, cohesion_rate = 0;   // c [pressure]
    double friction_cosine = 1;               // cos phi
  };

  // sin psi over a step, with its derivative by the multiplier.
  struct Dilation
  {
    double sine = 0, rate = 0;
  };

  // The part of a MaterialState on which the strength depends.
  struct HardeningState
  {
    double equivalent_plastic_strain = 0;
    double stress_ratio_gain = 0, densification = 0; // critical state: change since the start
    double nonlocal_plastic_strain = 0;              // gradient laws
  };
  inline HardeningState hardening_state(const MaterialState &state)
  {
    return {state.equivalent_plastic_strain, state.stress_ratio_gain, state.densification, state.nonlocal_plastic_strain};
  }

  // hardening = critical_state (after Taylor 1948; Roux and Radjai 1998). The mobilised stress ratio eta = t/s tends to a limit
  // eta_p that depends on the solid fraction nu. The dilatancy is proportional to the excess of eta over its critical value
  // eta_c. With the plastic shear strain g and the plastic volume strain eps_v, positive in compression:
  //   d eta / dg = (eta_p(nu) - eta) / g_r,   eta_p = eta_c + A nu_c ln(nu / nu_c),
  //   d eps_v / dg = -sin psi = -(eta - eta_c) / beta,   d ln nu = d eps_v.
  // The logarithm equals nu - nu_c to first order and makes both equations linear. They are solved exactly, for any length of
  // the steps. The flow of a step uses the mean dilation over it and thereby conserves mass, except where the tip of the cone
  // opens.
  class Hardening
  {
  public:
    // A gradient law has a `nonlocal_weight` m > 0. Values that fall are then read at the softening variable
    // max(0, (1 - m) kappa + m kbar), values that rise at kappa. Throws std::invalid_argument if m > 0 with critical_state.
    explicit Hardening(const LawOptions &options, const Units &units = {}, double nonlocal_weight = 0);

    // Strength at a state with an equivalent plastic strain >= 0. At a point of the table the rate is that of the following
    // interval.
    Strength        at(const HardeningState &state) const;
    Strength        at(const double equivalent_plastic_strain) const { return at(HardeningState{equivalent_plastic_strain}); }
    StrengthBySines sines_at(const HardeningState &state) const;
    // The same values; the rates are derivatives by the nonlocal hardening variable at a constant local one.
    StrengthBySines sines_by_nonlocal(const HardeningState &state) const;

    // A lower bound of sin psi at any state. Only critical_state contracts.
    double least_dilation() const { return critical_state.is_on ? -largest_sine : 0; }

    // Solid fraction of a critical-state law; 0 for any other.
    double solid_fraction(const HardeningState &state) const;

    // The state after plastic shear strain `multiplier` >= 0.
    HardeningState after(const HardeningState &state, double multiplier) const;

    // Mean dilation of a critical-state law over the step from `start` to `end` = after(start, multiplier). It keeps volume and
    // solid fraction consistent. The flow of any other law uses the dilation at the end: no value.
    std::optional<Dilation> mean_dilation(const HardeningState &start, const HardeningState &end, double multiplier) const;

  private:
    static constexpr double largest_sine = 0.95; // critical_state cuts its sines off, because the rate of an angle diverges at 1

    struct Point
    {
      double strain = 0, friction = 0, dilatancy = 0, cohesion = 0;
    };
    static Strength interpolated(const std::vector<Point> &table, double strain);
    void            separate_rises();
    Strength        decayed(double softening_variable) const;
    Strength softened(const HardeningState &state, double share) const; // share: d softening variable / d variable of rates
    Strength risen(const HardeningState &state) const;                  // in addition
    Strength angles_at(const HardeningState &state) const;              // not for critical_state
    double   softening_variable(const HardeningState &state) const;
    StrengthBySines critical(const HardeningState &state) const;
    double          dilation(const HardeningState &state) const; // sin psi for critical_state
    static Dilation cut_off(double sine, double rate);

    // Excess of eta and of eta_p over eta_c.
    struct Excess
    {
      double mobilised, possible;
    };
    Excess excess(const HardeningState &state) const;

    struct Critical
    {
      bool   is_on          = false;
      double solid_fraction = 0;                                           // nu_0
      double stress_ratio = 0, start_excess = 0, start_possible = 0;       // eta_c; eta_0 - eta_c; eta_p(nu_0) - eta_c
      double by_density = 0, dilatancy_ratio = 1, mobilisation_strain = 1; // A nu_c, beta, g_r
    };
    Critical critical_state;

    Point              peak, residual; // their strain is not used
    double             softening_strain = 0;
    double             unmobilised = 0, mobilisation_strain = 1; // deficit of friction at the start [radians]; its decay
    std::vector<Point> table;                                    // empty: exponential or mobilisation; one point: constant
    std::vector<Point> rises;                                    // gradient laws: the part of the table that rises, from 0
    double             nonlocal_weight;                          // 0: local law
  };
} // namespace diptych::continuum
