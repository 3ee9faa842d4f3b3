// diptych: a run that does not fit the machine is refused before it begins
// SPDX-License-Identifier: LGPL-2.1-or-later
#include "coupling/program/resource_estimate.h"

#include "coupling/scene/scene_file.h"
#include "tests/files.h"

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

  TEST(ResourceEstimate, WhatFitsNoMachineIsRefusedWithItsSize)
  {
    Scene scene                  = scene_of(1000000);
    scene.continuum.element_size = 1e-6;
    diptych::tests::expect_refused<std::runtime_error>({"1000000 grains", "elements", "GB of memory", "continuum/element_size"},
                                                       [&] {
                                                         require_resources(scene, {true, true});
                                                       });
  }

  // Every step of a history has a row, and all rows are read when the facts of the run are told.
  TEST(ResourceEstimate, LongHistoriesTakeRoom)
  {
    Scene scene                            = scene_of(100);
    scene.discrete.time.step               = 0.01;
    scene.discrete.method.history_interval = 0;
    scene.loading.inertial_number          = 1e-3;
    const ResourceEstimate every           = estimate_resources(scene, {true, false});
    EXPECT_EQ(estimate_resources(scene, {true, false, 5}).memory, every.memory);
    scene.discrete.method.history_interval = 10;
    const ResourceEstimate tenth           = estimate_resources(scene, {true, false});
    EXPECT_GT(every.disk, tenth.disk);
    EXPECT_GT(every.memory, tenth.memory);
    scene.discrete.method.history_interval = 0;
    scene.loading.inertial_number          = 1e-8;
    EXPECT_THROW(require_resources(scene, {true, false}), std::runtime_error);
    EXPECT_NO_THROW(require_resources(scene, {false, true}));
  }

  // moreau_quick by what it took: 1656 steps of the grains, 30 of the continuum (six stages of 0.005 in steps of at most 0.0012).
  TEST(ResourceEstimate, TellsStepsBytesAndTimeBeforeTheRun)
  {
    const Scene            scene    = read_scene(std::string(DIPTYCH_SOURCE_DIR) + "/benchmarks/moreau_quick/scene.prm", {});
    const ResourceEstimate estimate = estimate_resources(scene, {true, true}), grains = estimate_resources(scene, {true, false});
    EXPECT_NEAR(estimate.steps, 1656, 20);
    EXPECT_EQ(estimate.load_steps, 30);
    EXPECT_EQ(grains.load_steps, 0);
    EXPECT_GT(estimate.cpu_s.low, grains.cpu_s.low);
    EXPECT_LT(grains.cpu_s.low, grains.cpu_s.high);
    diptych::tests::expect_words(
      resource_text(scene, {true, true}),
      {"2000 grains", " steps, ", "elements, 30 load steps; about ", " of memory, ", " of files, ", " of CPU time"});
    const std::string eight = resource_text(scene, {true, true, 8});
    EXPECT_EQ(eight.rfind("8 samples, each of 2000 grains", 0), 0u) << eight;
    EXPECT_NEAR(estimate_resources(scene, {true, true, 8}).cpu_s.high / estimate.cpu_s.high, 8, 1e-9);
  }

  // Two levels: an element of the first mesh can become sixteen. How many of them do is not known before the run.
  TEST(ResourceEstimate, AdaptiveMeshesLieBetweenTheFirstMeshAndTheFinest)
  {
    Scene uniform                  = scene_of(2000);
    uniform.continuum.element_size = 0.5;
    Scene adaptive = uniform, first = uniform;
    adaptive.continuum.refinement        = diptych::continuum::Refinement::adaptive;
    adaptive.continuum.refinement_levels = 2;
    first.continuum.element_size *= 4;
    first.comparison.coarse_element_size *= 4;
    const RunParts         parts{false, true};
    const ResourceEstimate estimate = estimate_resources(adaptive, parts);
    EXPECT_NEAR(estimate.cpu_s.low, estimate_resources(first, parts).cpu_s.low, 1e-9);
    EXPECT_NEAR(estimate.cpu_s.high, estimate_resources(uniform, parts).cpu_s.high, 1e-9);
    diptych::tests::expect_words(resource_text(adaptive, parts), {" elements at most, ", "; at most "});
    EXPECT_EQ(resource_text(uniform, parts).find("at most"), std::string::npos);
    uniform.continuum.element_size = adaptive.continuum.element_size = 0.005; // 4e4 bytes x 8e7 elements
    EXPECT_THROW(require_resources(uniform, parts), std::runtime_error);
    adaptive.continuum.refinement_levels = 6;
    EXPECT_NO_THROW(require_resources(adaptive, parts));
  }

  TEST(ResourceEstimate, WhatFilesHoldIsNotGuessed)
  {
    Scene scene                  = scene_of(1000);
    scene.discrete.method.method = diptych::discrete::Method::imported;
    EXPECT_EQ(estimate_resources(scene, {true, true}).memory, 0);
    EXPECT_EQ(resource_text(scene, {true, false}).rfind("size unknown before its files are read; about ", 0), 0u);
  }

  TEST(ResourceEstimate, AnUsualRunIsNotRefused)
  {
    EXPECT_NO_THROW(require_resources(scene_of(2000), {true, true}));
  }
} // namespace
