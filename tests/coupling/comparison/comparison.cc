// diptych: tests of the comparison of results in memory, with a known outcome
// SPDX-License-Identifier: LGPL-2.1-or-later
#include "tests/coupling/comparison/example_results.h"

namespace
{
  using namespace diptych::coupling::synthetic;

  // Computed once, because it takes a second.
  const Comparison &example()
  {
    static const Comparison c = compare(example_scene(), example_results());
    return c;
  }

  TEST(Compare, HasEveryStageAndWindowThatBothPanelsReached)
  {
    ASSERT_EQ(example().stages.size(), 2u);
    ASSERT_EQ(example().windows.size(), 1u);
    EXPECT_EQ(example().stages[1].progress, 0.02);
    EXPECT_EQ(example().stages[1].time, 20);
    EXPECT_EQ(example().windows[0].from, 0);
    EXPECT_EQ(example().windows[0].to, 0.02);
    EXPECT_EQ(example().windows[0].duration, 20);

    Results shorter = example_results();
    shorter.continuum.snapshots.pop_back();
    const Comparison c = compare(example_scene(), shorter);
    EXPECT_EQ(c.stages.size(), 1u);
    EXPECT_EQ(c.windows.size(), 0u); // the window ends with the second stage
    shorter.continuum.snapshots.resize(1);
    EXPECT_THROW((void)compare(example_scene(), shorter), std::invalid_argument);
  }

  // tanh(x / 3) goes from a tenth to nine tenths of its jump over 2.197 x 3.
  TEST(Compare, FindsTheGivenBandInBothPanels)
  {
    for (const PanelIncrement *panel : {&example().windows[0].discrete, &example().windows[0].continuum})
      {
        ASSERT_EQ(panel->band.bands.size(), 1u) << panel->band.verdict;
        const Band &band = panel->band.bands[0];
        EXPECT_NEAR(band.angle_deg, -45, 0.01);
        EXPECT_NEAR(band.half_width, 3, 0.01);
        EXPECT_NEAR(band.width_10_90, 2.197 * 3, 0.02);
        EXPECT_NEAR(band.offset, 0, 0.01);
        EXPECT_NEAR(band.jump, 1, 0.001);
        EXPECT_NEAR(band.dilation_deg, 0, 0.1);
        EXPECT_TRUE(band.between_packs()) << band.no_packs_because;
        // The major stress is vertical, the minor one horizontal.
        EXPECT_NEAR(band.to_minor_stress_deg.value, 45, 0.02);
      }
    const BandValues d = band_difference(example().windows[0]);
    EXPECT_NEAR(d.angle_deg.value, 0, 0.02);
    EXPECT_NEAR(d.half_width.value, 0, 0.02);
  }

  // Grains and nodes turn with the material and beyond it by a known profile of half width 2. Its amplitude is a third of the
  // spin's, (travel/2)/3 x 1/2. Averaging over 2.5 d spreads both profiles by one d along each axis, the same in both panels. The
  // fit with the half width 3 of the band gives 0.7 of the amplitude. Periodic sides change nothing away from them.
  TEST(Compare, ProfilesAcrossTheBandHoldTheKnownRotation)
  {
    const double travel = 2 * example_step.norm(), spin = travel / 12, beyond = spin / 3;
    const auto   rotation = [&](const Eigen::Vector2d &x, const double stage) {
      const double across = (x - Eigen::Vector2d(20, 28)).dot(Eigen::Vector2d(1, 1)) / std::sqrt(2.);
      return -stage / 2 * (spin / std::pow(std::cosh(across / 3), 2) + beyond / std::pow(std::cosh(across / 2), 2));
    };
    Scene scene                             = example_scene();
    scene.comparison.probes.probe_resamples = 100;
    for (const double cell_width : {0., double(example_columns)})
      {
        Results results = example_results();
        for (int stage = 0; stage <= 2; ++stage)
          {
            diptych::discrete::Snapshot  &grains = results.discrete.snapshots[std::size_t(stage)];
            diptych::continuum::Snapshot &nodes  = results.continuum.snapshots[std::size_t(stage)];
            grains.cell_width                    = cell_width;
            for (std::size_t i = 0; i < grains.position.size(); ++i)
              grains.rotation[i] = rotation(grains.position[i], stage);
            for (const Eigen::Vector2d &x : nodes.position)
              nodes.rotation.push_back(rotation(x, stage));
          }
        const Comparison c = compare(scene, results);
        for (const PanelIncrement *panel : {&c.windows[0].discrete, &c.windows[0].continuum})
          {
            ASSERT_TRUE(panel->profile);
            const BandProfile &p = *panel->profile;
            EXPECT_NEAR(p.spin_amplitude.value, spin, 0.1 * spin);
            EXPECT_NEAR(p.rotation_amplitude.value, 0.7 * beyond, 0.1 * beyond);
            EXPECT_NEAR(p.rotation_width_10_90.value, 2.197 * 2.45, 0.4);
            EXPECT_NEAR(p.loosening.value, 0, 0.01);
            EXPECT_NEAR(p.couple_stress_peak.value, 0, 1e-12); // central forces only
            EXPECT_NEAR(p.relative_rotation.value[4], 0, 0.01 * spin);
          }
        EXPECT_EQ(c.windows[0].discrete.profile->velocity_fluctuation.value[20], 0);
        EXPECT_TRUE(std::isnan(c.windows[0].continuum.profile->velocity_fluctuation.value[20]));
      }
    EXPECT_TRUE(std::isnan(example().windows[0].continuum.profile->relative_rotation.value[20])); // a classical continuum
  }

  TEST(Compare, FrameHasTheOutlinesBoxAndThePlatensTravel)
  {
    const Increment &window = example().windows[0];
    EXPECT_EQ(window.frame.width, 40);
    EXPECT_EQ(window.frame.height, 56);
    EXPECT_EQ(window.frame.centre, Eigen::Vector2d(20, 28));
    EXPECT_NEAR((window.frame.platen_increment - 2 * example_step).norm(), 0, 1e-20);
    EXPECT_NEAR(window.displacement_unit, 1.12e-6 * std::sqrt(2.), 1e-18);
    EXPECT_EQ(window.mesh.cell.size(), 20u * 28);
  }

  // In the band's middle the displacement along it grows by |travel| / 3 x 1/2 per unit across, so eps_1 - eps_2 equals this
  // gradient. Ten half widths away there is no shear.
  TEST(Compare, ShearStrainFollowsTheProfile)
  {
    const Increment         &window = example().windows[0];
    const DisplacementField &f      = window.discrete.field;
    const double             peak   = 0.5 * window.displacement_unit / 3;
    for (std::size_t i = 0; i < f.position.size(); ++i)
      {
        const double across = (f.position[i] - window.frame.centre).dot(Eigen::Vector2d(1, 1)) / std::sqrt(2.);
        if (std::abs(across) < 0.8)
          {
            EXPECT_NEAR(window.grain_shear[i] / peak, 1, 0.25); // the fit over 2.5 d includes the curvature
          }
        if (std::abs(across) > 25)
          {
            EXPECT_LT(window.grain_shear[i] / peak, 1e-4);
          }
      }
  }

  // The grains' moments add up to diag(1, 2) x area, less half a diameter at each end of the rows: 39 of 40.
  TEST(Compare, MappingKeepsTheTotalAndStressDiffersAsGiven)
  {
    const StageRecord &stage = example().stages[1];
    EXPECT_LT(stage.mapping.total_relative_error, 1e-12);
    EXPECT_LT(stage.mapping.nodal_residual, 1e-11); // branches along the platens are not cut there
    EXPECT_LT(stage.mapping.outside_share, 1e-6);
    EXPECT_EQ(stage.mapping.method, "segments");
    EXPECT_EQ(stage.mapping.window_time, 20);
    Eigen::Matrix2d           total = Eigen::Matrix2d::Zero();
    const std::vector<double> area  = cell_areas(stage.fields.mesh);
    for (std::size_t k = 0; k < area.size(); ++k)
      total += area[k] * stage.fields.grains.stress[k];
    EXPECT_NEAR(total(0, 0), sigma_xx * 39 * 56, 1e-9);
    EXPECT_NEAR(total(1, 1), sigma_yy * 40 * 56, 1e-9);
    // A cell inside has exactly the lattice's stress.
    const std::size_t inside = 14 * 20 + 10;
    EXPECT_NEAR(stage.fields.grains.stress[inside](0, 0), sigma_xx, 1e-6);
    EXPECT_NEAR(stage.fields.grains.stress[inside](1, 1), sigma_yy, 1e-6);
    EXPECT_NEAR(stage.fields.continuum.stress[inside](1, 1), continuum_over_grains * sigma_yy, 1e-12);
    // |0.25 sigma| / |1.25 sigma|, apart from the ends of the rows.
    ASSERT_EQ(stage.stress_differences.size(), 3u);
    EXPECT_NEAR(stage.stress_differences[0].relative_l2, 0.2, 0.01);
  }

  TEST(Compare, PanelRecordsOfAStage)
  {
    const StageRecord &stage = example().stages[1];
    EXPECT_NEAR(stage.discrete.stress_ratio.value, 1. / 3, 1e-14);
    EXPECT_NEAR(stage.stress_ratio_difference.value, 0, 1e-14);
    EXPECT_NEAR(stage.discrete.volumetric_strain, -0.01, 1e-14);
    EXPECT_NEAR(stage.volumetric_strain_difference, 0.002, 1e-14);
    EXPECT_NEAR(stage.discrete.upper_force.y(), -80, 1e-12);
    EXPECT_NEAR(stage.continuum.lower_force.y(), 99, 1e-12);
    EXPECT_EQ(stage.discrete.dynamic_share, 0);
    // Forces balance on every grain except at the ends of rows, 39 apart, which are pushed outward by 1. 56 x 39 is compared with
    // moments of 56 x 39 along x and 2 x 56 x 40 along y.
    EXPECT_NEAR(stage.discrete.acceleration_share, 39 / std::hypot(39, 80), 1e-12);
    EXPECT_NEAR(std::abs(stage.discrete.minor_direction_deg), 0, 1e-9);
    EXPECT_NEAR(std::abs(stage.continuum.minor_direction_deg), 0, 1e-9);
    // The window's contacts dissipate 0.01 each, split by the band's strip. The continuum dissipates 0.01 per unit of area.
    ASSERT_TRUE(stage.discrete.dissipation && stage.continuum.dissipation);
    EXPECT_NEAR(stage.discrete.dissipation->inside + stage.discrete.dissipation->outside,
                0.01 * double(example_results().discrete.snapshots[2].window_forces.size()), 1e-9);
    EXPECT_NEAR(stage.continuum.dissipation->share_inside, stage.continuum.dissipation->area_share, 1e-6);
    EXPECT_NEAR(stage.continuum.dissipation->inside + stage.continuum.dissipation->outside, 0.02 * 40 * 56, 1e-4);
  }

  TEST(Compare, WithoutACoarseRunThereAreNoCoarseResults)
  {
    EXPECT_FALSE(example().coarse);
    Results results    = example_results();
    results.coarse     = results.continuum;
    const Comparison c = compare(example_scene(), results);
    ASSERT_TRUE(c.coarse);
    ASSERT_EQ(c.coarse->windows.size(), 1u);
    EXPECT_EQ(c.coarse->windows[0].continuum.band.bands[0].angle_deg, c.windows[0].continuum.band.bands[0].angle_deg);
    EXPECT_EQ(c.coarse->peak.value, c.continuum.numbers.peak.value);
  }

  TEST(Compare, LawsWithoutPeakAnglesHaveNoTheoryLines)
  {
    ASSERT_TRUE(example().theory.has_value());
    Scene scene                        = example_scene();
    scene.continuum.material.hardening = diptych::continuum::kind_of<diptych::continuum::CriticalStateHardening>;
    EXPECT_FALSE(compare(scene, example_results()).theory.has_value());
    scene.continuum.law = diptych::continuum::LawKind::linear_elastic;
    EXPECT_FALSE(compare(scene, example_results()).theory.has_value());
  }
} // namespace
