// diptych: positions of the side walls of a sample with given grains
// SPDX-License-Identifier: LGPL-2.1-or-later
#include "discrete/samples/sample_preparation.h"
#include "tests/files.h"

namespace
{
  using namespace diptych::discrete;
  using namespace diptych::tests;

  // Three discs of radius 1 side by side between the platens y = 0 and y = 2. The last one may be fixed.
  Grains three_discs(const bool last_fixed)
  {
    Grains grains;
    for (int k = 0; k < 3; ++k)
      add_grain(grains, {2. * k, 1.}, 1., 1.);
    grains.fixed[2] = last_fixed;
    return grains;
  }

  PreparedSample placed(const SampleOptions &options, const Grains &grains)
  {
    PreparationSetting setting;
    setting.lateral = RigidSides{};
    return prepare_sample(
      options, setting, [](int, int) { return true; }, &grains);
  }

  double left(const PreparedSample &sample)
  {
    return sample.state.walls[2].point.x();
  }
  double right(const PreparedSample &sample)
  {
    return sample.state.walls[3].point.x();
  }

  // Edges at -1 and 5, whether or not the outermost grain moves.
  TEST(SideWalls, AutoIsTheOutermostEdgeOfAnyGrain)
  {
    for (const bool fixed : {false, true})
      {
        const PreparedSample sample = placed({}, three_discs(fixed));
        EXPECT_EQ(left(sample), -1) << fixed;
        EXPECT_EQ(right(sample), 5) << fixed;
      }
  }

  TEST(SideWalls, FollowTheirKeys)
  {
    SampleOptions options;
    options.left_wall = -1.5, options.right_wall = 7;
    const PreparedSample sample = placed(options, three_discs(false));
    EXPECT_EQ(left(sample), -1.5);
    EXPECT_EQ(right(sample), 7);
    EXPECT_EQ(sample.state.walls[0].point.y(), 0);
    EXPECT_EQ(sample.state.walls[1].point.y(), 2);
  }

  // As between two grains, up to allowed_overlap of the radius is accepted.
  TEST(SideWalls, AnOverlapIsJudgedLikeOneWithAGrain)
  {
    SampleOptions options;
    options.allowed_overlap = 0.1;
    options.left_wall       = -1 + 0.09;
    EXPECT_NO_THROW((void)placed(options, three_discs(false)));
    const auto refused = [&](const double left_wall, const double right_wall, const std::vector<std::string> &words) {
      options.left_wall = left_wall, options.right_wall = right_wall;
      expect_refused(words, [&] { (void)placed(options, three_discs(false)); });
    };
    refused(-1 + 0.11, 5, {"left wall", "-0.89"});
    refused(-1, 4.89, {"right wall"});
    refused(2, 2, {"left_wall"});
  }
} // namespace
