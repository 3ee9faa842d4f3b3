// diptych: one point along paths on which any strain or stress is prescribed
// SPDX-License-Identifier: LGPL-2.1-or-later
#include "continuum/laws/material_point.h"
#include "tests/continuum/laws/law_states.h"

namespace
{
  using namespace diptych::continuum::tests;

  // From an isotropic stress of 1; the first row is the start.
  PointPath path_of(const Controls &controls, const std::vector<Eigen::Vector3d> &values)
  {
    PointPath path;
    path.controls = controls;
    path.values   = values;
    return path;
  }

  std::vector<MaterialPointRow> rows_of(const LawKind law, const LawOptions &options, const PointPath &path)
  {
    const MaterialPointReport report = drive_material_point(law, options, {}, path);
    EXPECT_EQ(report.status, MaterialPointStatus::finished) << name_of(law) << ": " << report.message;
    return report.rows;
  }

  // E = 500, nu = 0.2: G = 208.333, oedometer modulus E (1 - nu)/((1 + nu)(1 - 2 nu)) = 555.556, K0 = nu/(1 - nu) = 0.25. At
  // constant volume the stresses change by +-2 G e_yy; at constant mean stress also, as this is elastically the same.
  TEST(MixedControl, ElasticSlopesAreTheClosedForms)
  {
    const double e = 1e-5, shear = 500 / 2.4;
    for (const LawKind law : all_laws())
      {
        const auto oedometer = rows_of(law, {}, path_of({Control::eyy, Control::exx, Control::exy}, {{0, 0, 0}, {e, 0, 0}}));
        EXPECT_NEAR((oedometer[1].syy - 1) / e, 500 * 0.8 / 0.72, 1e-6) << name_of(law);
        EXPECT_NEAR((oedometer[1].sxx - 1) / (oedometer[1].syy - 1), 0.25, 1e-9);
        for (const auto &[control, constant] : {std::pair(Control::volume, 0.), std::pair(Control::mean_stress, 1.)})
          {
            const auto rows = rows_of(law, {},
                                      path_of({Control::eyy, control, Control::sxy}, {{0, constant, 0}, {e, constant, 0}}));
            EXPECT_NEAR((rows[1].syy - 1) / e, 2 * shear, 1e-6) << name_of(law);
            EXPECT_NEAR((rows[1].sxx - 1) / e, -2 * shear, 1e-6) << name_of(law);
            EXPECT_NEAR(rows[1].exx, -e, 1e-15) << name_of(law);
          }
        const auto sheared = rows_of(law, {}, path_of({Control::exy, Control::syy, Control::exx}, {{0, 1, 0}, {e, 1, 0}}));
        EXPECT_NEAR(sheared[1].sxy / e, 2 * shear, 1e-6) << name_of(law);
        EXPECT_NEAR(sheared[1].szz, 1, 1e-9) << name_of(law);
      }
  }

  // A path of one kind of control gives the strains or stresses that another kind prescribes. The state, with its shear, then is
  // the same.
  TEST(MixedControl, TheAnswerIsTheSameWhateverIsPrescribed)
  {
    for (const LawKind law : all_laws())
      {
        PointPath path = path_of({Control::eyy, Control::exy, Control::sxx}, {});
        for (int k = 0; k <= 20; ++k)
          path.values.emplace_back(1e-3 * k, 5e-4 * k, 1);
        const LawOptions options  = constant(30, 10, 0.1);
        const auto       mixed    = rows_of(law, options, path);
        const Controls   others[] = {{Control::exx, Control::eyy, Control::exy},
                                     {Control::mean_stress, Control::eyy, Control::exy}};
        for (const Controls &controls : others)
          {
            path.controls = controls;
            path.values.clear();
            for (const MaterialPointRow &row : mixed)
              path.values.emplace_back(controls[0] == Control::exx ? row.exx : (row.sxx + row.syy) / 2, row.eyy, row.exy);
            const auto again = rows_of(law, options, path);
            for (std::size_t k = 0; k < mixed.size(); ++k)
              {
                EXPECT_NEAR(again[k].syy, mixed[k].syy, 1e-7) << name_of(law) << ", row " << k;
                EXPECT_NEAR(again[k].sxy, mixed[k].sxy, 1e-7) << name_of(law) << ", row " << k;
                EXPECT_NEAR(again[k].exx, mixed[k].exx, 1e-9) << name_of(law) << ", row " << k;
                EXPECT_NEAR(again[k].dissipation, mixed[k].dissipation, 1e-8) << name_of(law) << ", row " << k;
              }
          }
      }
  }

  // t = s sin(30) + 0.1 cos(30) = 0.586603 at s = 1; Mohr-Coulomb with any dilatancy. At constant volume and psi = 0 the elastic
  // volume is constant, too, so s stays 1.
  TEST(MixedControl, PerfectPlasticityReachesItsStrengthAtTheGivenMeanStress)
  {
    for (const LawKind law : {LawKind::mohr_coulomb, LawKind::cosserat_mohr_coulomb})
      for (const NamedPath name : {NamedPath::constant_mean_stress, NamedPath::constant_volume})
        {
          const double dilatancy = name == NamedPath::constant_volume ? 0 : 10;
          const auto   rows      = rows_of(law, constant(30, dilatancy, 0.1), named_path(name, {1, 0.03, 1e-3}));
          EXPECT_NEAR((rows.back().sxx + rows.back().syy) / 2, 1, 1e-9) << name_of(law);
          EXPECT_NEAR((rows.back().syy - rows.back().sxx) / 2, 0.586603, 1e-6) << name_of(law);
          EXPECT_NEAR(rows.back().dilatancy_angle, dilatancy, 1e-3) << name_of(law);
          EXPECT_EQ(rows.back().verdict, PointVerdict::reliable);
        }
  }

  // After a reversal of the axial strain the stress first falls with the modulus of BeginsWithThePlaneStrainModulus and
  // dissipates nothing; reloading returns to the stress from which it fell.
  TEST(MixedControl, ReversalReturnsElastically)
  {
    for (const LawKind law : plastic_laws)
      {
        const LawOptions options = constant(30, 10, 0.1);
        const auto       rows    = rows_of(
                   law, options,
                   refined(path_of({Control::eyy, Control::sxx, Control::exy}, {{0, 1, 0}, {0.03, 1, 0}, {0.029, 1, 0}, {0.03, 1, 0}}),
                           1e-3));
        ASSERT_EQ(rows.size(), 33u);
        EXPECT_NEAR((rows[30].syy - rows[31].syy) / 1e-3, 500 / 0.96, 1e-5) << name_of(law);
        EXPECT_NEAR(rows[31].dissipation, rows[30].dissipation, 1e-12) << name_of(law);
        EXPECT_NEAR(rows[32].syy, rows[30].syy, 1e-7) << name_of(law);
        EXPECT_NEAR(rows[32].exx, rows[30].exx, 1e-9) << name_of(law);
      }
  }

  // In a small step the stresses change by the law's tangent at the step's end, apart from the curvature of the law: d sxx, d sxy
  // follow from the strains that the path finds. Simple shear at constant normal stress, in the plastic range.
  TEST(MixedControl, SimpleShearFollowsTheTangent)
  {
    for (const LawKind kind : all_laws())
      {
        const LawOptions options = constant(30, 10, 0.1);
        PointPath        path    = named_path(NamedPath::simple_shear, {1, 0.02, 1e-3});
        path.values.emplace_back(path.values.back()[0] + 1e-7, 1, 0);
        path.progress.push_back(path.progress.back() + 1e-7);
        const auto              rows = rows_of(kind, options, path);
        const MaterialPointRow &a = rows[rows.size() - 2], &b = rows.back();
        const Law               law    = make_law(kind, options);
        MaterialState           state  = state_of(-a.sxx, -a.syy, -a.szz, a.equivalent_plastic_strain);
        const Strain            d      = strain_of(a.exx - b.exx, a.eyy - b.eyy, 2 * (a.exy - b.exy));
        state.stress[xy]               = -a.sxy;
        const MaterialUpdate answer    = update(law, state, d);
        const Stress         predicted = answer.tangent * d;
        const double         scale     = E * d.norm();
        EXPECT_NEAR(a.sxx - b.sxx, predicted[xx], 1e-4 * scale) << name_of(kind);
        EXPECT_NEAR(a.sxy - b.sxy, predicted[xy], 1e-4 * scale) << name_of(kind);
        EXPECT_NEAR(0, predicted[yy], 1e-4 * scale) << name_of(kind);
        EXPECT_NEAR(b.exx, 0, 1e-15) << name_of(kind);
        EXPECT_NEAR(b.syy, 1, 1e-9) << name_of(kind);
      }
  }

  // The principal axes turn by 90 degrees at s = 1 and t = 0.3, below the strength: the elastic strain follows, t = 2 G e.
  TEST(MixedControl, TheAxesTurnAtConstantStress)
  {
    for (const LawKind law : all_laws())
      {
        PointPath path = path_of({Control::sxx, Control::syy, Control::sxy}, {{1, 1, 0}});
        for (int k = 0; k <= 18; ++k)
          {
            const double turn = 10 * k * degree;
            path.values.emplace_back(1 - 0.3 * std::cos(turn), 1 + 0.3 * std::cos(turn), 0.3 * std::sin(turn));
          }
        const auto rows = rows_of(law, constant(30, 10, 0.1), path);
        EXPECT_NEAR(rows[10].exy, 0.3 / (2 * 500 / 2.4), 1e-12) << name_of(law);
        EXPECT_NEAR(rows.back().exx - rows.back().eyy, 0.6 / (2 * 500 / 2.4), 1e-12) << name_of(law);
      }
  }

  // Equal strains in the plane, nu = 0.2: s_zz rises with 0.4 of the mean stress s, so t = 0.3 s, s_mean = 0.7 s, less by the
  // isotropic start. Mohr-Coulomb with 20 degrees yields at t/s = 0.342 < 0.43. The in-plane law does not notice.
  TEST(MixedControl, TheInPlaneLawSaysWhereSigmaZzIsOutside)
  {
    const LawOptions options = constant(20, 5, 0.01);
    const PointPath  path    = refined(path_of({Control::exx, Control::eyy, Control::exy}, {{0, 0, 0}, {0.05, 0.05, 0}}), 1e-3);
    const auto       flat    = rows_of(LawKind::cosserat_mohr_coulomb, options, path);
    EXPECT_EQ(flat[1].verdict, PointVerdict::reliable);
    EXPECT_EQ(flat.back().verdict, PointVerdict::zz_outside);
    EXPECT_EQ(flat.back().equivalent_plastic_strain, 0);
    for (const LawKind law : {LawKind::mohr_coulomb, LawKind::cosserat_drucker_prager})
      {
        const auto rows = rows_of(law, options, path);
        EXPECT_EQ(rows.back().verdict, PointVerdict::reliable) << name_of(law);
        EXPECT_GT(rows.back().equivalent_plastic_strain, 1e-3) << name_of(law);
      }
  }

  // s1 = 3 + 0.2 sqrt 3 = 3.346410 is the strength at s3 = 1, as in FailsAtTheClosedFormStress: the path stops below it, by less
  // than its step of 0.01 / 1024.
  TEST(MixedControl, AStressBeyondTheStrengthStopsAtTheStrength)
  {
    for (const LawKind law : {LawKind::mohr_coulomb, LawKind::cosserat_mohr_coulomb})
      {
        const PointPath path   = path_of({Control::syy, Control::sxx, Control::exy}, {{1, 1, 0}, {4, 1, 0}});
        const auto      report = drive_material_point(law, constant(30, 10, 0.1), {}, refined(path, 1e-3));
        EXPECT_EQ(report.status, MaterialPointStatus::strain_not_found);
        EXPECT_NEAR(report.rows.back().syy, 3.346410, 2e-5) << name_of(law);
        EXPECT_NE(report.message.find("syy = 3.34641"), std::string::npos) << report.message;
        for (const char *text : {"the strength is reached at stress ratio 0.5398", "not carry syy = 3.35, sxx = 1, so prescribe"})
          EXPECT_NE(report.message.find(text), std::string::npos) << report.message;
      }
  }

  // phi falls from 35 to 20 degrees over 1e-4, so at the peak the strength falls by cos 35 (15 degrees)/1e-4 = 2145 times s =
  // (1 + 3.690)/2 per plastic strain, 5030, and elastic unloading by G = 100/2.4 = 41.67 only.
  TEST(MixedControl, SnapBackStopsWithItsReason)
  {
    LawOptions options;
    options.elastic.youngs_modulus  = 100;
    options.friction_angle_peak     = 35;
    options.friction_angle_residual = 20;
    options.dilatancy_angle_peak = options.cohesion = 0;
    options.softening_strain                        = 1e-4;
    const auto report = drive_material_point(LawKind::mohr_coulomb, options, {}, named_path(NamedPath::drained, {1, 0.03, 1e-3}));
    EXPECT_EQ(report.status, MaterialPointStatus::law_failed);
    for (const char *text :
         {"stress ratio 0.5735", "strength falls by 502", "shear modulus 41.6667", "snap-back", "softening_strain"})
      EXPECT_NE(report.message.find(text), std::string::npos) << report.message;
    EXPECT_EQ(report.message.find("prescribe"), std::string::npos) << report.message;
  }

  // Perzyna's law during a hold. At constant volume and psi = 0 the mean stress stays 1 and the strength 1/2. t falls by G d
  // kappa, and the overstress is viscosity x d kappa/d time: it decays as exp(-time G/viscosity). Each row is right to 0.27/1024
  // of the overstress at its start.
  TEST(MixedControl, AnOverstressRelaxesOverTheDurationOfAHold)
  {
    LawOptions options       = constant(30, 0, 0);
    options.viscosity        = 0.5;
    const double decay       = options.elastic.youngs_modulus / 2.4 / options.viscosity;
    PointPath    path        = path_of({Control::eyy, Control::volume, Control::exy}, {{0, 0, 0}, {0.02, 0, 0}});
    path.progress            = {0, 0.02};
    const double durations[] = {0.1 / decay, 1 / decay, 1 / decay, 30 / decay};
    for (const double duration : durations)
      {
        path.values.push_back(path.values.back());
        path.progress.push_back(path.progress.back() + duration);
      }
    for (const LawKind law : {LawKind::mohr_coulomb, LawKind::cosserat_mohr_coulomb})
      {
        const auto rows = rows_of(law, options, path);
        ASSERT_EQ(rows.size(), path.values.size());
        for (std::size_t row = 2; row < rows.size(); ++row)
          {
            const double before = rows[row - 1].stress_ratio - 0.5;
            EXPECT_GT(before, row < 5 ? 0.01 : 0);
            EXPECT_NEAR(rows[row].stress_ratio - 0.5, before * std::exp(-decay * durations[row - 2]), 3e-4 * before);
          }
      }
  }

  // K0 = 0.5: t/s = (2 - 1)/(2 + 1) at the start.
  TEST(MixedControl, NamedPathsStartAtTheGivenK0)
  {
    for (const auto &[name, title] : choices(NamedPath()))
      {
        const auto rows = rows_of(LawKind::linear_elastic, {}, named_path(name, {1, 1e-3, 1e-3, 0.5}));
        EXPECT_NEAR(rows[0].stress_ratio, 1. / 3, 1e-15) << title;
        const double kept[] = {rows[1].sxx - 1, rows[1].volumetric_strain, rows[1].sxx + rows[1].syy - 3, rows[1].syy - 2};
        EXPECT_NEAR(kept[int(name)], 0, 1e-9) << title;
      }
  }

  TEST(MixedControl, WrongPathsAreRefusedByRowAndColumn)
  {
    using C                                  = Control;
    const std::vector<Eigen::Vector3d> start = {{0, 0, 0}};
    for (const Controls &controls : {Controls{C::exx, C::eyy, C::volume}, Controls{C::volume, C::mean_stress, C::exy},
                                     Controls{C::exy, C::sxy, C::eyy}, Controls{C::sxx, C::syy, C::mean_stress}})
      diptych::tests::expect_refused({"independent", name_of(controls[2])}, [&] { validate(path_of(controls, start)); });
    const Controls drained = {C::eyy, C::sxx, C::exy};
    diptych::tests::expect_refused({"'sxx' = 2", "start", "1"}, [&] { validate(path_of(drained, {{0, 2, 0}})); });
    diptych::tests::expect_refused({"'eyy' = nan"}, [&] { validate(path_of(drained, {{0, 1, 0}, {NAN, 1, 0}})); });
    PointPath path = path_of(drained, {{0, 1, 0}, {1, 1, 0}});
    path.progress  = {1, 1};
    diptych::tests::expect_refused({"progress"}, [&] { validate(path); });
  }
} // namespace
