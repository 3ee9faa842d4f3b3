// diptych: one point along paths of strains and stresses
// SPDX-License-Identifier: LGPL-2.1-or-later
#include "continuum/laws/material_point.h"
#include "tests/continuum/laws/law_states.h"

namespace
{
  using namespace diptych::continuum::tests;

  MaterialPointReport drive(const LawKind     law,
                            const LawOptions &options,
                            const PathSize   &size,
                            const NamedPath   name = NamedPath::drained)
  {
    const MaterialPointReport report = drive_material_point(law, options, {}, named_path(name, size));
    EXPECT_EQ(report.status, MaterialPointStatus::finished) << report.message;
    EXPECT_EQ(report.rows.back().progress, size.strain);
    return report;
  }

  // s1 = s3 Kp + 2 c sqrt(Kp), Kp = (1 + sin phi)/(1 - sin phi) = 3 for phi = 30, s3 = 1. For c = 0.1: 3 + 0.2 * 1.7320508 =
  // 3.346410; for c = 0.01: 3 + 0.02 * 1.7320508 = 3.034641. Valid for Mohr-Coulomb with any dilatancy and for Drucker-Prager
  // with associated flow.
  TEST(MaterialPoint, FailsAtTheClosedFormStress)
  {
    for (const LawKind law : plastic_laws)
      for (const auto &[cohesion, expected] : {std::pair(0.1, 3.346410), std::pair(0.01, 3.034641)})
        for (const double dilatancy : {30., 10., 0.})
          {
            const bool in_plane = is_mohr_coulomb(law);
            if (!in_plane && dilatancy < 30)
              continue;
            const auto report = drive(law, constant(30, dilatancy, cohesion), {1, 0.03, 1e-3});
            EXPECT_NEAR(report.rows.back().syy, expected, 1e-6) << name_of(law) << ", psi = " << dilatancy;
            EXPECT_NEAR(report.rows.back().sxx, 1, 1e-9);
          }
  }

  // With psi < phi Drucker-Prager reaches this stress once sigma_zz no longer flows: within 1e-3 from 10 % strain on. Earlier
  // it is further off, which shows that the waiting is necessary.
  TEST(MaterialPoint, DruckerPragerMeetsItForAnyDilatancyOncePlasticInPlaneStrain)
  {
    for (const LawKind law : {LawKind::drucker_prager, LawKind::cosserat_drucker_prager})
      for (const double dilatancy : {0., 5., 15.})
        {
          const auto report = drive(law, constant(30, dilatancy, 0.01), {1, 0.15, 1e-3});
          EXPECT_LT(report.rows[5].syy, 2.8) << "at 0.5 %";
          for (const MaterialPointRow &row : report.rows)
            if (row.axial_strain > 0.1)
              {
                EXPECT_NEAR(row.syy, 3.034641, 1e-3 * 3.034641) << "psi = " << dilatancy;
              }
        }
  }

  // Volume against shear: sin psi = -d eps_v/d gamma of the plastic flow. On the plateau all strain is plastic.
  TEST(MaterialPoint, PlateauDilatesByTheAngle)
  {
    for (const LawKind law : plastic_laws)
      for (const double dilatancy : {0., 12.})
        {
          const auto report = drive(law, constant(30, dilatancy, 0.01), {1, 0.2, 1e-3});
          EXPECT_NEAR(report.rows.back().dilatancy_angle, dilatancy, 0.01) << name_of(law);
          if (dilatancy > 0)
            {
              EXPECT_LT(report.rows.back().volumetric_strain, -0.02) << "the volume has grown";
            }
        }
  }

  // Peak to residual by exponential decay. After 0.9 of axial shortening kappa/kappa_s exceeds 200 and friction is residual: t
  // = s sin 13.5 + 0.01 cos 13.5 at s3 = 1: Kp = 1.609077, s1 = 1.609077 + 0.02 * 1.268494 = 1.634447.
  TEST(MaterialPoint, SoftensFromPeakToResidual)
  {
    LawOptions options;
    options.softening_strain = 0.01;
    for (const LawKind law : plastic_laws)
      {
        const auto  report = drive(law, options, {1, 0.9, 1e-3});
        const auto  peak   = std::max_element(report.rows.begin(), report.rows.end(),
                                              [](const auto &a, const auto &b) { return a.stress_ratio < b.stress_ratio; });
        const auto &end    = report.rows.back();
        EXPECT_LT(peak->axial_strain, 0.01) << name_of(law);
        EXPECT_NEAR(end.syy, 1.634447, is_mohr_coulomb(law) ? 1e-5 : 2e-3) << name_of(law);
        EXPECT_LT(peak->mobilised_friction_angle, 20.5 + 0.6) << "cohesion of 0.01 adds half a degree";
        EXPECT_GT(peak->mobilised_friction_angle, end.mobilised_friction_angle + 3);
        EXPECT_NEAR(end.dilatancy_angle, 0, 0.01);
      }
  }

  // Before yield: E' = E/(1 - nu^2) = 500/0.96 in plane strain at constant lateral stress; lateral over axial strain nu/(1 -
  // nu).
  TEST(MaterialPoint, BeginsWithThePlaneStrainModulus)
  {
    for (const LawKind law : all_laws())
      {
        const auto report = drive(law, {}, {1, 1e-5, 1e-5});
        EXPECT_NEAR((report.rows[1].syy - 1) / 1e-5, 500 / 0.96, 0.01) << name_of(law);
        EXPECT_NEAR(report.rows[1].lateral_strain / -1e-5, 0.25, 1e-5);
        EXPECT_NEAR(report.rows[1].dissipation, 0, 1e-17);
      }
  }

  // Finite strain: the volume is that of the shape, (1 - axial)(1 - lateral). With psi = 0 and without elastic strain it is
  // constant.
  TEST(MaterialPoint, VolumeIsThatOfTheShape)
  {
    const auto  report = drive(LawKind::mohr_coulomb, constant(30, 0, 0.01), {1, 0.5, 5e-3});
    const auto &end = report.rows.back(), &middle = report.rows[50];
    EXPECT_NEAR(1 - end.volumetric_strain, (1 - end.axial_strain) * (1 - end.lateral_strain), 1e-12);
    EXPECT_NEAR(end.volumetric_strain, middle.volumetric_strain, 1e-9);
    EXPECT_NEAR(end.lateral_strain, 1 - 1 / (1 - 0.5), 0.01);
  }

  // On the plateau the plastic work per axial logarithmic strain d is sigma : d eps = s1 d - s3 d (1 + sin psi)/(1 - sin psi).
  TEST(MaterialPoint, DissipatesThePlasticWork)
  {
    for (const LawKind law : {LawKind::mohr_coulomb, LawKind::drucker_prager})
      {
        const auto   report = drive(law, constant(30, 10, 0.1), {1, 0.3, 1e-3});
        const auto  &a = report.rows[250], &b = report.rows[300];
        const double d = std::log((1 - a.axial_strain) / (1 - b.axial_strain)), sine = std::sin(10 * M_PI / 180);
        EXPECT_NEAR(b.dissipation - a.dissipation, d * (3.346410 - (1 + sine) / (1 - sine)), 2e-4 * d) << name_of(law);
      }
  }

  // Perzyna at unit rate: the overstress of the plateau is viscosity * d kappa/d axial. For psi = 0, d kappa = d eps_1 - d
  // eps_3 = 2 d eps_1 per logarithmic axial strain. A step of half the length has the same overstress, because d_time is halved
  // too. The rate grows slowly with 1/height, which leaves a share of 4e-4 of the strain elastic.
  TEST(MaterialPoint, OverstressIsThatOfUnitRateWhateverTheStep)
  {
    LawOptions options = constant(30, 0, 0.1);
    options.viscosity  = 0.02;
    for (const double step : {2e-3, 1e-3})
      {
        const auto   report   = drive(LawKind::mohr_coulomb, options, {1, 0.1, step});
        const auto  &end      = report.rows.back();
        const double rate     = 2 * std::log((1 - 0.1 + step) / (1 - 0.1)) / step; // rate of kappa per axial strain, 2/0.9
        const double strength = (end.syy + end.sxx) / 2 * 0.5 + 0.1 * std::sqrt(3.) / 2;
        EXPECT_NEAR(end.overstress_share, 0.02 * rate / strength, 3e-5);
        // F = t - strength.
        EXPECT_NEAR((end.syy - end.sxx) / 2 - strength, 0.02 * rate, 3e-5);
      }
  }

  // The last step of a path has the remaining length.
  TEST(MaterialPoint, LastStepEndsOnTheEnd)
  {
    for (const double step : {1e-3, 0.0011, 0.0012, 0.0017})
      {
        const auto report = drive(LawKind::mohr_coulomb, constant(30, 12, 0.1), {1, 0.0405, step});
        EXPECT_NEAR(report.rows.back().axial_strain, 0.0405, 1e-15);
        EXPECT_EQ(report.rows.size(), std::ceil(0.0405 / step) + 1);
        EXPECT_NEAR(report.rows[10].axial_strain, 10 * step, 1e-15);
      }
  }

  // Friction that drops within a strain far below the elastic one: the step fails or is called unreliable, never reliable.
  TEST(MaterialPoint, ReportsSofteningThatIsTooFast)
  {
    LawOptions options;
    options.friction_angle_peak     = 40;
    options.friction_angle_residual = 5;
    options.softening_strain        = 1e-4;
    const auto report = drive_material_point(LawKind::mohr_coulomb, options, {}, named_path(NamedPath::drained, {1, 0.05, 1e-3}));
    const bool doubted = std::any_of(report.rows.begin(), report.rows.end(),
                                     [](const auto &row) { return row.verdict == PointVerdict::unreliable; });
    EXPECT_TRUE(doubted || report.status != MaterialPointStatus::finished);
  }

  TEST(MaterialPoint, ImpossiblePathsAreRefusedByName)
  {
    const std::pair<PathSize, const char *> cases[] = {
      {{0, 0.1, 1e-3}, "pressure"}, {{1, 1, 1e-3}, "axial_strain"}, {{1, 0, 1e-3}, "axial_strain"}, {{1, 0.1, 0}, "step"}};
    for (const auto &[size, key] : cases)
      EXPECT_EQ(diptych::tests::refusal([&] { (void)named_path(NamedPath::drained, size); }).find(key), 0u);
  }
} // namespace
