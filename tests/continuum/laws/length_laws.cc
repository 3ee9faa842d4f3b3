// diptych: laws with an internal length, at single points
// SPDX-License-Identifier: LGPL-2.1-or-later
#include "tests/continuum/laws/law_states.h"

namespace
{
  using namespace diptych::continuum::tests;

  // Without rotation and curvature a Cosserat law is the classical one, for Mohr-Coulomb if sigma_zz is intermediate.
  TEST(Cosserat, WithoutRotationsIsTheClassicalLaw)
  {
    const LawOptions options = hardenings()["exponential"];
    for (const auto &[cosserat, classical] : {std::pair(LawKind::cosserat_mohr_coulomb, LawKind::mohr_coulomb),
                                              std::pair(LawKind::cosserat_drucker_prager, LawKind::drucker_prager)})
      for (const double gamma : {0., 0.003})
        {
          const Strain e = strain_of(0.003, -0.004, gamma);
          const auto   a = update(make_law(cosserat, options), state_of(-1, -1, -1), e);
          const auto   b = update(make_law(classical, options), state_of(-1, -1, -1), e);
          EXPECT_EQ(b.regime, Regime::plastic);
          EXPECT_NEAR((a.state.stress - b.state.stress).norm(), 0, 1e-13);
          EXPECT_NEAR(a.state.stress_zz, b.state.stress_zz, 1e-13);
          EXPECT_NEAR(a.state.equivalent_plastic_strain, b.state.equivalent_plastic_strain, 1e-15);
        }
  }

  // Pure bending: |m|/(sqrt2 l) grows to s sin(phi) + c cos(phi). With s = 1, phi = 30, c = 0.1, psi = 0 this is 0.5 +
  // 0.0866025. The skew stress stays elastic, a = Gc chi, at any size. For psi = 0 and sigma_zz = s_zz' = 0 Drucker-Prager has
  // 3 alpha = sin phi.
  TEST(Cosserat, CoupleStressYieldsAndSkewStressDoesNot)
  {
    for (const LawKind name : {LawKind::cosserat_mohr_coulomb, LawKind::cosserat_drucker_prager})
      {
        LawOptions options      = constant(30, 0, 0.1);
        options.internal_length = 2;
        const Law law           = make_law(name, options);
        Strain    e;
        e[curvature_x] = 0.03, e[curvature_y] = -0.04, e[relative_rotation] = 0.5;
        const MaterialUpdate end = update(law, state_of(-1, -1, -1), e);
        EXPECT_EQ(end.regime, Regime::plastic);
        const Stress &s = end.state.stress;
        EXPECT_NEAR(std::hypot(s[curvature_x], s[curvature_y]) / (std::sqrt(2.) * 2), 0.5866025, 1e-7) << name_of(name);
        EXPECT_NEAR(s[curvature_x] / s[curvature_y], -0.75, 1e-12);
        EXPECT_NEAR(s[relative_rotation], 0.5 * 500 / 2.4 * 0.5, 1e-10);
        EXPECT_NEAR(end.tangent[relative_rotation][relative_rotation], 0.5 * 500 / 2.4, 1e-10);
      }
  }

  // M = 2 G l^2 and Gc = ratio G, in the elastic tangent and before yield.
  TEST(Cosserat, ElasticModuliAreThoseOfDeBorst)
  {
    LawOptions options;
    options.internal_length = 3, options.couple_shear_ratio = 0.25;
    const ConeLaw law(options, ConeShape::drucker_prager, true);
    const double  G = 500 / 2.4;
    EXPECT_NEAR(law.elastic_tangent()[curvature_x][curvature_x], 2 * G * 9, 1e-10);
    EXPECT_NEAR(law.elastic_tangent()[relative_rotation][relative_rotation], G / 4, 1e-12);
    EXPECT_NEAR(law.elastic_tangent()[xx][yy], 500 * .2 / (1.2 * .6), 1e-10); // E nu/((1 + nu)(1 - 2 nu))
    EXPECT_NEAR(law.elastic_tangent()[xx][xx], 500 * .8 / (1.2 * .6), 1e-10); // E (1 - nu)/((1 + nu)(1 - 2 nu))
    EXPECT_EQ(MohrCoulomb(options).elastic_tangent()[curvature_x][curvature_x], 0);
  }

  // phi = 30 -> 20 degrees over kappa = 0.1, here at kappa = 0.03: (1 - m) 0.03 + m kbar is 0.05 for m = 2, kbar = 0.04, that is
  // phi = 25. The rise of mobilisation, from 10 degrees, reads kappa only: its softening is 20 + 10 exp(-0.05/0.05), its deficit
  // 20 exp(-0.03/0.03).
  TEST(Gradient, SoftensWithTheNonlocalVariableAndRisesWithTheLocalOne)
  {
    LawOptions o            = constant(30, 0, 0);
    o.hardening             = kind_of<TableHardening>;
    o.table_strain          = {0, 0.1};
    o.table_friction_angle  = {30, 20};
    o.table_dilatancy_angle = o.table_cohesion = {0, 0};
    HardeningState state{0.03};
    state.nonlocal_plastic_strain = 0.04;
    EXPECT_NEAR(Hardening(o, 2).at(state).friction.value, 25 * degree, 1e-12);
    EXPECT_NEAR(Hardening(o, 2).at(state).friction.rate, 100 * degree, 1e-12); // falls with kbar, rises with kappa
    EXPECT_NEAR(Hardening(o, 2).sines_by_nonlocal(state).friction.rate, -200 * degree * std::cos(25 * degree), 1e-12);
    o.table_strain          = {0, 0.03, 0.13};
    o.table_friction_angle  = {10, 30, 20}; // rises by 20, and falls from the softening variable 0.03 on
    o.table_dilatancy_angle = o.table_cohesion = {0, 0, 0};
    EXPECT_NEAR(Hardening(o, 2).at(state).friction.value, 28 * degree, 1e-12);
    EXPECT_NEAR(Hardening(o, 2).sines_by_nonlocal(state).friction.rate, -200 * degree * std::cos(28 * degree), 1e-12);
    LawOptions m              = constant(30, 0, 0);
    m.hardening               = kind_of<MobilisationHardening>;
    m.friction_angle_residual = 20, m.dilatancy_angle_residual = 0, m.friction_angle_start = 10;
    m.softening_strain = 0.05, m.mobilisation_strain = 0.03;
    EXPECT_NEAR(Hardening(m, 2).at(state).friction.value, (20 - 10 * std::exp(-1.)) * degree, 1e-12);
    EXPECT_THROW(make_law(LawKind::gradient_drucker_prager, critical(0.82, 0.1)), std::invalid_argument);
  }

  // With kbar = kappa throughout the gradient law is the classical one: no component `nonlocal` of the stress.
  TEST(Gradient, InUniformDeformationIsTheClassicalLaw)
  {
    const LawOptions options = hardenings()["table"];
    for (const LawKind name : {LawKind::gradient_mohr_coulomb, LawKind::gradient_drucker_prager})
      {
        const MaterialState s0 = state_of(-1, -1, -1, 0.03);
        Strain              e  = strain_of(0.003, -0.004, 0.001);
        const auto          b  = update(make_uniform_law(name, options), s0, e);
        e[nonlocal]            = b.state.equivalent_plastic_strain - s0.equivalent_plastic_strain;
        const auto    a        = update(make_law(name, options), s0, e);
        const Tangent D        = uniform_tangent(a.tangent);
        EXPECT_EQ(b.regime, Regime::plastic);
        EXPECT_NEAR((a.state.stress - b.state.stress).norm(), 0, 1e-12) << name_of(name);
        EXPECT_NEAR(a.state.equivalent_plastic_strain, b.state.equivalent_plastic_strain, 1e-15);
        for (const Component i : {xx, yy, xy})
          for (const Component j : {xx, yy, xy})
            EXPECT_NEAR(D[i][j], b.tangent[i][j], 1e-9 * E);
      }
  }
} // namespace
