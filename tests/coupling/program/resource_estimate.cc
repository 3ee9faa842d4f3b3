// diptych: a run that does not fit the machine is refused before it begins
// SPDX-License-Identifier: LGPL-2.1-or-later
#include "coupling/program/resource_estimate.h"
#include "coupling/scene/scene_file.h"
#include "tests/common.h"

namespace
{
  using namespace diptych::coupling;

  Scene scene_of(const int grains)
  {
    Scene scene;
    scene.sample.grains                    = grains;
    scene.discrete.method.history_interval = 1000000000; // rows have a test of their own
    scene.output.directory                 = testing::TempDir();
    return scene;
  }

  CommandLine quiet()
  {
    CommandLine line;
    line.quiet = true;
    return line;
  }

  TEST(ResourceEstimate, GrowsWithGrainsElementsAndSamples)
  {
    const Scene            small = scene_of(1000), large = scene_of(2000);
    const ResourceEstimate one = estimate_resources(small, {true, true}), two = estimate_resources(large, {true, true});
    EXPECT_NEAR(two.memory / one.memory, 2, 1e-3);
    const double none = 2e6; // every file is given a megabyte at first
    EXPECT_NEAR((two.disk - none) / (one.disk - none), 2, 1e-3);
    EXPECT_NEAR((estimate_resources(small, {true, true, 30}).disk - none) / (one.disk - none), 30, 1e-9);
    EXPECT_EQ(estimate_resources(small, {true, true, 30}).memory, one.memory);
    EXPECT_LT(estimate_resources(small, {true, false}).memory, one.memory);
  }

  TEST(ResourceEstimate, ProcessesRepeatAPartOfTheWork)
  {
    const Scene            scene = scene_of(100000);
    const ResourceEstimate one = estimate_resources(scene, {true, false}), two = estimate_resources(scene, {true, false, 1, 2});
    EXPECT_EQ(two.memory, one.memory);
    EXPECT_GT(two.cpu_s, one.cpu_s);
    EXPECT_LT(two.cpu_s, 2 * one.cpu_s);
    diptych::tests::expect_words(two.text, {" of memory on each of 2 processes, "});
  }

  TEST(ResourceEstimate, OnlyARunThatFitsNoMachineIsRefused)
  {
    EXPECT_NO_THROW(announce_resources(quiet(), scene_of(2000), {true, true}));
    Scene scene                  = scene_of(1000000);
    scene.continuum.element_size = 1e-6;
    diptych::tests::expect_refused<std::runtime_error>({"GB of memory", "continuum/element_size"}, [&] {
      announce_resources(quiet(), scene, {true, true});
    });
  }

  // Every step of a history has a row, and all rows are read when the facts of the run are told.
  TEST(ResourceEstimate, LongHistoriesTakeRoom)
  {
    Scene scene                            = scene_of(100);
    scene.discrete.stepping.step           = 0.01;
    scene.loading.inertial_number          = 1e-3;
    scene.discrete.method.history_interval = 0;
    const ResourceEstimate every           = estimate_resources(scene, {true, false});
    scene.discrete.method.history_interval = 10;
    const ResourceEstimate tenth           = estimate_resources(scene, {true, false});
    EXPECT_GT(every.disk, tenth.disk);
    EXPECT_GT(every.memory, tenth.memory);
  }

  // moreau_quick by what it took: 1656 steps of the grains, 30 of the continuum (six stages of 0.005 in steps of at most 0.0012)
  // and 10 s to 15 s.
  TEST(ResourceEstimate, TellsStepsBytesAndTimeBeforeTheRun)
  {
    const Scene       scene = read_scene(std::string(DIPTYCH_SOURCE_DIR) + "/benchmarks/moreau_quick/scene.prm", {});
    const std::string text  = estimate_resources(scene, {true, true}).text;
    diptych::tests::expect_words(text, {"2000 grains, 165", " steps, ", " elements, 30 load steps; about ", " MB of memory, ",
                                        " MB of files, ", " s of CPU time"});
    const std::string eight = estimate_resources(scene, {true, true, 8}).text;
    EXPECT_EQ(eight.rfind("8 samples, each of 2000 grains", 0), 0u) << eight;
    EXPECT_EQ(estimate_resources(scene, {true, false}).text.find("load steps"), std::string::npos);
  }

  // Two levels: an element of the first mesh can become sixteen. How many of them do is not known before the run.
  TEST(ResourceEstimate, AdaptiveMeshesCountWithTheirFirstElements)
  {
    Scene adaptive = scene_of(2000), first = adaptive;
    adaptive.continuum.refinement        = diptych::continuum::Refinement::adaptive;
    adaptive.continuum.refinement_levels = 2;
    first.continuum.element_size *= 4;
    EXPECT_EQ(estimate_resources(adaptive, {false, true}).text, estimate_resources(first, {false, true}).text);
  }

  TEST(ResourceEstimate, SizesInFilesAreUnknown)
  {
    Scene scene                  = scene_of(1000);
    scene.discrete.method.method = diptych::discrete::Method::imported;
    EXPECT_EQ(estimate_resources(scene, {true, true}).memory, 0);
    EXPECT_EQ(estimate_resources(scene, {true, false}).text.rfind("size unknown before its files are read; about ", 0), 0u);
  }
} // namespace
