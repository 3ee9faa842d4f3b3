// diptych: how friction, dilatancy and cohesion change with plastic strain
// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <vector>

#include "continuum/laws/law.h"
#include "continuum/laws/options.h"

namespace diptych::continuum
{
  // Strength at one value of the hardening variable; a `_rate` is the derivative by it.
  struct Strength
  {
    double friction = 0, friction_rate = 0;   // phi [radians]
    double dilatancy = 0, dilatancy_rate = 0; // psi [radians]
    double cohesion = 0, cohesion_rate = 0;   // c [pressure]
  };

  // What strength depends on; the rest of a MaterialState takes no part.
  struct HardeningState
  {
    double equivalent_plastic_strain = 0;
    double stress_ratio_gain = 0, densification = 0; // critical state: since the start
  };
  inline HardeningState hardening_state(const MaterialState &state)
  {
    return {state.equivalent_plastic_strain, state.stress_ratio_gain, state.densification};
  }

  // hardening = critical_state (after Taylor 1948; Roux and Radjai 1998): the mobilised stress ratio eta = t/s tends to what the
  // solid fraction nu allows, and dilation follows what it exceeds the critical one by. By the plastic shear strain g
  // (compression positive, d eps_v plastic):
  //   d eta / dg = (eta_p(nu) - eta) / g_r,   eta_p = eta_c + A nu_c ln(nu / nu_c),
  //   d eps_v / dg = -sin psi = -(eta - eta_c) / beta,   d ln nu = d eps_v.
  // With the logarithm, which is nu - nu_c to first order, both equations are linear and are solved exactly, so that steps of any
  // length give the same; the flow of a step has the mean dilation over it, so that they conserve mass (but at the cone's tip,
  // where the volume opens and nothing shears).
  class Hardening
  {
  public:
    // Throws std::invalid_argument as validate(options) does.
    explicit Hardening(const LawOptions &options, const Units &units = {});

    // At a state, with an equivalent plastic strain >= 0. At a point of the table the rate is that of the interval which begins
    // there.
    Strength at(const HardeningState &state) const;
    Strength at(const double equivalent_plastic_strain) const { return at(HardeningState{equivalent_plastic_strain}); }

    // Of a critical state; 0 where the solid fraction is none of the law's business.
    double solid_fraction(const HardeningState &state) const;

    // The state after plastic shear strain `multiplier` >= 0.
    HardeningState after(const HardeningState &state, double multiplier) const;

    // Of a step: strength at its end; of a critical state with the mean dilatancy over it, so that volume and solid fraction stay
    // together. Rates are derivatives by the multiplier.
    Strength over(const HardeningState &start, double multiplier) const;

  private:
    struct Point
    {
      double strain = 0, friction = 0, dilatancy = 0, cohesion = 0;
    };
    Strength decayed(double equivalent_plastic_strain) const;
    Strength interpolated(double equivalent_plastic_strain) const;
    Strength critical(const HardeningState &state) const;
    double   dilation(const HardeningState &state) const; // sin psi of a critical state

    // What eta and eta_p have above eta_c.
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

    Point              peak, residual; // strain: none
    double             softening_strain = 0;
    double             unmobilised = 0, mobilisation_strain = 1; // what friction lacks at the start [radians]; by 1/e
    std::vector<Point> table;                                    // empty: exponential or mobilisation; one point: constant
  };
} // namespace diptych::continuum
