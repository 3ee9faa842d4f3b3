// diptych: studies are read from their files, and wrong ones are refused
// SPDX-License-Identifier: LGPL-2.1-or-later
#include "coupling/studies/study_file.h"

#include <filesystem>
#include <fstream>

#include <gtest/gtest.h>

#include "coupling/studies/study_points.h"

namespace
{
  using namespace diptych::coupling;
  namespace fs = std::filesystem;

  struct Folder
  {
    fs::path path;

    Folder()
    {
      std::string name = (fs::temp_directory_path() / "diptych_XXXXXX").string();
      path             = mkdtemp(name.data());
      std::ofstream(path / "scene.prm") << "subsection sample\n  set grains = 100\nend\n";
    }
    Folder(const Folder &)            = delete;
    Folder &operator=(const Folder &) = delete;
    ~Folder() { fs::remove_all(path); }

    std::string study(const std::string &text) const
    {
      std::ofstream(path / "study.json") << text;
      return (path / "study.json").string();
    }
  };

  const std::string head = "{\n\"scene\": \"scene.prm\",\n\"command\": \"discrete\",\n";
  const std::string tail = "\"reference\": {\"discrete/step\": 0.1},\n\"quantities\": [{\"strength\": [0.005, 0.02]}]\n}\n";
  const std::string axes = "\"axes\": [{\"key\": \"discrete/step\", \"values\": [0.1, 0.2]},\n"
                           "{\"key\": \"discrete/friction\", \"values\": [0.3, 0.4, 0.5]}],\n";

  std::string refusal(const std::string &text)
  {
    const Folder folder;
    try
      {
        const Study study = read_study(folder.study(text), {});
        (void)points_of(study);
      }
    catch (const SceneError &error)
      {
        return error.what();
      }
    return "";
  }

  void expect_refused(const std::string &text, const std::vector<std::string> &words)
  {
    const std::string found = refusal(text);
    for (const std::string &word : words)
      EXPECT_NE(found.find(word), std::string::npos) << "'" << word << "' is not in: " << found;
  }

  TEST(StudyFile, AGridHasEveryPairTheLastAxisFastest)
  {
    const Folder folder;
    const Study  study  = read_study(folder.study(head + axes + tail), {});
    const auto   points = points_of(study);
    ASSERT_EQ(points.size(), 7u);
    EXPECT_EQ(points[0].family, -1);
    EXPECT_EQ(points[1].labels, (std::vector<std::string>{"0.1", "0.3"}));
    EXPECT_EQ(points[2].labels, (std::vector<std::string>{"0.1", "0.4"}));
    EXPECT_EQ(points[6].labels, (std::vector<std::string>{"0.2", "0.5"}));
    EXPECT_DOUBLE_EQ(points[6].runs[0].scene->discrete.law.friction, 0.5);
    EXPECT_FALSE(points[6].runs[0].scene->output.report) << "single runs need no report";
  }

  TEST(StudyFile, AListMovesItsAxesTogether)
  {
    const Folder      folder;
    const std::string list   = "\"combine\": \"list\", \"axes\": [{\"key\": \"discrete/step\", \"values\": [0.1, 0.2]},\n"
                               "{\"key\": \"discrete/friction\", \"values\": [0.3, 0.4]}],\n";
    const auto        points = points_of(read_study(folder.study(head + list + tail), {}));
    ASSERT_EQ(points.size(), 3u);
    EXPECT_EQ(points[2].labels, (std::vector<std::string>{"0.2", "0.4"}));
    expect_refused(head + "\"combine\": \"list\", " + axes + tail, {"study.json, line 5", "'step' has 2", "'friction' 3"});
  }

  TEST(StudyFile, TheSameSceneIsTheSameRun)
  {
    const Folder folder;
    const auto   points = points_of(
        read_study(folder.study(head + "\"axes\": [{\"key\": \"discrete/step\", \"values\": [0.1, 0.2]}],\n" + tail), {}));
    EXPECT_EQ(points[0].runs[0].name, points[1].runs[0].name) << "the reference has the first point's step";
    EXPECT_NE(points[0].runs[0].name, points[2].runs[0].name);
  }

  TEST(StudyFile, AnAxisMayHaveAReferenceOfItsOwnAtEachPoint)
  {
    const Folder folder;
    const auto   points = points_of(
        read_study(folder.study(head +
                                "\"axes\": [{\"key\": \"discrete/friction\", \"values\": [0.3, 0.5], \"own_reference\": true},\n"
                                  "{\"key\": \"discrete/step\", \"values\": [0.2, 0.4]}],\n" +
                                tail),
                   {}));
    ASSERT_EQ(points.size(), 6u);
    EXPECT_EQ(points[0].labels, std::vector<std::string>{"friction 0.3"});
    EXPECT_DOUBLE_EQ(points[1].runs[0].scene->discrete.law.friction, 0.5);
    EXPECT_DOUBLE_EQ(*points[1].runs[0].scene->discrete.time.step, 0.1) << "the reference's step";
    EXPECT_EQ(points[2].reference, 0u);
    EXPECT_EQ(points[5].reference, 1u);
  }

  TEST(StudyFile, SeedsAreSamplesAndReplaceTheWordInFileNames)
  {
    const Folder folder;
    const auto   seeds = points_of(read_study(folder.study(head + "\"seeds\": \"3-5\",\n" + axes + tail), {}));
    ASSERT_EQ(seeds[1].runs.size(), 3u);
    EXPECT_EQ(seeds[1].runs[2].scene->sample.seed, 5);
    std::ofstream(folder.path / "grains_7.csv") << "x,y,r\n0,0.5,0.5\n1,0.5,0.5\n";
    const auto files = points_of(
      read_study(folder.study(head + "\"seeds\": 7, \"set\": {\"sample/file\": \"grains_{seed}.csv\"},\n" + axes + tail), {}));
    EXPECT_EQ(files[1].runs[0].scene->sample.file, (folder.path / "grains_7.csv").string());
  }

  TEST(StudyFile, ContradictorySettingsRefuseOnlyTheirPoint)
  {
    const Folder folder;
    // No whole number of stages fits into 0.013.
    const auto points = points_of(read_study(
      folder.study(head +
                   "\"set\": {\"loading/stage_strain\": 0.005}, \"axes\": [{\"key\": \"loading/axial_strain\", \"values\": "
                   "[0.01, 0.013]}],\n" +
                   tail),
      {}));
    EXPECT_TRUE(points[1].runs[0].scene);
    EXPECT_FALSE(points[2].runs[0].scene);
    EXPECT_NE(points[2].runs[0].refusal.find("0.013"), std::string::npos);
  }

  TEST(StudyFile, WrongKeysAndValuesAreNamedWithTheirLines)
  {
    expect_refused("{\n\"scene\": \"none.prm\",\n" + axes + tail, {"line 2", "none.prm"});
    expect_refused(head + "\"seed\": 3,\n" + axes + tail, {"line 4", "seed: unknown key", "'seeds'"});
    expect_refused(head + "\"seeds\": \"5-3\",\n" + axes + tail, {"line 4", "5-3", "descends"});
    expect_refused(head + "\"axes\": [{\"key\": \"discrete/stepp\", \"values\": [0.1]}],\n" + tail,
                   {"line 4", "discrete/stepp", "discrete/step"});
    expect_refused(head + "\"axes\": [{\"key\": \"discrete/friction\",\n\"values\": [0.1, -1]}],\n" + tail,
                   {"line 5", "discrete/friction = '-1'", "a number from"});
    expect_refused(head + "\"axes\": [{\"key\": \"discrete/step\", \"values\": [0.1, 0.1]}],\n" + tail,
                   {"line 4", "'0.1' twice"});
    expect_refused(head + "\"axes\": [{\"key\": \"discrete/method\", \"values\": [\"nscd\"], \"converges\": true}],\n" + tail,
                   {"line 4", "converges", "nscd"});
    expect_refused(head + axes + "\"reference\": {},\n\"quantities\": [{\"column\": \"stres_ratio\", \"last\": true}]}",
                   {"line 7", "stres_ratio", "stress_ratio"});
    expect_refused(head + axes + "\"reference\": {},\n\"quantities\": [{\"strength\": [0.02, 0.01]}]}", {"line 7", "ascending"});
    expect_refused(head + axes +
                     "\"reference\": {},\n\"quantities\": [{\"last\": true, \"largest\": true, \"column\": \"time\"}]}",
                   {"exactly one of"});
    expect_refused(head + axes + "\"reference\": {},\n\"quantities\": []}", {"quantities", "missing or empty"});
    expect_refused(head + axes + "\"quantities\": [{\"strength\": [0.005, 0.02]}]}", {"'reference' is missing"});
    expect_refused(head + axes + "\"reference\": {},\n\"quantities\": [{\"of\": \"continuum\", \"strength\": [0.005, 0.02]}]}",
                   {"discrete does not write", "continuum"});
    expect_refused(head + axes + "\"reference\": {\"loading/axial_strain\": 0.013},\n\"quantities\": [{\"strength\": [0, 1]}]}",
                   {"the reference is refused", "0.013"});
    expect_refused("{\n\"scene\": \"scene.prm\",\n\"command\": \"runn\",\n" + axes + tail, {"line 3", "runn", "material-point"});
    expect_refused("{\n\"scene\": \"scene.prm\",\n" + axes +
                     "\"reference\": {},\n\"quantities\": [{\"number\": \"window 0-0.01 discrete band width\"}]}",
                   {"line 6", "'width'", "nearest"});
    expect_refused("{\n\"scene\": \"scene.prm\",\n" + axes +
                     "\"reference\": {},\n\"quantities\": [{\"number\": \"band angle\"}]}",
                   {"line 6", "'band angle'", "'angle_deg'", "ensemble.csv"});
    expect_refused(head + "\"cost\": [\"discret\"],\n" + axes + tail, {"line 4", "'discret'", "'discrete'"});
    expect_refused("{\n\"scene\": 3\n", {"no JSON"});
  }
} // namespace
