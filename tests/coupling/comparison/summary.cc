// diptych: tests of counts, extremes and costs of a whole run, and of differences of bands
// SPDX-License-Identifier: LGPL-2.1-or-later
#include "coupling/comparison/key_numbers.h"
#include "tests/coupling/comparison/example_results.h"

namespace
{
  using namespace diptych::coupling::synthetic;

  DiscreteSummary grains_summary(const Scene &scene)
  {
    const Results results = example_results();
    return summary_of(scene, results.discrete, results.discrete.snapshots.back(), history_table(results.discrete.rows));
  }

  TEST(Summary, SummarisesTheGrainsHistory)
  {
    const DiscreteSummary s = grains_summary(example_scene());
    EXPECT_EQ(s.grains, 40 * 56);
    EXPECT_EQ(s.steps, 40);
    EXPECT_EQ(s.sweeps, 4000);
    EXPECT_EQ(s.max_penetration, 0.006);
    EXPECT_EQ(s.energy_residual, 1e-12); // the largest magnitude
    EXPECT_EQ(s.residual, 4e-4);
    EXPECT_NEAR(s.mean_inertial_number, 1e-3, 1e-16);
    EXPECT_EQ(s.kinetic_energy_ratio_median, 21); // of 1 to 40, the upper of the two middle values
    EXPECT_EQ(s.kinetic_energy_ratio_largest, 40);
    EXPECT_EQ(s.contacts, 4040);
    EXPECT_EQ(s.coordination_number, 2 * 4040. / (40 * 56));
    EXPECT_EQ(s.rattlers, 3);
    EXPECT_NEAR(s.numbers.peak.value, 1. / 3, 1e-14);
    EXPECT_EQ(s.numbers.compared.at("final_volumetric_strain"), -0.01);
    EXPECT_EQ(s.balance.mean.value, 0); // 80 up, 80 down
  }

  // residual 4e-4 x step 0.1 / inertial number 1e-3. The step is in d sqrt(rho/P), so four times the pressure doubles it.
  TEST(Summary, SolverNoiseCountsTheStepInTheScenesTime)
  {
    Scene scene = example_scene();
    EXPECT_NEAR(grains_summary(scene).solver_noise, 0.04, 1e-15);
    scene.loading.pressure = 4;
    EXPECT_NEAR(grains_summary(scene).solver_noise, 0.08, 1e-15);
    scene.sample.density = 4;
    EXPECT_NEAR(grains_summary(scene).solver_noise, 0.04, 1e-15);
  }

  TEST(Summary, SummarisesTheContinuumsHistory)
  {
    Scene                  scene   = example_scene();
    const Results          results = example_results();
    const auto             of      = [&] { return summary_of(scene, results.continuum, history_table(results.continuum.rows)); };
    const ContinuumSummary s       = of();
    EXPECT_EQ(s.newton_iterations, 120);
    EXPECT_EQ(s.cut_backs, 1);
    EXPECT_EQ(s.share_zz_not_intermediate, 0.25);
    EXPECT_EQ(s.viscous_share, 0.04);
    EXPECT_EQ(s.unstable_share, 0.125);
    EXPECT_EQ(s.max_equivalent_plastic_strain, 0.4);
    EXPECT_NEAR(s.platen_unbalance, 1 / 99.5, 1e-14); // 100 against 99
    EXPECT_EQ(s.law, "cosserat_mohr_coulomb");
    ASSERT_TRUE(s.internal_length.has_value());
    scene.continuum.law = diptych::continuum::LawKind::mohr_coulomb;
    EXPECT_FALSE(of().internal_length.has_value());
  }

  TEST(Summary, CostsAreThoseOfTheirPhases)
  {
    const CostSummary cost = summary_of(example_results().phases);
    EXPECT_EQ(*cost.preparation_cpu_s, 1.5);
    EXPECT_EQ(*cost.discrete_cpu_s, 18);
    EXPECT_EQ(*cost.continuum_cpu_s, 2.5);
    EXPECT_FALSE(cost.comparison_cpu_s.has_value());
    EXPECT_EQ(cost.peak_memory_mb, 300);
  }

  // Force 30 on a width of 10 under the pressure 1, whose side forces act inside the outline and cause 0.9 of sxx.
  TEST(Summary, StrengthsOfTheBoundaryOfTheSampleAndOfItsCore)
  {
    const std::vector<double> two = {1, 1}, none = {0, 0};
    HistoryTable  h = {{"progress", {0, 0.01}}, {"lower_fy", {30, 30}},  {"upper_fy", {-30, -30}}, {"width", {10, 10}},
                       {"sxx", {1.1, 1.1}},     {"sxy", none},           {"syy", {2.8, 2.8}},      {"core_sxx", two},
                       {"core_sxy", none},      {"core_syy", {2.9, 2.9}}};
    QuantityBasis basis;
    basis.averaging_width = 0.001;
    basis.is_timed        = false;
    basis.force           = 1;
    basis.side_pressure   = 1;
    EXPECT_NEAR(peak_nominal_stress_ratio(basis, h), 0.5, 1e-12);
    EXPECT_NEAR(nominal_friction_angle(basis, h), 30, 1e-12);
    EXPECT_NEAR(peak_outline_stress_ratio(basis, h), 1.7 / 3.9, 1e-12) << "the continuum's sides are the outline";
    h["side_sxx"] = {0.9, 0.9};
    EXPECT_NEAR(peak_outline_stress_ratio(basis, h), 1.6 / 4.0, 1e-12);
    EXPECT_NEAR(peak_core_stress_ratio(basis, h), 1.8 / 4.0, 1e-12);
    basis.side_pressure = NAN; // periodic sides, for example
    EXPECT_TRUE(std::isnan(peak_nominal_stress_ratio(basis, h)));
    EXPECT_NEAR(peak_core_stress_ratio(basis, h), 1.9 / 3.9, 1e-12);
  }

  Increment with_bands(const Interval &grains_angle, const Interval &nodes_angle)
  {
    Increment increment;
    Band      a, b;
    a.angle_deg          = grains_angle.value;
    b.angle_deg          = nodes_angle.value;
    a.interval.angle_deg = grains_angle, b.interval.angle_deg = nodes_angle;
    a.interval.half_width = {4, 3, 6}, b.interval.half_width = {5, 4.5, 6};
    increment.discrete.band.bands = {a}, increment.continuum.band.bands = {b};
    return increment;
  }

  // 5 - 4 down by 2 and up by 1, as the grains: nothing is random in the continuum.
  TEST(Summary, DifferencesOfBandsHaveTheScatterOfTheGrains)
  {
    const BandValues d = band_difference(with_bands({-45, -46, -44}, {-46, -46, -46}));
    EXPECT_EQ(d.angle_deg.value, -1);
    EXPECT_NEAR(d.half_width.low, 1 - 2, 1e-15);
    EXPECT_NEAR(d.half_width.high, 1 + 1, 1e-15);
  }

  TEST(Summary, RotationAcrossTheVerticalIsSmall)
  {
    const BandValues d = band_difference(with_bands({89, 88, 90}, {-89, -90, -88}));
    EXPECT_NEAR(d.angle_deg.value, 2, 1e-12);
    EXPECT_NEAR(d.angle_deg.low, 2 - 1, 1e-12);
    EXPECT_NEAR(d.angle_deg.high, 2 + 1, 1e-12);
  }

  // Two equally strong bands cross; chance makes one of them the stronger in each panel.
  TEST(Summary, MirrorImagesOfABandAreNotSubtracted)
  {
    Increment increment      = with_bands({-57, -58, -56}, {55, 55, 55});
    Band      other          = increment.continuum.band.bands[0];
    other.angle_deg          = -55.5;
    other.interval.angle_deg = {-55.5, -55.5, -55.5};
    increment.continuum.band.bands.push_back(other);
    EXPECT_NEAR(band_difference(increment).angle_deg.value, 1.5, 1e-12) << "the nearest band";
    increment.is_mirror_symmetric = true;
    const BandValues d            = band_difference(increment);
    EXPECT_NEAR(d.angle_deg.value, -2, 1e-12) << "the strongest bands, mirrored";
    EXPECT_NEAR(d.angle_deg.low, -3, 1e-12);
    EXPECT_NEAR(d.half_width.value, 1, 1e-12);
  }

  // d = 2: a width of 4 is 2 d. An interval of the difference that excludes 0 is a difference; one sample gives none for a peak.
  TEST(Summary, KeyNumbersComeWithDifferenceAndVerdict)
  {
    Comparison c;
    c.discrete.numbers.compared  = {{"peak_stress_ratio", 0.4}, {"platen_force_pd", 60}};
    c.continuum.numbers.compared = {{"peak_stress_ratio", 0.36}, {"platen_force_pd", 66}};
    c.windows.push_back(with_bands({-45, -46, -44}, {-49, -49, -49}));
    c.windows[0].frame.mean_diameter                         = 2;
    c.windows[0].discrete.band.bands[0].interval.width_10_90 = c.windows[0].continuum.band.bands[0].interval.width_10_90 = {4, 3,
                                                                                                                            5};
    const std::vector<KeyNumber> numbers = key_numbers(c);
    ASSERT_EQ(numbers.size(), std::size(key_quantities));
    for (std::size_t k = 0; k < numbers.size(); ++k)
      EXPECT_EQ(numbers[k].key, key_quantities[k].key);
    const auto at = [&](const std::string &key) {
      return *std::find_if(numbers.begin(), numbers.end(), [&](const KeyNumber &n) { return n.key == key; });
    };
    EXPECT_NEAR(at("peak_stress_ratio").difference.value, -0.04, 1e-15);
    EXPECT_EQ(at("peak_stress_ratio").verdict, "no interval (one sample)");
    EXPECT_EQ(at("strength").verdict, "not in both panels") << "no strength";
    EXPECT_EQ(at("platen_force_pd").difference.value, 6);
    EXPECT_EQ(at("peak_friction_angle_deg").unit, "degrees");
    EXPECT_EQ(at("band_angle_deg").difference.value, -4);
    EXPECT_EQ(at("band_angle_deg").verdict, "different");
    EXPECT_EQ(at("band_width_10_90_d").grains.value, 2);
    EXPECT_EQ(at("band_width_10_90_d").verdict, "cannot tell");
    const std::string csv = csv_of(numbers, {Check{"", "", 1, 2, ""}, Check{"", "", 3, 2, ""}});
    EXPECT_NE(csv.find("\npeak t/s,-,0.4,,,0.36,,,-0.04,,,no interval (one sample)\n"), std::string::npos);
    EXPECT_NE(csv.find("\nchecks,-,,,,,,,,,,1 of 2 checks fail\n"), std::string::npos);
    c.windows[0].discrete.band.bands[0].is_diffuse    = true;
    c.windows[0].discrete.band.bands[0].interval.jump = c.windows[0].continuum.band.bands[0].interval.jump = {1, 1, 1};
    for (const KeyNumber &n : key_numbers(c))
      if (n.key == std::string("band_angle_deg"))
        EXPECT_TRUE(std::isnan(n.grains.value) && n.verdict == "diffuse");
    EXPECT_NE(text_of(numbers).find("--seeds 1-8"), std::string::npos);
  }

  // Elements twice as large: (14 - 10) / (2^2 - 1) of 10 is an error of 13 %, below the margin of 20 %; 17 in place of 14 gives
  // 23 %.
  TEST(Summary, ChecksNameEachBrokenLimit)
  {
    Scene      scene = example_scene();
    Comparison c;
    c.discrete.spin_term_share    = 2e-3;
    c.discrete.balance.mean.value = -0.02;
    c.discrete.impact_share       = 0.05;
    c.windows.push_back(with_bands({-45, -46, -44}, {-49, -49, -49}));
    c.windows[0].continuum.band.bands[0].width_10_90 = 10;
    c.continuum.numbers.peak.value                   = 0.4;
    c.coarse.emplace();
    c.continuum.element_size                                 = 2;
    c.coarse->element_size                                   = 4;
    c.coarse->windows                                        = c.windows;
    c.coarse->windows[0].continuum.band.bands[0].width_10_90 = 14;
    c.coarse->peak.value                                     = 0.41;
    const auto broken                                        = [&] {
      std::vector<std::string> keys;
      for (const Check &check : checks_of(scene.discrete, scene.comparison, c))
        if (!check.kept())
          keys.push_back(check.key.substr(check.key.rfind('/') + 1));
      return keys;
    };
    EXPECT_EQ(broken(), (std::vector<std::string>{"spin_term_share", "platen_difference_mean"}));
    c.coarse->windows[0].continuum.band.bands[0].width_10_90 = 17;
    EXPECT_EQ(broken().back(), "width_10_90_d");
    const std::string text = text_of(checks_of(scene.discrete, scene.comparison, c));
    EXPECT_EQ(text.find("3 of "), 0u) << text;
    EXPECT_NE(text.find("spin term over the mean stress 0.002, limit 0.001: "), std::string::npos) << text;
    scene.discrete.method.method = diptych::discrete::Method::imported;
    EXPECT_EQ(broken().size(), 1u) << "the files of another code hold no numbers of the grains";
  }

  TEST(Summary, WithoutABandThereIsNoDifference)
  {
    Increment increment = with_bands({1, 1, 1}, {2, 2, 2});
    increment.continuum.band.bands.clear();
    EXPECT_TRUE(std::isnan(band_difference(increment).angle_deg.value));
  }
} // namespace
