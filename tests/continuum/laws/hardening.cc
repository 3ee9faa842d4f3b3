// diptych: strength as a function of plastic strain, and refused parameters
// SPDX-License-Identifier: LGPL-2.1-or-later
#include <algorithm>
#include <cmath>
#include <functional>

#include <gtest/gtest.h>

#include "continuum/laws/yield_cone.h"
#include "continuum/require.h"
#include "tests/continuum/laws/law_states.h"

namespace
{
  using namespace diptych::continuum;
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
            EXPECT_NEAR((up.slope - down.slope) / (2 * h), c.slope_rate, 1e-6) << name;
            EXPECT_NEAR((up.intercept - down.intercept) / (2 * h), c.intercept_rate, 1e-6) << name;
            EXPECT_NEAR((up.dilation - down.dilation) / (2 * h), c.dilation_rate, 1e-6) << name;
          }
  }

  // Table 15 -> 30 -> 22 degrees at 0, 0.02, 0.1: halfway 22.5; at 0.06 26; beyond 22. Exponential at kappa_s: 13.5 + 7/e.
  TEST(Hardening, FollowsTableAndDecay)
  {
    const Hardening table(hardenings()["table"]), decay(LawOptions{}), constant_(constant(20.5, 12, 0.1));
    EXPECT_NEAR(table.at(0).friction / degree, 15, 1e-12);
    EXPECT_NEAR(table.at(0.01).friction / degree, 22.5, 1e-12);
    EXPECT_NEAR(table.at(0.06).friction / degree, 26, 1e-12);
    EXPECT_NEAR(table.at(0.06).dilatancy / degree, 7, 1e-12);
    EXPECT_NEAR(table.at(0.06).cohesion, 0.05, 1e-12);
    EXPECT_NEAR(table.at(7).friction / degree, 22, 1e-12);
    EXPECT_NEAR(decay.at(0.075).friction / degree, 13.5 + 7 * std::exp(-1), 1e-12);
    EXPECT_NEAR(decay.at(5).cohesion, 0.01, 1e-15) << "without a residual value cohesion is constant";
    // 13.5 + 7 exp(-k/0.05) - 7.5 exp(-k/0.01) is 13 at the start and later that of `exponential`. Dilatancy is always that of
    // `exponential`.
    const Hardening rising(hardenings()["mobilisation"]), falling(hardenings()["exponential"]);
    EXPECT_NEAR(rising.at(0).friction / degree, 13, 1e-12);
    EXPECT_NEAR(rising.at(0.01).friction / degree, 13.5 + 7 * std::exp(-0.2) - 7.5 * std::exp(-1), 1e-12);
    EXPECT_NEAR(rising.at(0.3).friction, falling.at(0.3).friction, 1e-12);
    EXPECT_EQ(rising.at(0.01).dilatancy, falling.at(0.01).dilatancy);
    EXPECT_NEAR(constant_.at(9).friction / degree, 20.5, 1e-12);
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
} // namespace
