// diptych: scene files: every wrong word is named with its place and its nearest neighbour
// SPDX-License-Identifier: LGPL-2.1-or-later
#include "coupling/scene/scene_file.h"
#include "discrete/files/text_file.h"
#include "tests/common.h"

namespace
{
  using namespace diptych::coupling;
  using namespace diptych::tests;

  // A scene file that lives as long as the test.
  struct SceneFile
  {
    Folder      folder;
    std::string path;

    explicit SceneFile(const std::string &text, const std::string &ending = ".prm")
        : path(folder / "scene_test" + ending)
    {
      diptych::discrete::write_text(path, text.empty() ? "# all defaults\n" : text); // without a word it would be refused
    }
  };

  std::string error_of(const std::string              &text,
                       const std::vector<std::string> &overrides = {},
                       const std::string              &ending    = ".prm")
  {
    const SceneFile file(text, ending);
    return refusal<SceneError>([&] { read_scene(file.path, overrides); });
  }

  TEST(Scene, ReadsSectionsAndKeepsDefaults)
  {
    const SceneFile file("# comment\nsubsection sample\n  set grains = 500 # trailing\nend\n\nsubsection comparison\n"
                         "  set window_edges = 0, 0.01, \\\n    0.02\nend\n");
    const Scene     scene = read_scene(file.path, {"loading/inertial_number=1e-4", "discrete/solver=nsgs"});
    EXPECT_EQ(scene.sample.grains, 500);
    EXPECT_EQ(scene.sample.radius_min, 0.3);
    EXPECT_EQ(scene.loading.inertial_number, 1e-4);
    EXPECT_EQ(scene.discrete.solver.solver, diptych::discrete::ContactSolver::nsgs);
    EXPECT_EQ(scene.comparison.window_edges, (std::vector<double>{0, 0.01, 0.02}));
  }

  TEST(Scene, ReadsTheSameFromJson)
  {
    const SceneFile file("{\"sample\": {\"grains\": 500},\n \"discrete\": {\"friction\": {\"value\": \"0.3\"}},\n"
                         " \"comparison\": {\"window_edges\": [0, 0.02]}}",
                         ".json");
    const Scene     scene = read_scene(file.path, {});
    EXPECT_EQ(scene.sample.grains, 500);
    EXPECT_EQ(scene.discrete.law.friction, 0.3);
    EXPECT_EQ(scene.comparison.window_edges, (std::vector<double>{0, 0.02}));
  }

  TEST(Scene, ReadsEveryKindOfValueOfTheContinuum)
  {
    const Scene scene = read_scene(
      SceneFile("").path, {"continuum/hardening=table", "continuum/table_strain=0, 0.1", "continuum/table_friction_angle=30, 20",
                           "continuum/table_dilatancy_angle=10, 0", "continuum/table_cohesion=0.1, 0.2",
                           "continuum/cohesion_residual=0.25", "continuum/refinement_levels=3", "continuum/mesh=mine.msh"});
    EXPECT_EQ(scene.continuum.material.hardening, diptych::continuum::kind_of<diptych::continuum::TableHardening>);
    EXPECT_EQ(scene.continuum.material.table_strain, (std::vector<double>{0, 0.1}));
    EXPECT_EQ(scene.continuum.material.table_friction_angle, (std::vector<double>{30, 20}));
    EXPECT_EQ(scene.continuum.material.cohesion_residual, std::optional<double>(0.25));
    EXPECT_EQ(scene.continuum.refinement_levels, 3);
    EXPECT_EQ(scene.continuum.mesh.file, std::filesystem::current_path() / "mine.msh");
    EXPECT_FALSE(read_scene(SceneFile("").path, {}).continuum.material.cohesion_residual);
    EXPECT_TRUE(read_scene(SceneFile("").path, {}).continuum.material.table_strain.empty());
  }

  TEST(Scene, OnlyAComparisonAsksItsWindowsToBeStages)
  {
    const SceneFile file("subsection comparison\n  set window_edges = 0, 0.013\nend\n");
    EXPECT_THROW(read_scene(file.path, {}), SceneError);
    EXPECT_NO_THROW(read_scene(file.path, {}, false));
  }

  // In a descent 1 is the whole height.
  TEST(Scene, AStrainInPerCentIsRefusedOrDoubtful)
  {
    const SceneFile file("# mine\n");
    const auto      with = [&](const std::string &strain) {
      return read_scene(file.path, {"loading/axial_strain=" + strain, "loading/stages=" + strain}, false).warnings;
    };
    expect_words(refusal([&] { with("1"); }), {"loading/axial_strain=1", "below 1", "3 % is 0.03"});
    ASSERT_EQ(with("0.4").size(), 1u);
    expect_words(with("0.4")[0], {"loading/axial_strain=0.4", "40 %", "3 % is 0.03"});
    EXPECT_TRUE(with("0.3").empty());
  }

  // The table's progress is the end of the loading, and its controls must be independent.
  TEST(Scene, ACellFollowsATable)
  {
    const SceneFile   file("subsection discrete\n  set lateral = cell\nend\nsubsection loading\n  set mode = path\nend\n");
    const std::string table             = file.folder / "path.csv";
    const std::vector<std::string> path = {"loading/path=" + table};
    diptych::discrete::write_text(table, "progress,eyy,sxx,exy\n0,0,1,0\n2,0.02,1,0\n3,0.01,2,0\n");
    const Scene scene = read_scene(file.path, path, false);
    EXPECT_EQ(scene.loading.axial_strain, 3);
    EXPECT_EQ(stages(scene.loading).back(), 3);
    const auto cell = discrete_loading(scene.loading).path;
    EXPECT_NEAR(times_of(cell, 1, 1e-3).back(), 30, 1e-9) << "0.02 of eyy, then as much as 0.01 for the stress";
    const auto refused = [&] { return refusal([&] { read_scene(file.path, path, false); }); };
    diptych::discrete::write_text(table, "exx,eyy,volume\n0,0,0\n0,0.1,0.1\n");
    expect_words(refused(), {table, "header line", "exx, eyy, volume", "one follows from the others"});
    diptych::discrete::write_text(table, "eyy,sxx,exy\n0,1,0\n0.1,one,0\n");
    expect_words(refused(), {table, "line 3", "sxx", "one"});
  }

  TEST(Scene, AnUnknownKeyIsNamedWithFileLineAndNearestKey)
  {
    expect_words(error_of("subsection sample\n\n  set grians = 500\nend\n"),
                 {".prm", "line 3", "sample/grians", "sample/grains"});
    expect_words(error_of("{\n\"sample\":\n {\"grians\": 500}}", {}, ".json"),
                 {".json", "line 3", "sample/grians", "sample/grains"});
    expect_words(error_of("", {"sample/sead=3"}), {"--set", "sample/sead", "sample/seed"});
  }

  // The error holds file, line, key and value: for a wrong value, a wrong key, and contradictions within and between sections.
  TEST(Scene, ARefusalIsData)
  {
    const struct
    {
      std::string text;
      int         line;
      std::string key, value;
    } cases[] = {
      {"subsection discrete\n  set friction = -0.3\nend\n", 2, "discrete/friction", "-0.3"},
      {"subsection sample\n\n  set grians = 500\nend\n", 3, "sample/grians", ""},
      {"subsection continuum\n  set dilatancy_angle_peak = 50\nend\n", 2, "continuum/dilatancy_angle_peak", "50"},
      {"subsection sample\n  set radius_min = 0.2\nend\n", 2, "sample/radius_min", "0.2"},
      {"subsection comparison\n  set window_edges = 0, 0.0123\nend\n", 2, "comparison/window_edges", "0, 0.0123"},
    };
    for (const auto &c : cases)
      {
        const SceneFile file(c.text, ".prm");
        try
          {
            read_scene(file.path, {});
            ADD_FAILURE() << "accepted: " << c.text;
          }
        catch (const SceneError &error)
          {
            EXPECT_EQ(error.refusal.place.file, file.path) << error.what();
            EXPECT_EQ(error.refusal.place.line, c.line) << error.what();
            EXPECT_EQ(error.refusal.key, c.key) << error.what();
            EXPECT_EQ(error.refusal.value, c.value) << error.what();
          }
      }
  }

  TEST(Scene, AnUnknownSectionIsNamed)
  {
    expect_words(error_of("subsection continum\n  set law = linear_elastic\nend\n"), {"line 1", "continum", "'continuum'"});
    expect_words(error_of("subsection continum\nend\n"), {"line 1", "continum", "'continuum'"});
    expect_words(error_of("{\"sample\": {},\n\"continum\": {}}", {}, ".json"), {"line 2", "continum", "'continuum'"});
  }

  TEST(Scene, ValuesOfWrongTypeOrRangeAreNamedWithWhatIsAllowed)
  {
    expect_words(error_of("subsection discrete\n  set friction = rough\nend\n"),
                 {"line 2", "discrete/friction", "'rough'", "a number from 0 to 100"});
    expect_words(error_of("subsection discrete\n  set friction = -1\nend\n"), {"discrete/friction", "'-1'", "from 0 to 100"});
    expect_words(error_of("subsection sample\n  set grains = 4.5\nend\n"), {"sample/grains", "'4.5'", "whole number"});
    expect_words(error_of("subsection discrete\n  set solver = lemke\nend\n"), {"'lemke'", "psor, nsgs"});
    expect_words(error_of("subsection output\n  set report = maybe\nend\n"), {"'maybe'", "true or false"});
  }

  // The library's parser keeps one of them and says nothing.
  TEST(Scene, AKeyThatStandsTwiceInAnObjectOfJsonIsNamed)
  {
    expect_words(error_of("{\"sample\": {\"grains\": 500,\n \"seed\": 2,\n \"grains\": 60\n}}", {}, ".json"),
                 {".json, line 3", "'grains'", "twice"});
    expect_words(
      error_of("{\"sample\": {\"grains\": 500},\n\"loading\": {\"pressure\": 1},\n\"sample\": {\"seed\": 2}}", {}, ".json"),
      {".json, line 3", "'sample'", "twice"});
    EXPECT_EQ(error_of("{\"sample\": {\"file\": \"\"},\n\"discrete\": {\"file\": \"\"}}", {}, ".json"), "");
  }

  TEST(Scene, BrokenStructureIsNamedWithItsLine)
  {
    expect_words(error_of("subsection sample\n  set grains = 500\n"), {"sample", "no 'end'"});
    expect_words(error_of("subsection sample\n  grains = 500\nend\n"), {"line 2", "grains = 500"});
    expect_words(error_of("end\n"), {"line 1", "without a subsection"});
    expect_words(error_of("{\"sample\": {\"grains\": 500}\n", {}, ".json"), {"line 2", "JSON"});
    expect_words(error_of("", {"sample.grains=3"}), {"--set sample.grains=3", "section/key=value"});
    expect_words(error_of("", {"friction=0.3"}), {"--set friction=0.3", "discrete/friction"});
  }

  TEST(Scene, WhatIsNoTextIsRefusedWithItsLine)
  {
    expect_words(error_of("subsection output\n  set directory = m\xfc\nend\n"), {".prm", "line 2", "byte of value 252", "UTF-8"});
    expect_words(error_of(std::string("# one\n\n\0", 8)), {".prm", "line 3", "byte of value 0"});
    expect_words(error_of("{\"sample\":\n {\"seed\": \"\xed\xa0\x80\"}}", {}, ".json"),
                 {".json", "line 2", "byte of value 237"}); // a surrogate
    EXPECT_EQ(error_of("# \xc3\xa4 \xe2\x82\xac \xf0\x9f\x98\x80\n"), "");
    EXPECT_EQ(error_of("\xef\xbb\xbfsubsection sample\r\n  set seed = 2\r\nend\r\n"), ""); // of an editor on Windows
    expect_words(error_of(std::string(17 << 20, ' ')), {".prm", "longer than"});
    EXPECT_THROW(read_scene("/dev/zero", {}), SceneError);
    EXPECT_THROW(read_scene("/no/such/scene.prm", {}), SceneError);
    EXPECT_THROW(read_scene("/proc/self/mem", {}), SceneError); // opens, but cannot be read
  }

  TEST(Scene, DeepLongAndCrowdedJsonIsRefusedOrReadAtOnce)
  {
    const auto nested = [](const int n) {
      std::string text;
      for (int k = 0; k < n; ++k)
        text += "{\"a\":";
      return text + "1" + std::string(std::size_t(n), '}');
    };
    expect_words(error_of(nested(60000), {}, ".json"), {".json", "32 levels"});
    expect_words(error_of("{\"a\":" + std::string(60000, '[') + std::string(60000, ']') + "}", {}, ".json"),
                 {".json", "32 levels"});
    std::string keys, numbers;
    for (int k = 0; k < 20000; ++k)
      keys += (k > 0 ? ",\"k" : "\"k") + std::to_string(k) + "\":1";
    expect_words(error_of("{\"sample\":{" + keys + "}}", {}, ".json"), {".json", "10000 keys"});
    for (int k = 0; k < 100000; ++k)
      numbers += (k > 0 ? ",\n" : "") + std::to_string(k);
    expect_words(error_of("{\"comparison\":{\"window_edges\":[" + numbers + "]}}", {}, ".json"), {"window_edges"});
    expect_words(error_of("subsection sample\n set seed = " + std::string(26000, '1') + "\nend\n"), {"line 2", "sample/seed"});
  }

  TEST(Scene, EveryValueSurvivesTheEcho)
  {
    const std::string backslash = "\\";
    for (const std::string &name :
         std::vector<std::string>{"a#b", "#", "a" + backslash, "a" + backslash + backslash, "a" + backslash + "#b",
                                  "b " + backslash + "# c", std::string("\xc3\xa4 mit Leerzeichen")})
      {
        const Scene     scene = read_scene(SceneFile("").path, {"output/directory=" + name});
        const SceneFile again(resolved_text(scene));
        EXPECT_EQ(read_scene(again.path, {}).output.directory, scene.output.directory) << name;
      }
    EXPECT_EQ(read_scene(SceneFile("subsection output\n  set directory = a\\#b # mine\nend\n").path, {}).output.directory, "a#b");
    EXPECT_EQ(read_scene(SceneFile("subsection output\n  set directory = a\\\n b\nend\n").path, {}).output.directory, "a b");
    expect_words(error_of("subsection output\n  set directory = a\\"), {"line 2", "the file ends"});
  }

  TEST(Scene, ContradictionsBetweenKeysAreNamed)
  {
    expect_words(error_of("subsection loading\n  set axial_strain = 0.012\n  set stage_strain = 0.005\nend\n"),
                 {"loading/axial_strain", "loading/stage_strain"});
    expect_words(error_of("subsection comparison\n  set window_edges = 0, 0.013\nend\n"), {"window_edges", "0.013"});
    expect_words(error_of("subsection continuum\n  set friction_angle_residual = 50\nend\n"),
                 {"friction_angle_peak", "line 2", "continuum/friction_angle_residual = '50'"});
    expect_words(error_of("", {"continuum/element=q1_bbar"}), {"continuum", "element = q1_bbar", "--set"});
    expect_words(error_of("", {"continuum/mesh=rectangle", "continuum/rectangle_width=3"}), {"rectangle_height = 0"});
    expect_words(error_of("", {"loading/mode=time", "comparison/window_edges=0, 5.5"}),
                 {"window_edges", "5.5", "stage_time", "duration"});
    expect_words(error_of("subsection sample\n  set radius_max = 0.8\nend\n"), {"radius_min", "radius_max"});
  }

  // The echo holds every key with its value, so that reading it back gives the same scene.
  TEST(Scene, TheEchoReadsBackAsTheSameScene)
  {
    const SceneFile file(
      "subsection sample\n  set grains = 777\nend\nsubsection continuum\n  set poisson_ratio = 0.123456789\nend\n");
    const Scene     scene = read_scene(file.path, {});
    const SceneFile echoed(resolved_text(scene), "_echo.prm");
    Scene           again = read_scene(echoed.path, {});
    EXPECT_EQ(again.sample.grains, 777);
    again.name = scene.name;
    EXPECT_EQ(resolved_text(again), resolved_text(scene));
  }

  TEST(Scene, ExplainListsEveryKeyAndRefusesUnknownSections)
  {
    const std::string all = explain("");
    expect_words(all, {"sample", "grains", "loading", "inertial_number", "discrete", "tolerance", "continuum",
                       "friction_angle_peak", "comparison", "window_edges", "output", "directory"});
    EXPECT_EQ(explain("platen_friction").find("discrete\n  platen_friction = "), 0);
    EXPECT_EQ(explain("discrete/friction").find("discrete\n  friction = "), 0);
    EXPECT_THROW(explain("sampel"), SceneError);
  }

  TEST(Scene, StagesAreWholeMultiplesUpToTheEnd)
  {
    LoadingOptions loading;
    loading.axial_strain = 0.03, loading.stage_strain = 0.005;
    const std::vector<double> strains = stages(loading);
    ASSERT_EQ(strains.size(), 6u);
    EXPECT_DOUBLE_EQ(strains.back(), 0.03);
  }
} // namespace
