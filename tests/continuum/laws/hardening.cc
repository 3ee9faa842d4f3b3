// diptych: the hardening laws against their closed forms
// SPDX-License-Identifier: LGPL-2.1-or-later
#include "continuum/laws/yield_cone.h"
#include "continuum/require.h"
#include "continuum/laws/plastic_flow.h"
#include "tests/continuum/laws/law_states.h"

namespace
{
  using namespace diptych::continuum::tests;

  // Derivatives of strength and of both cones by central differences, inside the intervals of the table and beyond its end.
  TEST(Hardening, RatesAreDerivatives)
  {
    for (const auto &[name, options] : hardenings())
      for (const ConeShape shape : {ConeShape::mohr_coulomb, ConeShape::drucker_prager})
        for (const double kappa : {0.001, 0.013, 0.05, 0.3})
          {
            const YieldCone cone{Hardening(options), shape};
            const double    h  = 1e-6;
            const auto      at = [&](const double strain) { return cone.at(cone.hardening.after({}, strain)); };
            const Cone      c = at(kappa), up = at(kappa + h), down = at(kappa - h);
            EXPECT_NEAR((up.slope.value - down.slope.value) / (2 * h), c.slope.rate, 1e-6) << name;
            EXPECT_NEAR((up.intercept.value - down.intercept.value) / (2 * h), c.intercept.rate, 1e-6) << name;
            EXPECT_NEAR((up.dilation.value - down.dilation.value) / (2 * h), c.dilation.rate, 1e-6) << name;
          }
  }

  // Table 15 -> 30 -> 22 degrees at 0, 0.02, 0.1: halfway 22.5; at 0.06 26; beyond 22. Exponential at kappa_s: 13.5 + 7/e.
  TEST(Hardening, FollowsTableAndDecay)
  {
    const Hardening table(hardenings()["table"]), decay(LawOptions{}), constant_(constant(20.5, 12, 0.1));
    EXPECT_NEAR(table.at(0).friction.value / degree, 15, 1e-12);
    EXPECT_NEAR(table.at(0.01).friction.value / degree, 22.5, 1e-12);
    EXPECT_NEAR(table.at(0.06).friction.value / degree, 26, 1e-12);
    EXPECT_NEAR(table.at(0.06).dilatancy.value / degree, 7, 1e-12);
    EXPECT_NEAR(table.at(0.06).cohesion.value, 0.05, 1e-12);
    EXPECT_NEAR(table.at(7).friction.value / degree, 22, 1e-12);
    EXPECT_NEAR(decay.at(0.075).friction.value / degree, 13.5 + 7 * std::exp(-1), 1e-12);
    EXPECT_NEAR(decay.at(5).cohesion.value, 0.01, 1e-15) << "without a residual value cohesion is constant";
    // 13.5 + 7 exp(-k/0.05) - 7.5 exp(-k/0.01) is 13 at the start and later that of `exponential`. Dilatancy is always that of
    // `exponential`.
    const Hardening rising(hardenings()["mobilisation"]), falling(hardenings()["exponential"]);
    EXPECT_NEAR(rising.at(0).friction.value / degree, 13, 1e-12);
    EXPECT_NEAR(rising.at(0.01).friction.value / degree, 13.5 + 7 * std::exp(-0.2) - 7.5 * std::exp(-1), 1e-12);
    EXPECT_NEAR(rising.at(0.3).friction.value, falling.at(0.3).friction.value, 1e-12);
    EXPECT_EQ(rising.at(0.01).dilatancy.value, falling.at(0.01).dilatancy.value);
    EXPECT_NEAR(constant_.at(9).friction.value / degree, 20.5, 1e-12);
  }

  // Softens to below its dilatancy before friction is mobilised.
  void slow_mobilisation(LawOptions &o)
  {
    o                          = hardenings()["mobilisation"];
    o.dilatancy_angle_peak     = 12.9;
    o.dilatancy_angle_residual = 12.9;
    o.friction_angle_residual  = 13;
    o.softening_strain         = 0.02;
    o.mobilisation_strain      = 0.2;
  }

  TEST(Hardening, ContradictoryOptionsAreRefusedByName)
  {
    constexpr LawKind                                                law     = LawKind::cosserat_mohr_coulomb;
    const std::pair<std::function<void(LawOptions &)>, const char *> cases[] = {
      {[](auto &o) { o.elastic.youngs_modulus = 0; }, "youngs_modulus"},
      {[](auto &o) { o.elastic.poisson_ratio = 0.5; }, "poisson_ratio"},
      {[](auto &o) { o.friction_angle_peak = 10; }, "friction_angle_peak"},
      {[](auto &o) { o.friction_angle_peak = 61; }, "friction_angle_peak"},
      {[](auto &o) { o.friction_angle_residual = NAN; }, "friction_angle_residual"},
      {[](auto &o) { o.dilatancy_angle_peak = 21; }, "dilatancy_angle_peak"},
      {[](auto &o) { o.dilatancy_angle_peak = 14, o.dilatancy_angle_residual = 14; }, "dilatancy_angle_residual"},
      {[](auto &o) { o.dilatancy_angle_residual = 13; }, "dilatancy_angle_residual"},
      {[](auto &o) { o.cohesion = -1; }, "cohesion"},
      {[](auto &o) { o.cohesion_residual = 0.02; }, "cohesion_residual"},
      {[](auto &o) { o.softening_strain = 0; }, "softening_strain"},
      {[](auto &o) { o.viscosity = -1; }, "viscosity"},
      {[](auto &o) { o.internal_length = 0; }, "internal_length"},
      {[](auto &o) { o.couple_shear_ratio = 0; }, "couple_shear_ratio"},
      {[](auto &o) { o = hardenings()["mobilisation"], o.friction_angle_start = 21; }, "friction_angle_start"},
      {[](auto &o) { o = hardenings()["mobilisation"], o.friction_angle_start = 11; }, "dilatancy_angle_peak"},
      {[](auto &o) { o = hardenings()["mobilisation"], o.mobilisation_strain = 0; }, "mobilisation_strain"},
      {[](auto &o) { slow_mobilisation(o); }, "mobilisation_strain"},
      {[](auto &o) { o = critical(0.9, 0.1), o.dilatancy_ratio = 0.2; }, "dilatancy_ratio"},
      {[](auto &o) { o = critical(1.2, 0.1); }, "solid_fraction_start"},
      {[](auto &o) { o = critical(0.85, -0.1); }, "stress_ratio_start"},
      {[](auto &o) { o = critical(0.85, 0.1), o.critical_stress_ratio = 0; }, "critical_stress_ratio"},
      {[](auto &o) { o = critical(0.85, 0.1), o.strength_by_density = 0; }, "strength_by_density"},
      {[](auto &o) { o = constant(0, 0, 0); }, "friction_angle_peak"},
      {[](auto &o) { o.hardening = kind_of<TableHardening>; }, "table_strain"},
      {[](auto &o) { o = hardenings()["table"], o.table_cohesion.pop_back(); }, "table_cohesion"},
      {[](auto &o) { o = hardenings()["table"], o.table_strain[0] = 0.01; }, "table_strain"},
      {[](auto &o) { o = hardenings()["table"], o.table_strain[2] = 0.02; }, "table_strain"},
      {[](auto &o) { o = hardenings()["table"], o.table_dilatancy_angle[1] = 31; }, "table_dilatancy_angle"},
    };
    for (const auto &[change, key] : cases)
      {
        LawOptions options;
        EXPECT_NO_THROW(validate(law, options));
        change(options);
        try
          {
            validate(law, options);
            FAIL() << "no error for " << key;
          }
        catch (const WrongKeys &error)
          {
            EXPECT_EQ(std::count(error.keys.begin(), error.keys.end(), key), 1) << key << ": " << error.what();
          }
        EXPECT_THROW(make_law(law, options), std::invalid_argument) << key;
      }
    EXPECT_NO_THROW(validate(law, constant(0, 0, 1)));
    EXPECT_NO_THROW(validate(law, constant(30, 30, 0)));
    EXPECT_NO_THROW(validate(law, constant(10, 0, 0.1))) << "residual values are not checked";
  }

  double eta(const Hardening &hardening, const HardeningState &state)
  {
    return std::sin(hardening.at(state).friction.value);
  }

  // Far along the path: eta = eta_c, no dilation, solid fraction nu_c, from either side.
  TEST(CriticalState, EndsInSteadyFlow)
  {
    for (const double solid_fraction : {0.86, 0.78})
      {
        const Hardening      hardening(critical(solid_fraction, 0.1));
        const HardeningState end = hardening.after({}, 3);
        EXPECT_NEAR(eta(hardening, end), 0.26, 1e-9);
        EXPECT_NEAR(hardening.at(end).dilatancy.value, 0, 1e-9);
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
        (hardening.at(hardening.after({}, middle)).friction.rate > 0 ? low : high) = middle;
      }
    const HardeningState peak   = hardening.after({}, low);
    const double solid_fraction = 0.86 * std::exp(peak.densification), sine = std::sin(hardening.at(peak).dilatancy.value);
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
            EXPECT_NEAR((up.densification - down.densification) / (2 * h), -std::sin(hardening.at(here).dilatancy.value), 1e-7)
              << g;
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
          EXPECT_NEAR(c.dilation.value * step, here.densification - end.densification, 1e-9 * step + 1e-14) << step;
          EXPECT_EQ(c.slope.value, cone.at(end).slope.value);
          const double h = 0.05 * step;
          EXPECT_NEAR((cone.over(here, step + h).dilation.value - cone.over(here, step - h).dilation.value) / (2 * h),
                      c.dilation.rate, 2e-3 * std::abs(c.dilation.rate) + 1e-8 / step)
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
