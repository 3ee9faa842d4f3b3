// diptych: records of a folder that are not what this program writes
// SPDX-License-Identifier: LGPL-2.1-or-later
#include "coupling/scene/scene.h"
#include "coupling/store/provenance.h"

#include <nlohmann/json.hpp>

#include "discrete/files/text_file.h"
#include "tests/common.h"

namespace
{
  namespace fs = std::filesystem;
  using nlohmann::json;
  using namespace diptych::coupling;

  struct Provenance : testing::Test
  {
    const diptych::tests::Folder scratch;
    const fs::path               folder = scratch.path;

    void expect_record_refused(const std::string &text)
    {
      diptych::discrete::write_text(folder / "provenance.json", text);
      const std::string told = diptych::tests::refusal([&] {
        (void)read_run_facts(folder);
        (void)recorded_scene(folder);
      });
      diptych::tests::expect_words(told, {(folder / "provenance.json").string()});
      EXPECT_EQ(told.find("[json.exception"), std::string::npos) << told;
    }
  };

  // The record of a command that computed the grains.
  json recorded(const fs::path &folder)
  {
    Scene scene;
    scene.name = "mine";
    record_phases(folder, {scene.name, {scene.sample.seed}, "diptych run mine.prm"}, {{"discrete", 2, 1, 100}});
    json record;
    std::ifstream(folder / "provenance.json") >> record;
    return record;
  }

  TEST_F(Provenance, ADamagedOrForeignRecordIsNamed)
  {
    for (const char *text :
         {"", "{", "[]", "null", "1", "NaN", "{}", R"({"a": [1, 2]})", R"({"program": "another"})", R"({"program": "diptych"})"})
      expect_record_refused(text);
    expect_record_refused(std::string(60000, '['));
    fs::remove(folder / "provenance.json");
    const json whole = recorded(folder);
    for (const auto &[key, value] : whole.items())
      if (key != "git_revision")
        {
          json changed = whole;
          changed.erase(key);
          expect_record_refused(changed.dump());
          changed[key] = 7;
          expect_record_refused(changed.dump());
        }
    for (const char *text : {R"({"discrete": {"finished": "yes"}})", R"({"discrete": {"step": []}})", R"({"discrete": []})",
                             R"({"continuum": 3})", R"({"phases": [3, {"name": 7}]})", R"({"scene": {}})", R"({"seeds": ["a"]})"})
      {
        json changed = whole;
        changed.update(json::parse(text));
        expect_record_refused(changed.dump());
      }
  }

  TEST_F(Provenance, TheRecordOfARunIsRead)
  {
    (void)recorded(folder);
    diptych::discrete::Report facts;
    facts.finished = true, facts.step = 0.25;
    record_facts(folder, facts);
    EXPECT_EQ(recorded_scene(folder), "mine");
    EXPECT_EQ(read_run_facts(folder).discrete.step, 0.25);
    EXPECT_EQ(read_run_facts(folder).phases.front().cpu_s, 1);
  }

  TEST_F(Provenance, AChangedFileIsNamed)
  {
    (void)recorded(folder);
    std::ofstream(folder / "discrete.csv") << "a\n";
    record_facts(folder, diptych::discrete::Report());
    EXPECT_NO_THROW(check_files(folder));
    std::ofstream(folder / "discrete.csv") << "b\n";
    EXPECT_THROW(check_files(folder), std::invalid_argument);
    fs::remove(folder / "discrete.csv");
    EXPECT_THROW(check_files(folder), std::invalid_argument);
  }

  TEST_F(Provenance, MissingProvenanceHasNoFacts)
  {
    EXPECT_FALSE(read_run_facts(folder).discrete.finished);
    EXPECT_EQ(recorded_scene(folder), "");
  }
} // namespace
