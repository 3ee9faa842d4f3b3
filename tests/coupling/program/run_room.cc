// diptych: a run that has no room is refused before it begins
// SPDX-License-Identifier: LGPL-2.1-or-later
#include "coupling/program/run_room.h"

#include <gtest/gtest.h>

#include "coupling/scene/scene_file.h"

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

  TEST(RunRoom, GrowsWithGrainsElementsAndSamples)
  {
    const Scene   small = scene_of(1000), large = scene_of(2000);
    const RunRoom one = expected_room(small, {true, true}), two = expected_room(large, {true, true});
    EXPECT_NEAR(two.memory / one.memory, 2, 1e-3);
    const double none = 2e6; // every file is given a megabyte at first
    EXPECT_NEAR((two.disk - none) / (one.disk - none), 2, 1e-3);
    EXPECT_NEAR((expected_room(small, {true, true, 30}).disk - none) / (one.disk - none), 30, 1e-9);
    EXPECT_EQ(expected_room(small, {true, true, 30}).memory, one.memory);
    EXPECT_LT(expected_room(small, {true, false}).memory, one.memory);
  }

  TEST(RunRoom, WhatFitsNoMachineIsRefusedWithItsSize)
  {
    Scene scene                  = scene_of(1000000);
    scene.continuum.element_size = 1e-6;
    try
      {
        demand_room(scene, {true, true});
        FAIL() << "it was taken";
      }
    catch (const std::runtime_error &error)
      {
        const std::string told = error.what();
        for (const char *part : {"1000000 grains", "elements", "GB of memory", "nothing was written", "continuum/element_size"})
          EXPECT_NE(told.find(part), std::string::npos) << told;
      }
  }

  // Every step of a history has a row, and all rows are read when the facts of the run are told.
  TEST(RunRoom, LongHistoriesTakeRoom)
  {
    Scene scene                            = scene_of(100);
    scene.discrete.time.step               = 0.01;
    scene.discrete.method.history_interval = 0;
    scene.loading.inertial_number          = 1e-3;
    const RunRoom every                    = expected_room(scene, {true, false});
    EXPECT_EQ(expected_room(scene, {true, false, 5}).memory, every.memory);
    scene.discrete.method.history_interval = 10;
    const RunRoom tenth                    = expected_room(scene, {true, false});
    EXPECT_GT(every.disk, tenth.disk);
    EXPECT_GT(every.memory, tenth.memory);
    scene.discrete.method.history_interval = 0;
    scene.loading.inertial_number          = 1e-8;
    EXPECT_THROW(demand_room(scene, {true, false}), std::runtime_error);
    EXPECT_NO_THROW(demand_room(scene, {false, true}));
  }

  // moreau_quick by what it took: 661 steps of the grains, 30 of the continuum (six stages of 0.005 in steps of at most 0.0012).
  TEST(RunRoom, TellsStepsBytesAndTimeBeforeTheRun)
  {
    const Scene   scene = read_scene(std::string(DIPTYCH_SOURCE_DIR) + "/benchmarks/moreau_quick/scene.prm", {});
    const RunRoom room = expected_room(scene, {true, true}), grains = expected_room(scene, {true, false});
    EXPECT_NEAR(room.steps, 661, 20);
    EXPECT_EQ(room.load_steps, 30);
    EXPECT_EQ(grains.load_steps, 0);
    EXPECT_GT(room.cpu_s.low, grains.cpu_s.low);
    EXPECT_LT(grains.cpu_s.low, grains.cpu_s.high);
    const std::string text = room_text(scene, {true, true});
    for (const char *part :
         {"2000 grains", " steps, ", "elements, 30 load steps; about ", " of memory, ", " of files, ", " of CPU time"})
      EXPECT_NE(text.find(part), std::string::npos) << text;
    const std::string eight = room_text(scene, {true, true, 8});
    EXPECT_EQ(eight.rfind("8 samples, each of 2000 grains", 0), 0u) << eight;
    EXPECT_NEAR(expected_room(scene, {true, true, 8}).cpu_s.high / room.cpu_s.high, 8, 1e-9);
  }

  TEST(RunRoom, WhatFilesHoldIsNotGuessed)
  {
    Scene scene                  = scene_of(1000);
    scene.discrete.method.method = diptych::discrete::Method::imported;
    EXPECT_EQ(expected_room(scene, {true, true}).memory, 0);
    EXPECT_EQ(room_text(scene, {true, false}).find("grains"), std::string::npos);
  }

  TEST(RunRoom, AnUsualRunIsNotRefused)
  {
    EXPECT_NO_THROW(demand_room(scene_of(2000), {true, true}));
  }
} // namespace
