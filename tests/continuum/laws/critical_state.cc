// diptych: hardening = critical_state at single points
// SPDX-License-Identifier: LGPL-2.1-or-later
#include <cmath>
#include <map>
#include <string>

#include <gtest/gtest.h>

#include "continuum/laws/plastic_flow.h"
#include "continuum/laws/yield_cone.h"
#include "tests/continuum/laws/law_states.h"

namespace
{
  using namespace diptych::continuum;
  using namespace diptych::continuum::tests;

  double eta(const Hardening &hardening, const HardeningState &state)
  {
    return std::sin(hardening.at(state).friction);
  }

  // Far along the path: eta = eta_c, no dilation, solid fraction nu_c, from either side.
  TEST(CriticalState, EndsInSteadyFlow)
  {
    for (const double solid_fraction : {0.86, 0.78})
      {
        const Hardening      hardening(critical(solid_fraction, 0.1));
        const HardeningState end = hardening.after({}, 3);
        EXPECT_NEAR(eta(hardening, end), 0.26, 1e-9);
        EXPECT_NEAR(hardening.at(end).dilatancy, 0, 1e-9);
        EXPECT_NEAR(solid_fraction * std::exp(end.densification), 0.82, 1e-9);
      }
  }

  // At the peak of eta the sine of the dilatancy angle is A nu_c ln(nu/nu_c) / beta. To first order this is A (nu - nu_c) /
  // beta.
  TEST(CriticalState, DilatancyAtThePeakFollowsTheDensity)
  {
    const Hardening hardening(critical(0.86, 0.1));
    double          low = 0, high = 0.5; // where d eta / dg changes sign
    for (int k = 0; k < 60; ++k)
      {
        const double middle                                                        = 0.5 * (low + high);
        (hardening.at(hardening.after({}, middle)).friction_rate > 0 ? low : high) = middle;
      }
    const HardeningState peak           = hardening.after({}, low);
    const double         solid_fraction = 0.86 * std::exp(peak.densification), sine = std::sin(hardening.at(peak).dilatancy);
    EXPECT_GT(eta(hardening, peak), 0.27);
    EXPECT_NEAR(sine, 5.5 * 0.82 * std::log(solid_fraction / 0.82) / 0.55, 1e-9);
    EXPECT_NEAR(sine / (5.5 * (solid_fraction - 0.82) / 0.55), 1, 0.02);
  }

  // d eta/dg = (eta_p - eta)/g_r and d ln nu/dg = -sin psi along the path, for overdamped and for oscillating mobilisation. The
  // result does not depend on the length of the steps.
  TEST(CriticalState, SolvesItsEquations)
  {
    for (const double strain : {0.02, 0.2, 0.03048780487804878})
      {
        LawOptions o          = critical(0.85, 0.05);
        o.mobilisation_strain = strain; // for the last value both roots are equal to double precision
        const Hardening hardening(o);
        HardeningState  walked;
        for (int k = 0; k < 50; ++k)
          {
            const double         g = 0.003 * (k + 1), h = 1e-6;
            const HardeningState here = hardening.after({}, g), up = hardening.after({}, g + h),
                                 down = hardening.after({}, g - h);
            const double possible     = 0.26 + 5.5 * 0.82 * std::log(0.85 * std::exp(here.densification) / 0.82);
            EXPECT_NEAR((up.stress_ratio_gain - down.stress_ratio_gain) / (2 * h), (possible - eta(hardening, here)) / strain,
                        1e-6)
              << g;
            EXPECT_NEAR((up.densification - down.densification) / (2 * h), -std::sin(hardening.at(here).dilatancy), 1e-7) << g;
            walked = hardening.after(walked, 0.003);
            EXPECT_NEAR(walked.stress_ratio_gain, here.stress_ratio_gain, 1e-12);
            EXPECT_NEAR(walked.densification, here.densification, 1e-12);
          }
      }
  }

  // The volume added by the flow of a step equals the volume removed from the solid fraction, for any step length. The rate is
  // the derivative.
  TEST(CriticalState, ConservesMass)
  {
    for (const double start : {0.1, 0.35})
      for (const double step : {3e-8, 5e-7, 2e-6, 1e-4, 3e-3, 0.05})
        {
          const YieldCone      cone{Hardening(critical(0.85, start)), ConeShape::mohr_coulomb};
          const HardeningState here = cone.hardening.after({}, 0.01), end = cone.hardening.after(here, step);
          const Cone           c = cone.over(here, step);
          EXPECT_NEAR(c.dilation * step, here.densification - end.densification, 1e-9 * step + 1e-14) << step;
          EXPECT_EQ(c.slope, cone.at(end).slope);
          const double h = 0.05 * step;
          EXPECT_NEAR((cone.over(here, step + h).dilation - cone.over(here, step - h).dilation) / (2 * h), c.dilation_rate,
                      2e-3 * std::abs(c.dilation_rate) + 1e-8 / step)
            << step;
        }
  }

  // At constant volume loose grains lose pressure, then strength (Castro 1969): d sigma : d eps < 0 while the flow contracts.
  // At constant lateral pressure the same grains only harden. Dense grains also harden at constant volume.
  TEST(CriticalState, WeakensWhereContractionIsPrevented)
  {
    for (const LawKind name : {LawKind::mohr_coulomb, LawKind::cosserat_mohr_coulomb, LawKind::drucker_prager})
      {
        std::map<std::string, int> unstable;
        double                     pressure = 0;
        for (const auto &[grains, solid_fraction] : {std::pair{"loose", 0.80}, {"dense", 0.86}})
          for (const bool drained : {false, true})
            {
              LawOptions o           = hardenings()["critical state, loose"];
              o.solid_fraction_start = solid_fraction;
              const Law     law      = make_law(name, o);
              MaterialState state    = state_of(-1, -1, -1);
              int          &count    = unstable[std::string(grains) + (drained ? ", drained" : "")];
              for (int k = 0; k < 200; ++k)
                {
                  Strain         e      = strain_of(1e-4, -1e-4, 0);
                  MaterialUpdate answer = update(law, state, e);
                  for (int newton = 0; drained && newton < 30; ++newton) // sigma_xx = -1
                    {
                      e[xx] += (-1 - answer.state.stress[xx]) / answer.tangent[xx][xx];
                      answer = update(law, state, e);
                    }
                  ASSERT_NE(answer.verdict, Verdict::failed);
                  if (answer.regime != Regime::elastic)
                    {
                      add_plastic_flow(moduli_of(law), state, e, answer.state);
                      count += weakens_contracting(moduli_of(law), state, e, answer.state);
                    }
                  state = answer.state;
                }
              if (std::string(grains) == "loose" && !drained)
                pressure = -(state.stress[xx] + state.stress[yy]) / 2;
            }
        EXPECT_LT(pressure, 0.5) << name_of(name);
        EXPECT_GT(unstable["loose"], 50) << name_of(name);
        EXPECT_EQ(unstable["loose, drained"], 0) << name_of(name);
        EXPECT_EQ(unstable["dense"], 0) << name_of(name);
        EXPECT_EQ(unstable["dense, drained"], 0) << name_of(name);
      }
  }
} // namespace
