// diptych: hardening = constant, exponential and mobilisation: strength stays, decays, or rises first
// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <array>
#include <optional>

#include "continuum/laws/strength.h"

namespace diptych::continuum
{
  struct DecayOptions
  {
    double                friction_angle_peak      = 20.5;  // [degrees]
    double                friction_angle_start     = 12;    // [degrees]
    double                mobilisation_strain      = 0.005; // hardening variable over which the initial deficit decays by 1/e [-]
    double                friction_angle_residual  = 13.5;  // [degrees]
    double                dilatancy_angle_peak     = 12;    // [degrees]
    double                dilatancy_angle_residual = 0;     // [degrees]; if constant and positive, the band dilates without end
    double                cohesion                 = 0.01;  // [Units::stress]; without it free corners can lose all stiffness
    std::optional<double> cohesion_residual;                // [Units::stress]; empty: = cohesion
    double                softening_strain = 0.075;         // hardening variable over which strength decays by 1/e [-]
  };

  template <class Visitor> void visit_parameters(DecayOptions &o, Visitor &&visitor)
  {
    visitor("friction_angle_peak", o.friction_angle_peak, "degrees", {0., 60.},
            "friction angle before any plastic strain; hardening = mobilisation: the value it would have if fully mobilised");
    visitor("friction_angle_start", o.friction_angle_start, "degrees", {0., 60.},
            "hardening = mobilisation: friction angle before any plastic strain; at most the peak angle");
    visitor("mobilisation_strain", o.mobilisation_strain, "-", {1e-6, 1e6},
            "hardening = mobilisation, critical_state, kinematic: equivalent plastic strain over which the deficit of friction "
            "decays by 1/e");
    visitor("friction_angle_residual", o.friction_angle_residual, "degrees", {0., 60.},
            "friction angle after long shear; at most the peak angle");
    visitor("dilatancy_angle_peak", o.dilatancy_angle_peak, "degrees", {0., 60.},
            "dilatancy angle before any plastic strain; at most the friction angle");
    visitor("dilatancy_angle_residual", o.dilatancy_angle_residual, "degrees", {0., 60.},
            "dilatancy angle after long shear; if above zero, the band dilates without end");
    visitor("cohesion", o.cohesion, "loading/pressure", {0., 1e12}, "cohesion before any plastic strain");
    visitor("cohesion_residual", o.cohesion_residual, "loading/pressure", {0., 1e12},
            "cohesion after long shear; auto: equal to cohesion");
    visitor("softening_strain", o.softening_strain, "-", {1e-6, 1e6},
            "equivalent plastic strain over which angles and cohesion decay by 1/e");
  }

  // Every hardening has `name` and `meaning`, as `hardening` shows them; its Options, and `keys`, those that it reads; check(),
  // which throws WrongKeys for values that contradict each other; and a constructor from options in the units of the stress
  // (`is_nonlocal`: for a gradient law). Strength at the hardening variable kappa is the sum of falling(kappa) and
  // rising(kappa).
  struct ConstantHardening
  {
    using Options                         = DecayOptions;
    static constexpr const char name[]    = "constant";
    static constexpr const char meaning[] = "the peak values";
    static constexpr std::array keys      = {"friction_angle_peak", "dilatancy_angle_peak", "cohesion"};

    static void check(const DecayOptions &o);
    ConstantHardening(const DecayOptions &o, bool is_nonlocal);

    Strength falling(double) const { return constant(peak); }
    Strength rising(double) const { return {}; }

    StrengthPoint peak;
  };

  // v(kappa) = v_r + (v_p - v_r) exp(-kappa/kappa_s) for both angles and the cohesion.
  struct ExponentialHardening
  {
    using Options                         = DecayOptions;
    static constexpr const char name[]    = "exponential";
    static constexpr const char meaning[] = "decay from peak to residual values with exp(-strain / softening_strain)";
    static constexpr std::array keys      = {"friction_angle_peak",     "dilatancy_angle_peak",     "cohesion",
                                             "friction_angle_residual", "dilatancy_angle_residual", "cohesion_residual",
                                             "softening_strain"};

    static void check(const DecayOptions &o);
    ExponentialHardening(const DecayOptions &o, bool is_nonlocal);

    Strength falling(double kappa) const;
    Strength rising(double) const { return {}; }

    StrengthPoint peak, residual;
    double        softening_strain;
  };

  // As ExponentialHardening, but friction is lower by (phi_p - phi_0) exp(-kappa/kappa_m).
  struct MobilisationHardening : ExponentialHardening
  {
    using Options                      = DecayOptions;
    static constexpr const char name[] = "mobilisation";
    static constexpr const char meaning[] =
      "the same, but friction starts at friction_angle_start and is lower by (peak - start) "
      "exp(-strain / mobilisation_strain)";
    static constexpr std::array keys = {"friction_angle_peak",     "dilatancy_angle_peak",     "cohesion",
                                        "friction_angle_residual", "dilatancy_angle_residual", "cohesion_residual",
                                        "softening_strain",        "friction_angle_start",     "mobilisation_strain"};

    static void check(const DecayOptions &o);
    MobilisationHardening(const DecayOptions &o, bool is_nonlocal);

    Strength rising(double kappa) const;

    double unmobilised, mobilisation_strain; // deficit of friction at the start [radians]; its decay
  };
} // namespace diptych::continuum
