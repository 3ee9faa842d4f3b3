// diptych: hardening = critical_state: strength and dilatancy follow solid fraction and mobilisation
// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <array>
#include <optional>

#include "continuum/laws/decay_hardening.h"

namespace diptych::continuum
{
  struct CriticalStateOptions : virtual DecayOptions
  {
    double                critical_stress_ratio   = 0.26; // t/s of steady flow [-]
    double                critical_solid_fraction = 0.82; // solid fraction of steady flow [-]
    double                strength_by_density     = 5.5;  // d(t/s that can be mobilised) / d(solid fraction) [-]
    double                dilatancy_ratio         = 0.55; // (t/s - t/s of steady flow) / sin(dilatancy angle) [-]
    double                stress_ratio_start      = 0.1;  // mobilised t/s of the prepared sample [-]
    std::optional<double> solid_fraction_start;           // of the prepared sample [-]; empty: mapped from the grains

    double start_solid_fraction() const { return solid_fraction_start.value_or(critical_solid_fraction); }
  };

  template <class Visitor> void visit_parameters(CriticalStateOptions &o, Visitor &&visitor)
  {
    visitor("critical_stress_ratio", o.critical_stress_ratio, "-", {0.01, 0.9},
            "hardening = critical_state, kinematic: t/s of steady flow");
    visitor("critical_solid_fraction", o.critical_solid_fraction, "-", {0.1, 1.},
            "hardening = critical_state, kinematic: solid fraction of steady flow");
    visitor("strength_by_density", o.strength_by_density, "-", {1e-6, 1e3},
            "hardening = critical_state, kinematic: d(t/s that can be mobilised) / d(solid fraction)");
    visitor("dilatancy_ratio", o.dilatancy_ratio, "-", {0.05, 20.},
            "hardening = critical_state, kinematic: (t/s - t/s of steady flow) / sine of the dilatancy angle");
    visitor("stress_ratio_start", o.stress_ratio_start, "-", {0., 0.9},
            "hardening = critical_state, kinematic: mobilised t/s of the prepared sample");
    visitor(
      "solid_fraction_start", o.solid_fraction_start, "-", {0.1, 1.},
      "hardening = critical_state, kinematic: solid fraction of the prepared sample; auto: mapped from its grains, cell by cell");
  }

  // After Taylor 1948; Roux and Radjai 1998. The mobilised stress ratio eta = t/s tends to a limit eta_p that depends on the
  // solid fraction nu. The dilatancy is proportional to the excess of eta over its critical value eta_c. With the plastic shear
  // strain g and the plastic volume strain eps_v, positive in compression:
  //   d eta / dg = (eta_p(nu) - eta) / g_r,   eta_p = eta_c + A nu_c ln(nu / nu_c),
  //   d eps_v / dg = -sin psi = -(eta - eta_c) / beta,   d ln nu = d eps_v.
  // The logarithm equals nu - nu_c to first order and makes both equations linear. They are solved exactly, for any length of
  // the steps. The flow of a step uses the mean dilation over it and thereby conserves mass, except where the tip of the cone
  // opens. The names and check() as in ConstantHardening.
  struct CriticalStateHardening
  {
    using Options                         = CriticalStateOptions;
    static constexpr const char name[]    = "critical_state";
    static constexpr const char meaning[] = "both angles follow solid fraction and mobilisation";
    static constexpr std::array keys      = {
           "critical_stress_ratio", "critical_solid_fraction", "strength_by_density", "dilatancy_ratio",
           "stress_ratio_start",    "solid_fraction_start",    "mobilisation_strain", "cohesion"};

    static void check(const CriticalStateOptions &o);
    CriticalStateHardening(const CriticalStateOptions &o, bool is_nonlocal);

    // Both sines are cut off, because the rate of an angle diverges at 1.
    static constexpr double largest_sine = 0.95;

    StrengthBySines sines(const HardeningState &state) const;
    double          solid_fraction(const HardeningState &state) const;
    HardeningState  after(const HardeningState &state, double multiplier) const;
    Rated           mean_dilation(const HardeningState &start, const HardeningState &end, double multiplier) const;

    double solid_fraction_start;                             // nu_0
    double stress_ratio, start_excess, start_possible;       // eta_c; eta_0 - eta_c; eta_p(nu_0) - eta_c
    double by_density, dilatancy_ratio, mobilisation_strain; // A nu_c, d eta_p / d ln nu; beta; g_r
    double cohesion;                                         // [pressure]

  private:
    // Excess of eta and of eta_p over eta_c.
    struct Excess
    {
      double mobilised, possible;
    };
    Excess excess(const HardeningState &state) const;
    double dilation(const HardeningState &state) const; // sin psi, not cut off
  };
} // namespace diptych::continuum
