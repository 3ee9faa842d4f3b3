// diptych: records of a folder that are not what this program writes
// SPDX-License-Identifier: LGPL-2.1-or-later
#include "coupling/folders/provenance.h"

#include <filesystem>
#include <fstream>

#include <gtest/gtest.h>
#include <unistd.h>

namespace
{
  namespace fs = std::filesystem;
  using namespace diptych::coupling;

  struct Provenance : testing::Test
  {
    fs::path folder = fs::path(testing::TempDir()) / ("provenance" + std::to_string(getpid()));

    void SetUp() override { fs::create_directories(folder); }
    void TearDown() override { fs::remove_all(folder); }

    void expect_refused(const std::string &text)
    {
      std::ofstream(folder / "provenance.json") << text;
      try
        {
          (void)read_run_facts(folder);
          (void)recorded_scene(folder);
          ADD_FAILURE() << "it was taken: " << text.substr(0, 100);
        }
      catch (const std::invalid_argument &error)
        {
          const std::string told = error.what();
          EXPECT_NE(told.find((folder / "provenance.json").string()), std::string::npos) << told;
          EXPECT_EQ(told.find("[json.exception"), std::string::npos) << told;
        }
    }
  };

  TEST_F(Provenance, WhatIsDamagedOrForeignIsNamed)
  {
    for (const char *text : {"", "{", "[]", "null", "1", "NaN", R"({"discrete": {"finished": "yes"}})",
                             R"({"discrete": {"step": []}})", R"({"phases": 3})", R"({"discrete": []})", R"({"continuum": 3})",
                             R"({"phases": [3, {"name": 7}]})", R"({"scene": {}})"})
      expect_refused(text);
    expect_refused(std::string(60000, '['));
  }

  TEST_F(Provenance, NoneIsNone)
  {
    EXPECT_FALSE(read_run_facts(folder).discrete.finished);
    EXPECT_EQ(recorded_scene(folder), "");
  }
} // namespace
