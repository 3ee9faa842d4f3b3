// diptych: hardening that unloads and reverses
// SPDX-License-Identifier: LGPL-2.1-or-later
#include "continuum/equilibrium/point_operations.h"
#include "continuum/laws/plastic_flow.h"
#include "tests/continuum/laws/law_states.h"

namespace
{
  using namespace diptych::continuum::tests;

  const std::vector<LawKind> laws = {LawKind::drucker_prager, LawKind::cosserat_drucker_prager, LawKind::cosserat_mohr_coulomb};

  LawOptions kinematic(const double solid_fraction)
  {
    LawOptions o          = critical(solid_fraction, 0.2);
    o.hardening           = kind_of<KinematicHardening>;
    o.mobilisation_strain = 0.03;
    o.cohesion            = 0.1;
    return o;
  }

  const Stress &back_stress(const MaterialState &state)
  {
    return part_of<KinematicState>(state).back_stress_ratio;
  }

  // The state after a shear strain in some direction, where the axis of the cone has left the origin.
  MaterialState sheared(const Law &law, const double angle, const double strain)
  {
    MaterialState state = state_of(-1, -1, -1);
    for (int k = 0; k < 20; ++k)
      state = update(law, state, strain / 20 * strain_of(std::cos(angle) / 2, -std::cos(angle) / 2, std::sin(angle))).state;
    return state;
  }

  TEST(Kinematic, TangentAgreesWithDifferencesInEveryRegime)
  {
    for (const double viscosity : {0., 0.05})
      for (const double solid_fraction : {0.80, 0.85})
        for (const LawKind name : laws)
          {
            LawOptions options        = kinematic(solid_fraction);
            options.viscosity         = viscosity;
            const Law             law = make_law(name, options);
            std::map<Regime, int> seen;
            for (const double strain : {0., 0.02, 0.1})
              for (const double size : {1e-5, 1e-3, 5e-3, 2e-2})
                for (const Strain &e : random_strains(60, size))
                  if (const auto error = tangent_error(law, sheared(law, 1, strain), e))
                    {
                      const MaterialUpdate answer = update(law, sheared(law, 1, strain), e);
                      ++seen[answer.regime];
                      EXPECT_EQ(answer.verdict, Verdict::reliable);
                      EXPECT_LT(*error, 1e-6) << name_of(name) << ", regime " << int(answer.regime) << ", strain " << e;
                      if (answer.regime != Regime::elastic)
                        {
                          EXPECT_NEAR(yield_function(law, answer.state), answer.state.overstress, 1e-11);
                        }
                    }
            EXPECT_GE(seen[Regime::elastic], 50);
            EXPECT_GE(seen[Regime::plastic], 100);
            EXPECT_GE(seen[Regime::apex], viscosity > 0 ? 0 : 10) << name_of(name); // viscosity carries tension beyond the tip
          }
  }

  // A turned state under a turned strain gives the turned answer; so does the axis of the cone.
  TEST(Kinematic, DoesNotDependOnTheAxes)
  {
    for (const LawKind name : laws)
      {
        const Law     law   = make_law(name, kinematic(0.85));
        MaterialState state = sheared(law, 0, 0.03), other = state;
        turn(other, 0.7);
        for (const Strain &e : random_strains(20, 5e-3))
          {
            Stress as_stress = e; // a strain turns as a stress does, apart from its engineering shear
            as_stress[xy] /= 2;
            turn(as_stress, 0.7);
            as_stress[xy] *= 2;
            MaterialState one = update(law, state, e).state;
            turn(one, 0.7);
            const MaterialState two = update(law, other, as_stress).state;
            EXPECT_NEAR((one.stress - two.stress).norm(), 0, 1e-11) << name_of(name);
            EXPECT_NEAR((back_stress(one) - back_stress(two)).norm(), 0, 1e-11) << name_of(name);
          }
      }
  }

  TEST(Kinematic, DissipationIsNeverNegativeUnderPressure)
  {
    for (const double solid_fraction : {0.80, 0.85})
      for (const LawKind name : laws)
        {
          const Law     law   = make_law(name, kinematic(solid_fraction));
          MaterialState state = state_of(-1, -1, -1);
          int           seen = 0, k = 0;
          for (const Strain &e : random_strains(400, 3e-3))
            {
              if (k++ % 50 == 0)
                state = state_of(-1, -1, -1);
              MaterialUpdate answer = update(law, state, e);
              ASSERT_NE(answer.verdict, Verdict::failed) << name_of(name) << ' ' << e;
              add_plastic_flow(moduli_of(law), state, e, answer.state);
              const Stress &s = answer.state.stress;
              if (answer.regime == Regime::plastic && s[xx] + s[yy] + answer.state.stress_zz < 0 && s[xx] + s[yy] < 0)
                {
                  ++seen;
                  EXPECT_GE(answer.state.dissipation - state.dissipation, -1e-13) << name_of(name);
                }
              state = answer.state;
            }
          EXPECT_GE(seen, 100);
        }
  }

  // beta = 1: along a path without reversal both laws have the same equations, so that the stress agrees to the step's error.
  TEST(Kinematic, IsTheCriticalStateUntilTheLoadReverses)
  {
    LawOptions options      = kinematic(0.85);
    options.dilatancy_ratio = 1;
    options.cohesion        = 0;
    const Law moving        = make_law(LawKind::cosserat_mohr_coulomb, options);
    options.hardening       = kind_of<CriticalStateHardening>;
    const Law     fixed     = make_law(LawKind::cosserat_mohr_coulomb, options);
    MaterialState a = state_of(-1, -1, -1), b = a;
    for (int k = 0; k < 1000; ++k)
      {
        a = update(moving, a, strain_of(5e-5, -5e-5)).state;
        b = update(fixed, b, strain_of(5e-5, -5e-5)).state;
      }
    EXPECT_NEAR((a.stress - b.stress).norm() / b.stress.norm(), 0, 1e-3);
    EXPECT_NEAR(hardening_state(a).densification, hardening_state(b).densification, 1e-4);
  }

  // Density without effect: R' = (R_l n - R)/g_r with R_l = 0.26 - 0.05. After shear to kappa_1 and back, n = -1:
  //   R = -R_l + (R_1 + R_l) exp(-(kappa - kappa_1)/g_r).
  TEST(Kinematic, ReversesAlongAnExponential)
  {
    LawOptions options          = kinematic(0.82);
    options.strength_by_density = 1e-6;
    const Law     law           = make_law(LawKind::cosserat_mohr_coulomb, options);
    MaterialState state         = sheared(law, 0, 0.05);
    const double  start = back_stress(state)[xx], kappa = state.equivalent_plastic_strain;
    EXPECT_NEAR(start, 0.21 * (1 - std::exp(-kappa / 0.03)), 1e-5);
    for (int k = 0; k < 30; ++k)
      state = update(law, state, strain_of(-5e-4, 5e-4)).state;
    const double since = state.equivalent_plastic_strain - kappa;
    EXPECT_GT(since, 0.02);
    EXPECT_NEAR(back_stress(state)[xx], -0.21 + (start + 0.21) * std::exp(-since / 0.03), 1e-5);
  }

  TEST(Kinematic, IsRefusedInPrincipalSpace)
  {
    diptych::tests::expect_refused({"law = mohr_coulomb", "hardening = kinematic", "drucker_prager"},
                                   [&] { make_law(LawKind::mohr_coulomb, kinematic(0.85)); });
  }
} // namespace
