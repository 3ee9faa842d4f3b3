// diptych: a run that has no room is refused before it begins
// SPDX-License-Identifier: LGPL-2.1-or-later
#include "coupling/program/run_room.h"

#include <gtest/gtest.h>

namespace
{
  using namespace diptych::coupling;

  Scene scene_of(const int grains)
  {
    Scene scene;
    scene.sample.grains    = grains;
    scene.output.directory = testing::TempDir();
    return scene;
  }

  TEST(RunRoom, GrowsWithGrainsElementsAndSamples)
  {
    const Scene   small = scene_of(1000), large = scene_of(2000);
    const RunRoom one = expected_room(small, {true, true}), two = expected_room(large, {true, true});
    EXPECT_NEAR(two.memory / one.memory, 2, 1e-3);
    EXPECT_NEAR(two.disk / one.disk, 2, 1e-3);
    EXPECT_NEAR(expected_room(small, {true, true, 30}).disk / one.disk, 30, 1e-9);
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
    Scene scene                   = scene_of(100);
    scene.discrete.time.step      = 0.01;
    scene.loading.inertial_number = 1e-3;
    const RunRoom every           = expected_room(scene, {true, false});
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

  TEST(RunRoom, AnUsualRunIsNotRefused)
  {
    EXPECT_NO_THROW(demand_room(scene_of(2000), {true, true}));
  }
} // namespace
