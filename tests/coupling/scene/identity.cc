// diptych: what makes two scenes the same, what a scene's keys are warned about, where its files are
// SPDX-License-Identifier: LGPL-2.1-or-later
#include "coupling/scene/identity.h"
#include "coupling/scene/scene_file.h"
#include "discrete/files/text_file.h"
#include "tests/common.h"

namespace
{
  using namespace diptych::coupling;
  using namespace diptych::tests;

  struct SceneFolder : Folder
  {
    SceneFolder() { std::filesystem::create_directories(path + "/data"); }

    std::string put(const std::string &name, const std::string &text) const
    {
      diptych::discrete::write_text(*this / name, text);
      return *this / name;
    }
  };

  std::vector<std::string> warnings(const std::string &text, const std::vector<std::string> &overrides = {})
  {
    const SceneFolder folder;
    return read_scene(folder.put("warned.prm", text.empty() ? "# all defaults\n" : text), overrides).warnings;
  }

  void expect_one(const std::vector<std::string> &found, const std::vector<std::string> &words)
  {
    ASSERT_EQ(found.size(), 1u);
    expect_words(found[0], words);
  }

  // Help texts, comments, order and formatting of an echo are not part of it; values are.
  TEST(Identity, ARewordedEchoIsTheSameScene)
  {
    const SceneFolder folder;
    const Scene       scene = read_scene(folder.put("mine.prm", "subsection discrete\n  set friction = 0.5\nend\n"), {});
    std::string       text  = resolved_text(scene), reworded;
    for (std::size_t at = 0, end; at < text.size(); at = end + 1)
      {
        end                    = text.find('\n', at);
        const std::string line = text.substr(at, end - at);
        const bool        help = line.find("  # ") == 0;
        reworded += (help ? "  # other words [other unit]; other range" : line) + "\n";
      }
    ASSERT_NE(reworded, text);
    const Scene again = *resolved_scene(folder.put("scene.prm", reworded));
    EXPECT_EQ(first_difference(sample_identity(scene), sample_identity(again)), "");
    EXPECT_EQ(first_difference(continuum_identity(scene), continuum_identity(again)), "");
    EXPECT_EQ(first_difference(member_identity(scene), member_identity(again)), "");
    EXPECT_EQ(text_of(sample_identity(scene)), text_of(sample_identity(again)));
  }

  TEST(Identity, EveryValueThatChangesAResultIsPartOfIt)
  {
    const Scene plain;
    Scene       other           = plain;
    other.discrete.law.friction = 0.3;
    const std::string told      = first_difference(sample_identity(other), sample_identity(plain));
    expect_words(told, {"discrete/friction", "'0.3'", "'0.4'"});

    other                                    = plain;
    other.continuum.material.internal_length = 2;
    EXPECT_EQ(first_difference(sample_identity(other), sample_identity(plain)), "");
    EXPECT_NE(first_difference(continuum_identity(other), continuum_identity(plain)), "");

    other                  = plain;
    other.sample.seed      = 7;
    other.output.directory = "elsewhere";
    EXPECT_NE(first_difference(sample_identity(other), sample_identity(plain)), "");
    EXPECT_EQ(first_difference(member_identity(other), member_identity(plain)), "") << "seed and folder are a member's own";
  }

  // Equal grains in another file are the same sample; other grains in the same file are not.
  TEST(Identity, AFileCountsByWhatIsInIt)
  {
    const SceneFolder folder;
    const std::string grains = "x,y,r\n0,0.5,0.5\n1,0.5,0.5\n2,0.5,0.5\n3,0.5,0.5\n4,0.5,0.5\n5,0.5,0.5\n6,0.5,0.5\n7,0.5,0.5\n"
                               "8,0.5,0.5\n9,0.5,0.5\n";
    Scene             here, there;
    here.sample.file = folder.put("data/a.csv", grains), there.sample.file = folder.put("b.csv", grains);
    EXPECT_EQ(first_difference(sample_identity(here), sample_identity(there)), "");
    folder.put("b.csv", grains + "10,0.5,0.5\n");
    EXPECT_NE(first_difference(sample_identity(here), sample_identity(there)), "");
  }

  TEST(Warnings, AKeyThatNothingReadsIsNamedWithItsPlaceAndReason)
  {
    expect_one(warnings("subsection continuum\n  set refinement_levels = 3\nend\n"),
               {"warned.prm, line 2", "continuum/refinement_levels = '3' is not used", "refinement = uniform"});
    expect_one(warnings("subsection continuum\n  set law = mohr_coulomb\n  set internal_length = 2\nend\n"),
               {"line 3", "internal_length", "law = mohr_coulomb"});
    expect_one(warnings("", {"comparison/averaging_width=2"}), {"--set", "averaging_width", "averaging = segments"});
    expect_one(warnings("", {"discrete/wall_mass=3"}), {"wall_mass", "discrete/lateral = end_grains"});
    expect_one(warnings("", {"discrete/solver=nsgs", "discrete/omega_sticking=1.5"}), {"omega_sticking", "solver = nsgs"});
    expect_one(warnings("", {"loading/normal_pressure=2"}), {"normal_pressure", "loading/mode = descent"});
    expect_one(warnings("subsection continuum\n  set refinement_levels = 1\nend\n"), {"refinement_levels = '1' is not used"});
    expect_one(warnings("", {"loading/mode=time", "comparison/window_edges=0,10", "comparison/averaging_strain=0.01"}),
               {"averaging_strain", "whole stage"});
    expect_one(warnings("", {"sample/left_wall=-3"}), {"left_wall", "is empty"});
    expect_one(warnings("", {"continuum/weak_spot_x=0.3"}), {"weak_spot_x", "weak_spot_strain = 0"});
    expect_one(warnings("", {"continuum/rectangle_width=3"}), {"rectangle_width", "mesh = outline"});
    expect_one(warnings("", {"continuum/law=linear_elastic", "continuum/softening_strain=0.1"}), {"law = linear_elastic"});
    expect_one(warnings("", {"discrete/method=penalty", "discrete/penetration_correction=none"}), {"penetration_correction"});
    // an echo holds every key, and only what was changed in it is somebody's wish
    EXPECT_TRUE(warnings(resolved_text(Scene())).empty());
    expect_one(warnings(resolved_text(Scene()), {"continuum/refinement_levels=3"}), {"--set", "refinement_levels"});
    EXPECT_TRUE(warnings("subsection continuum\n  set refinement = adaptive\n  set refinement_levels = 3\nend\n").empty());
  }

  TEST(Warnings, ACoarseMeshThatIsNotCoarserIsNamedWithBothKeys)
  {
    expect_one(warnings("subsection comparison\n  set coarse_element_size = 4\nend\n", {"continuum/element_size=4"}),
               {"warned.prm, line 2", "comparison/coarse_element_size = 4", "continuum/element_size = 4"});
    expect_one(warnings("", {"continuum/element_size=3", "comparison/coarse_element_size=2"}),
               {"--set continuum/element_size=3", "--set comparison/coarse_element_size=2"});
    EXPECT_TRUE(warnings("", {"continuum/element_size=5", "comparison/coarse_element_size=0"}).empty());
    EXPECT_TRUE(warnings("", {"continuum/element_size=3.9"}).empty());
  }

  // Default E = 500 P. Between 50 and 1e6, and cohesions up to 1, nothing is said.
  TEST(Warnings, ModuliAndCohesionsThatLookAbsoluteArePointedOut)
  {
    expect_one(warnings("subsection continuum\n  set youngs_modulus = 49\nend\n"), {"line 2", "youngs_modulus = 49", "below 50"});
    expect_one(warnings("subsection continuum\n  set youngs_modulus = 5e8\nend\n"), {"above 1e6"});
    expect_one(warnings("subsection continuum\n  set cohesion = 2\n  set cohesion_residual = 2\nend\n"),
               {"cohesion = 2", "above 1"});
    EXPECT_TRUE(warnings("subsection continuum\n  set youngs_modulus = 50\nend\n").empty());
    EXPECT_TRUE(warnings("subsection continuum\n  set youngs_modulus = 1e6\nend\n").empty());
    EXPECT_TRUE(warnings("subsection loading\n  set pressure = 1e4\nend\n").empty()) << "they count in the pressure";
  }

  TEST(SceneFiles, AreFoundFromTheScenesFolderAndThoseOfOverridesFromTheWorkingOne)
  {
    const SceneFolder folder;
    std::string       rows = "x,y,r\n";
    for (int x = 0; x < 12; ++x)
      rows += std::to_string(x) + ",0.5,0.5\n";
    folder.put("data/grains.csv", rows);
    const std::string scene = folder.put("mine.prm", "subsection sample\n  set file = data/grains.csv\nend\n");
    EXPECT_EQ(read_scene(scene, {}).sample.file, folder / "data/grains.csv");
    const std::string missing = (std::filesystem::current_path() / "data/grains.csv").string();
    expect_refused<SceneError>({missing}, [&] { read_scene(scene, {"sample/file=data/grains.csv"}); });
  }
} // namespace
