// diptych: requirements on every constitutive law, at single points
// SPDX-License-Identifier: LGPL-2.1-or-later
#include "continuum/laws/plastic_flow.h"
#include "tests/continuum/laws/law_states.h"

namespace
{
  using namespace diptych::continuum::tests;

  // Start states and strain sizes that reach every regime: isotropic, softened, stretched, sigma_zz as an outer stress.
  struct Start
  {
    MaterialState state;
    double        size;
  };

  std::vector<Start> starts()
  {
    return {{state_of(-1, -1, -1), 1e-5},
            {state_of(-1, -1, -1), 5e-3},
            {state_of(-1, -1, -1, 0.06), 5e-3},
            {state_of(-.01, -.01, -.01), 2e-3},
            {state_of(-1.2, -1, -1.7, 0.01), 4e-3},
            {state_of(-1, -1.2, -.65, 0.01), 4e-3},
            {state_of(-.05, -.05, -.05, .03), 8e-3},
            {state_of(.1, .1, .1), 4e-3}};
  }

  TEST(Laws, TangentAgreesWithDifferencesInEveryRegime)
  {
    for (const auto &[hardening, options] : hardenings())
      for (const LawKind name : all_laws())
        {
          if (!accepts(name, options))
            continue;
          const Law             law = make_law(name, options);
          std::map<Regime, int> seen;
          for (const Start &start : starts())
            for (const Strain &e : random_strains(80, start.size))
              if (const auto error = tangent_error(law, start.state, e))
                {
                  const MaterialUpdate answer = update(law, start.state, e);
                  ++seen[answer.regime];
                  EXPECT_EQ(answer.verdict, Verdict::reliable);
                  EXPECT_LT(*error, 1e-6) << name_of(name) << ", " << hardening << ", regime " << int(answer.regime)
                                          << ", strain " << e;
                }
          EXPECT_GE(seen[Regime::elastic], 20) << name_of(name);
          if (name == LawKind::linear_elastic)
            continue;
          EXPECT_GE(seen[Regime::plastic], 30) << name_of(name) << ", " << hardening;
          EXPECT_GE(seen[Regime::apex], 10) << name_of(name) << ", " << hardening;
          EXPECT_EQ(seen[Regime::edge] >= 10, name == LawKind::mohr_coulomb) << hardening << " edges: " << seen[Regime::edge];
        }
  }

  // F of the end state is the viscous part: zero without viscosity, otherwise (viscosity/d_time) times the growth of kappa.
  TEST(Laws, PlasticStatesLieOnTheYieldSurfaceOfTheEnd)
  {
    for (const auto &[hardening, options] : hardenings())
      for (const LawKind name : plastic_laws)
        {
          if (!accepts(name, options))
            continue;
          const Law law     = make_law(name, options);
          int       plastic = 0;
          for (const Start &start : starts())
            for (const Strain &e : random_strains(20, start.size))
              {
                const MaterialUpdate answer = update(law, start.state, e);
                if (answer.regime == Regime::elastic)
                  continue;
                ++plastic;
                const double growth = answer.state.equivalent_plastic_strain - start.state.equivalent_plastic_strain;
                EXPECT_GT(growth, 0);
                EXPECT_NEAR(answer.state.overstress, options.viscosity / 1e-3 * growth, 1e-11);
                EXPECT_NEAR(yield_function(law, answer.state), answer.state.overstress, 1e-11)
                  << name_of(name) << ", " << hardening;
              }
          EXPECT_GT(plastic, 40);
        }
  }

  // The checks of the command check-law: random paths with reversals.
  TEST(Laws, PassTheChecksForLawsOfTheUser)
  {
    for (const auto &[hardening, options] : hardenings())
      for (const LawKind name : all_laws())
        for (const LawCheck &check : accepts(name, options) ? check_law(make_law(name, options), {}) : std::vector<LawCheck>())
          EXPECT_TRUE(check.holds()) << name_of(name) << ", " << hardening << ", " << check.name << ": " << check.deviation
                                     << check.trouble << ' ' << check.where << ' ' << check.n_judged << ' ' << check.n_not_judged;
  }

  TEST(Laws, DoNotDependOnTheAxes)
  {
    const LawOptions options = hardenings()["exponential"];
    for (const LawKind name : all_laws())
      {
        const Law law = make_law(name, options);
        for (const double szz : {-1., -1.7, -.5})
          for (const Strain &e : random_strains(20, 5e-3))
            {
              const MaterialState s0 = state_of(-1, -1, szz);
              const Stress        a  = turned(update(law, s0, e).state.stress, 0.7, 1);
              const Stress        b  = update(law, s0, turned(e, 0.7, 2)).state.stress;
              EXPECT_NEAR((a - b).norm(), 0, 1e-11) << name_of(name);
            }
      }
  }

  // Paths of fifty random steps with intermittent tension, through every regime, also without cohesion.
  TEST(Laws, DissipationIsNeverNegative)
  {
    auto all            = hardenings();
    all["cohesionless"] = constant(30, 10, 0);
    all["associated"]   = constant(30, 30, 0.05);
    for (const auto &[hardening, options] : all)
      for (const LawKind name : plastic_laws)
        {
          if (!accepts(name, options))
            continue;
          const Law             law = make_law(name, options);
          MaterialState         state;
          std::map<Regime, int> seen;
          int                   k = 0;
          for (Strain e : random_strains(400, 3e-3))
            {
              if (k % 50 == 0)
                state = state_of(-.3, -.3, -.3);
              const double pull = 1e-3 * std::sin(0.3 * k++);
              e[xx] += pull, e[yy] += pull;
              MaterialUpdate answer = update(law, state, e);
              ASSERT_NE(answer.verdict, Verdict::failed) << name_of(name) << ", " << hardening;
              add_plastic_flow(moduli_of(law), state, e, answer.state);
              // Contraction does negative work in tension, which only cohesion can carry.
              if (hardening.find("critical state") == std::string::npos || largest_in_tension(answer.state) < 0)
                {
                  EXPECT_GE(answer.state.dissipation - state.dissipation, -1e-13) << name_of(name) << ", " << hardening;
                }
              state = answer.state;
              ++seen[answer.regime];
            }
          EXPECT_GT(state.dissipation, 1e-4) << name_of(name) << ", " << hardening;
          EXPECT_GE(seen[Regime::apex], 3) << name_of(name) << ", " << hardening;
          EXPECT_GE(seen[Regime::plastic], 50) << name_of(name) << ", " << hardening;
        }
  }

  // sigma : d eps is the sum of stored and plastic work. Neither a closed elastic loop nor an elastic step has plastic work.
  TEST(Laws, ElasticStepsLeaveNoPlasticStrain)
  {
    for (const LawKind name : all_laws())
      {
        const Law     law   = make_law(name, {});
        MaterialState state = state_of(-1, -1, -1);
        for (const Strain &e : random_strains(20, 1e-5))
          {
            MaterialUpdate answer = update(law, state, e);
            ASSERT_EQ(answer.regime, Regime::elastic);
            add_plastic_flow(moduli_of(law), state, e, answer.state);
            state = answer.state;
          }
        const PlasticStrain &p = state.plastic_strain;
        EXPECT_NEAR(std::abs(p.xx) + std::abs(p.yy) + std::abs(p.zz) + std::abs(p.xy), 0, 1e-15) << name_of(name);
        EXPECT_NEAR(state.dissipation, 0, 1e-15);
      }
  }

  // d eps_v / d lambda = sin psi for Mohr-Coulomb, lambda = d(eps_1 - eps_3). For Drucker-Prager it is 3 beta with beta = sin
  // psi/sqrt(9 + 3 sin^2 psi); psi = 12 degrees: 0.207912/3.021534 = 0.0688099, 3 beta = 0.206430.
  TEST(Laws, DilateByTheirAngle)
  {
    for (const LawKind name : plastic_laws)
      {
        const Law           law = make_law(name, constant(20.5, 12, 0.01));
        const MaterialState s0  = state_of(-1, -1, -1);
        const Strain        e   = strain_of(0.004, -0.004, 0.001);
        MaterialUpdate      end = update(law, s0, e);
        ASSERT_EQ(end.regime, Regime::plastic);
        add_plastic_flow(moduli_of(law), s0, e, end.state);
        const PlasticStrain &p        = end.state.plastic_strain;
        const bool           in_plane = is_mohr_coulomb(name);
        EXPECT_NEAR((p.xx + p.yy + p.zz) / end.state.equivalent_plastic_strain, in_plane ? sine(12) : 0.206430, 1e-6)
          << name_of(name);
        if (in_plane)
          {
            EXPECT_NEAR(std::hypot(p.xx - p.yy, p.xy), end.state.equivalent_plastic_strain, 1e-12);
          }
      }
  }

  // Beyond the cone the stress is that of the tip. Mohr-Coulomb: s = -c cot(phi) = -0.1 * 2.674621 for phi = 20.5. The matched
  // Drucker-Prager cone has the same value k/(3 alpha) = c cos phi/sin phi. The skew stress remains 0.5 G * 0.002, G = 500/2.4.
  TEST(Laws, ReturnToTheApexUnderTension)
  {
    for (const LawKind name : plastic_laws)
      {
        const Law law        = make_law(name, constant(20.5, 12, 0.1));
        Strain    e          = strain_of(0.01, 0.012, 0.001);
        e[relative_rotation] = 0.002, e[curvature_x] = 1e-4;
        const MaterialUpdate end = update(law, state_of(-.1, -.1, -.1), e);
        EXPECT_EQ(end.regime, Regime::apex) << name_of(name);
        EXPECT_NEAR(end.state.stress[xx], 0.2674621, 1e-7) << name_of(name);
        EXPECT_NEAR(end.state.stress[yy], 0.2674621, 1e-7);
        EXPECT_NEAR(end.state.stress[xy], 0, 1e-12);
        if (!traits(name).is_gradient)
          {
            EXPECT_NEAR(end.state.stress[curvature_x], 0, 1e-12);
            EXPECT_NEAR(end.state.stress[relative_rotation], traits(name).is_cosserat ? 0.5 * 500 / 2.4 * 0.002 : 0, 1e-12);
          }
        if (!traits(name).stays_in_plane()) // ignores sigma_zz
          {
            EXPECT_NEAR(end.state.stress_zz, 0.2674621, 1e-7);
          }
      }
  }

  // phi = 0: t = c for any pressure and no apex for any stretch. Drucker-Prager: sqrt(J2) = k = c for psi = 0.
  TEST(Laws, TrescaIsTheLimitWithoutFriction)
  {
    for (const LawKind name : plastic_laws)
      for (const double volume : {-0.01, 0., 0.01})
        {
          const Law            law = make_law(name, constant(0, 0, 0.3));
          const MaterialUpdate end = update(law, state_of(0, 0, 0), strain_of(volume + 0.01, volume - 0.01, 0.004));
          EXPECT_EQ(end.verdict, Verdict::reliable);
          EXPECT_NE(end.regime, Regime::apex);
          EXPECT_NEAR(yield_function(law, end.state), 0, 1e-12);
          const Stress &s  = end.state.stress;
          const double  t  = std::hypot((s[xx] - s[yy]) / 2, s[xy]);
          const double  J3 = end.state.stress_zz - (s[xx] + s[yy]) / 2; // = (3/2) s_zz'
          // J2 = t^2 + (3/4) s_zz'^2.
          EXPECT_NEAR(is_mohr_coulomb(name) ? t : std::sqrt(t * t + J3 * J3 / 3), 0.3, 1e-9) << name_of(name);
        }
  }

  // In a step without strain the overstress relaxes: F = (viscosity/d_time) lambda. Zero d_time means rate independent.
  TEST(Laws, OverstressRelaxesAndNeedsTime)
  {
    LawOptions options = constant(20.5, 12, 0.1);
    options.viscosity  = 0.05;
    for (const LawKind name : plastic_laws)
      {
        const Law            law   = make_law(name, options);
        const Strain         e     = strain_of(0.004, -0.004);
        const MaterialUpdate fast  = update(law, state_of(-1, -1, -1), e, 1e-4);
        const MaterialUpdate slow  = update(law, state_of(-1, -1, -1), e, 1e-2);
        const MaterialUpdate still = update(law, state_of(-1, -1, -1), e, 0);
        EXPECT_GT(fast.state.overstress, 3 * slow.state.overstress) << name_of(name);
        EXPECT_GT(slow.state.overstress, 0);
        EXPECT_EQ(still.state.overstress, 0);
        EXPECT_NEAR(yield_function(law, still.state), 0, 1e-12);
        const MaterialUpdate rest = update(law, fast.state, {}, 1e-4);
        EXPECT_LT(rest.state.overstress, fast.state.overstress);
        EXPECT_GT(rest.state.overstress, 0);
      }
  }

  TEST(Laws, KeepTheCommittedStateAndFailOnNaN)
  {
    for (const LawKind name : all_laws())
      {
        const Law           law   = make_law(name, {});
        const MaterialState state = state_of(-1, -1, -1, 0.01), before = state;
        EXPECT_NE(update(law, state, strain_of(0.01, -0.02, 0.003)).verdict, Verdict::failed);
        EXPECT_EQ(state.stress, before.stress);
        EXPECT_EQ(state.equivalent_plastic_strain, before.equivalent_plastic_strain);
        EXPECT_EQ(update(law, state, strain_of(NAN, 0)).verdict, Verdict::failed) << name_of(name);
        EXPECT_EQ(update(law, state, strain_of(0, 0, INFINITY)).verdict, Verdict::failed) << name_of(name);
      }
  }

  // -dF/dlambda = G + s cos(phi) dphi/dkappa, with phi from 40 to 10 degrees over 0.003: dphi/dkappa = -174.5, G = 208.3. At
  // kappa = 0 it is 141 for s = 0.5, 8 for s = 1.5 and -59 for s = 2. In the last case the point snaps back.
  TEST(Laws, SnapBackIsNeverCalledReliable)
  {
    LawOptions options              = constant(40, 0, 0.01);
    options.hardening               = kind_of<ExponentialHardening>;
    options.friction_angle_residual = 10, options.dilatancy_angle_residual = 0;
    options.softening_strain = 0.003;
    for (const LawKind name : {LawKind::mohr_coulomb, LawKind::cosserat_mohr_coulomb})
      {
        const Law law = make_law(name, options);
        // t at yield is s sin(40) + 0.01 cos(40). The strain exceeds it by a millionth.
        const auto just_beyond = [&](const double s) {
          const double difference = (s * sine(40) + 0.01 * sine(50)) / moduli_of(law).shear * (1 + 1e-6);
          return update(law, state_of(-s, -s, -s), strain_of(difference / 2, -difference / 2));
        };
        EXPECT_EQ(just_beyond(0.5).regime, Regime::plastic);
        EXPECT_EQ(just_beyond(0.5).verdict, Verdict::reliable);
        EXPECT_EQ(just_beyond(1.5).verdict, Verdict::unreliable) << name_of(name);
        EXPECT_EQ(just_beyond(2).verdict, Verdict::unreliable) << name_of(name);
      }
  }

  // The traits agree with the behaviour: only a law with a length answers to the unknown of the corners, only a plastic law
  // yields.
  TEST(Laws, MatchTheirTraits)
  {
    Strain rotation{}, shear = strain_of(0, 0, 1);
    rotation[relative_rotation] = 1;
    for (const LawKind name : all_laws())
      {
        const Law law = make_law(name, {});
        EXPECT_EQ(update(law, state_of(-1, -1, -1), rotation).state.stress[relative_rotation] != 0, traits(name).has_length())
          << name_of(name);
        EXPECT_EQ(update(law, state_of(-1, -1, -1), shear).regime != Regime::elastic, traits(name).is_plastic) << name_of(name);
      }
  }

  // A law with parameters in units of a pressure P and a mean diameter d is the law of P = d = 1, times P.
  TEST(Laws, ScaleWithPressureAndDiameter)
  {
    const Units si{1e4, 1e-3};
    LawOptions  options = constant(25, 5, 0.1);
    options.viscosity   = 0.01;
    const Strain e      = strain_of(0.003, -0.02, 0.004);
    for (const LawKind name : all_laws())
      {
        Strain bent       = e;
        bent[curvature_x] = 0.01, bent[curvature_y] = -0.02;
        const auto one = update(make_law(name, options), state_of(-1, -1, -1), bent);
        bent[curvature_x] /= si.length, bent[curvature_y] /= si.length;
        const auto other = update(make_law(name, options, si), state_of(-1e4, -1e4, -1e4), bent);
        EXPECT_EQ(one.regime, other.regime);
        for (const auto component : {xx, yy, xy})
          EXPECT_NEAR(other.state.stress[component] / 1e4, one.state.stress[component], 1e-12) << name_of(name);
        EXPECT_NEAR(other.state.stress[curvature_x] / (1e4 * 1e-3), one.state.stress[curvature_x], 1e-12) << name_of(name);
        EXPECT_NEAR(other.state.equivalent_plastic_strain, one.state.equivalent_plastic_strain, 1e-13) << name_of(name);
      }
  }
} // namespace
