// diptych: keys that follow from others: speed, windows, meshes and the law of the continuum
// SPDX-License-Identifier: LGPL-2.1-or-later
#include "coupling/scene/scene_file.h"
#include "discrete/files/text_file.h"
#include "tests/common.h"

namespace
{
  using namespace diptych::coupling;
  using namespace diptych::tests;
  using Words = std::vector<std::string>;

  Scene scene_with(const Words &overrides)
  {
    const Folder folder;
    diptych::discrete::write_text(folder / "short.prm", "# all defaults\n");
    return read_scene(folder / "short.prm", overrides);
  }

  TEST(DerivedKeys, TheSpeedFollowsFromTheNumberOfGrains)
  {
    const auto speed = [](const char *grains) {
      return scene_with({std::string("sample/grains=") + grains}).loading.inertial_number;
    };
    EXPECT_EQ(speed("1500"), 1e-3);
    EXPECT_EQ(speed("4000"), 4e-4);
    EXPECT_NEAR(speed("3000"), 5.85e-4, 1e-6);
    EXPECT_NEAR(speed("16000"), 2e-4, 1e-9);
    EXPECT_EQ(scene_with({"loading/inertial_number=1e-5"}).loading.inertial_number, 1e-5);
  }

  TEST(DerivedKeys, WindowsEndAtStages)
  {
    const auto edges = [](const Words &overrides) { return scene_with(overrides).comparison.window_edges; };
    EXPECT_EQ(edges({}), (std::vector<double>{0, 0.01, 0.02, 0.04}));
    EXPECT_EQ(edges({"loading/axial_strain=0.03"}), (std::vector<double>{0, 0.01, 0.015, 0.03}));
    EXPECT_EQ(edges({"loading/axial_strain=0.3", "loading/stage_strain=0.1"}), (std::vector<double>{0, 0.1, 0.2, 0.3}));
    EXPECT_EQ(edges({"loading/axial_strain=0.005"}), (std::vector<double>{0, 0.005}));
    EXPECT_EQ(edges({"loading/stages=0.001, 0.02, 0.04"}), (std::vector<double>{0, 0.001, 0.02, 0.04}));
    EXPECT_EQ(edges({"loading/mode=time", "loading/duration=4"}), (std::vector<double>{0, 1, 2, 4}));
  }

  TEST(DerivedKeys, ElementsFollowFromTheInternalLength)
  {
    const Scene fine = scene_with({"continuum/internal_length=1"}), coarse = scene_with({"continuum/internal_length=10"}),
                local = scene_with({"continuum/law=mohr_coulomb"});
    EXPECT_EQ(fine.continuum.element_size, 1);
    EXPECT_EQ(fine.comparison.coarse_element_size, 2);
    EXPECT_EQ(coarse.continuum.element_size, 3);
    EXPECT_EQ(local.continuum.element_size, 2);
    EXPECT_EQ(scene_with({"continuum/element_size=8"}).comparison.coarse_element_size, 16);
  }

  TEST(DerivedKeys, TheMethodFollowsFromSizeSpeedAndAccuracy)
  {
    using diptych::discrete::Method;
    const auto chosen = [](const Words &more) {
      Words words = {"discrete/method=auto"};
      words.insert(words.end(), more.begin(), more.end());
      return scene_with(words);
    };
    const Scene usual = chosen({"sample/grains=2000"}), slow = chosen({"loading/inertial_number=1e-5", "discrete/accuracy=0.01"});
    EXPECT_EQ(usual.discrete.method.method, Method::nscd);
    EXPECT_NE(resolved_text(usual).find("# discrete/method = auto became nscd: contact dynamics"), std::string::npos);
    EXPECT_EQ(chosen({}).discrete.method.method, Method::compliant) << "4000 grains";
    EXPECT_EQ(slow.discrete.method.method, Method::penalty);
    EXPECT_EQ(slow.discrete.penalty.stiffness, 1e4);
    EXPECT_EQ(chosen({"loading/inertial_number=1e-5", "discrete/accuracy=0.005"}).discrete.method.method, Method::nscd);
    EXPECT_EQ(scene_with({}).method_reason, "");
  }

  TEST(DerivedKeys, StagesDivideTheLoading)
  {
    const auto strain = [](const char *end) {
      return scene_with({std::string("loading/axial_strain=") + end}).loading.stage_strain;
    };
    EXPECT_EQ(strain("0.04"), 0.005);
    EXPECT_EQ(strain("0.012"), 0.006);
    EXPECT_EQ(strain("0.001"), 0.001);
    EXPECT_EQ(strain("0.8"), 0.02);
    EXPECT_EQ(scene_with({"loading/mode=time", "loading/duration=0.5"}).loading.stage_time, 0.5);
  }

  TEST(DerivedKeys, LoadStepsFitTheLoadingAndEachOther)
  {
    const auto steps = [](const Words &overrides) {
      const Scene scene = scene_with(overrides);
      return std::vector<double>{scene.continuum.initial_step, scene.continuum.max_step};
    };
    EXPECT_EQ(steps({}), (std::vector<double>{0.001, 0.00125}));
    EXPECT_EQ(steps({"continuum/initial_step=0.002"}), (std::vector<double>{0.002, 0.002}));
    EXPECT_EQ(steps({"continuum/max_step=0.0005"}), (std::vector<double>{0.0005, 0.0005}));
    EXPECT_EQ(steps({"loading/axial_strain=1e-6", "loading/stage_strain=1e-6"}), (std::vector<double>{1e-5, 1e-5}));
    EXPECT_EQ(steps({"continuum/min_step=0.01"}), (std::vector<double>{0.01, 0.01}));
    EXPECT_EQ(steps({"continuum/max_step=1e-6"}), (std::vector<double>{1e-6, 1e-6}));
    EXPECT_EQ(steps({"loading/mode=time", "loading/duration=64"})[1], 2);
  }

  TEST(DerivedKeys, TheLawIsStrongerWithMoreFriction)
  {
    const auto law = [](const Words &overrides) { return scene_with(overrides).continuum.material; };
    const auto low = law({"discrete/friction=0.3"}), between = law({"discrete/friction=0.45"}),
               high = law({"discrete/friction=0.5"});
    const auto part = law({"discrete/friction=0.3", "continuum/friction_angle_peak=20"});
    EXPECT_LT(low.friction_angle_peak, between.friction_angle_peak);
    EXPECT_LT(between.friction_angle_peak, high.friction_angle_peak);
    EXPECT_LT(low.dilatancy_angle_peak, high.dilatancy_angle_peak);
    EXPECT_NEAR(part.friction_angle_start / 20, low.friction_angle_start / low.friction_angle_peak, 1e-9);
    EXPECT_NEAR(part.dilatancy_angle_peak / part.friction_angle_start, low.dilatancy_angle_peak / low.friction_angle_start, 1e-9);
    EXPECT_EQ(part.friction_angle_peak, 20);
  }

  TEST(DerivedKeys, TheLawIsLinearInRollingFrictionBetweenItsCalibrations)
  {
    const auto peak = [](const char *rolling) {
      return scene_with({"discrete/friction=0.45", std::string("discrete/rolling_friction=") + rolling})
        .continuum.material.friction_angle_peak;
    };
    EXPECT_NEAR(peak("0.025"), (peak("0") + peak("0.05")) / 2, 1e-9);
    EXPECT_NEAR(peak("0.25"), (peak("0.2") + peak("0.3")) / 2, 1e-9);
    EXPECT_LT(peak("0"), peak("0.05"));
    EXPECT_EQ(peak("0.3"), peak("0.5"));
  }

  TEST(DerivedKeys, PlatensAreThoseOfTheGrains)
  {
    using diptych::continuum::Platens;
    const auto of = [](const Words &overrides) { return scene_with(overrides).continuum; };
    EXPECT_EQ(of({}).platens, Platens::frictional) << "discs roll along flat platens";
    EXPECT_EQ(of({"discrete/platen_friction=0"}).platens, Platens::smooth);
    for (const char *change : {"discrete/platen_rolling_friction=1", "sample/rough_platens=true"})
      EXPECT_EQ(of({change}).platens, Platens::rough) << change;
    EXPECT_EQ(of({"discrete/lateral=periodic", "discrete/side_motion=velocity", "loading/mode=shear"}).platens, Platens::rough);
    EXPECT_EQ(of({"continuum/platens=rough"}).platens, Platens::rough);
    EXPECT_EQ(of({"discrete/friction=0.4"}).platen_friction, 0.17);
    EXPECT_EQ(of({"discrete/friction=0.4", "discrete/platen_friction=0.05"}).platen_friction, 0.05) << "Coulomb's limit";
    EXPECT_GT(of({"discrete/friction=0.6"}).platen_friction, of({"discrete/friction=0.3"}).platen_friction);
  }

  TEST(DerivedKeys, OnlyALawFittedToSuchGrainsNamesItsOrigin)
  {
    const auto        origin   = [](const Words &overrides) { return scene_with(overrides).comparison.parameters_from; };
    const auto        fitted   = [&](const Words &overrides) { return origin(overrides).rfind("defaults, calibrated", 0) == 0; };
    const std::string unfitted = "defaults, not fitted to these grains";
    EXPECT_EQ(origin({}),
              unfitted + ": sample/grains 4000 lies outside the calibrated 1000 to 2500; diptych calibrate fits them");
    EXPECT_TRUE(fitted({"sample/grains=1500"}));
    EXPECT_TRUE(fitted({"sample/grains=1500", "discrete/friction=0.3", "loading/horizontal_over_vertical=0"}));
    EXPECT_TRUE(fitted({"sample/grains=1500", "discrete/rolling_friction=0.1"}));
    EXPECT_TRUE(fitted({"sample/grains=1500", "discrete/lateral=cell", "loading/mode=path"})) << "as in the calibrations";
    EXPECT_TRUE(fitted({"sample/grains=1500", "continuum/max_step=0.001"})) << "not a key of the law";
    for (const char *change : {"discrete/friction=0.1", "discrete/rolling_friction=0.4", "sample/preparation_friction=0.3",
                               "sample/radius_distribution=uniform_by_mass", "sample/grains=600", "loading/inertial_number=0.01",
                               "continuum/element_size=8", "discrete/method=penalty", "sample/width_over_height=1.4"})
      EXPECT_EQ(origin({"sample/grains=1500", change}).rfind(unfitted, 0), 0u) << change;
    for (const char *change : {"continuum/friction_angle_peak=25", "continuum/law=mohr_coulomb"})
      EXPECT_EQ(origin({"sample/grains=1500", change}), "") << change;
    EXPECT_EQ(origin({"discrete/friction=0.1", "comparison/parameters_from=my fit"}), "my fit");
  }

  TEST(DerivedKeys, AutoIsTheSameAsNothingAndTheEchoHasNumbers)
  {
    const Folder folder;
    const Scene  scene = scene_with({"continuum/hardening=table", "continuum/hardening=auto", "comparison/window_edges=auto"});
    EXPECT_EQ(scene.continuum.material.hardening, diptych::continuum::kind_of<diptych::continuum::MobilisationHardening>);
    diptych::discrete::write_text(folder / "echo.prm", resolved_text(scene));
    const Scene echo = read_scene(folder / "echo.prm", {"discrete/friction=0.2"});
    EXPECT_EQ(echo.continuum.material.friction_angle_peak, scene.continuum.material.friction_angle_peak);
    EXPECT_TRUE(echo.warnings.empty());
    EXPECT_NE(explain("continuum/youngs_modulus").find("auto"), std::string::npos);
  }

  TEST(DerivedKeys, FastLoadingIsAWarning)
  {
    EXPECT_TRUE(scene_with({"loading/inertial_number=0.003"}).warnings.empty());
    EXPECT_EQ(scene_with({"loading/inertial_number=0.05"}).warnings.size(), 1u);
    EXPECT_EQ(scene_with({"loading/strain_rate=0.05"}).warnings.size(), 1u);
  }

  TEST(DerivedKeys, PlatensRoughInOnePanelOnlyAreAWarning)
  {
    const auto warnings = [](const Words &overrides) { return scene_with(overrides).warnings; };
    EXPECT_TRUE(warnings({}).empty());
    EXPECT_TRUE(warnings({"discrete/platen_friction=0", "continuum/platens=smooth"}).empty());
    ASSERT_EQ(warnings({"discrete/platen_friction=0", "continuum/platens=rough"}).size(), 1);
    EXPECT_NE(warnings({"discrete/platen_friction=0", "continuum/platens=rough"})[0].find("slide along"), std::string::npos);
    EXPECT_EQ(warnings({"continuum/platens=smooth"}).size(), 1);
    EXPECT_EQ(warnings({"discrete/friction=0.95", "continuum/platens=rough"}).size(), 1);
  }

  TEST(DerivedKeys, ACoarseRunThatIsNotCoarserIsAWarningWithTwoRemedies)
  {
    const auto warnings = [](const std::string &size) {
      return scene_with({"continuum/element_size=2", "comparison/coarse_element_size=" + size}).warnings;
    };
    ASSERT_EQ(warnings("2").size(), 1);
    EXPECT_NE(warnings("2")[0].find("give a larger size, or 0"), std::string::npos);
    EXPECT_TRUE(warnings("4").empty());
    EXPECT_TRUE(warnings("0").empty());
  }
} // namespace
