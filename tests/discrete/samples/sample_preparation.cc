// diptych: the prepared sample is dense, at rest, under the given pressure and free of overlaps; its side walls
// SPDX-License-Identifier: LGPL-2.1-or-later
#include "discrete/contacts/internal_moment.h"
#include "discrete/bodies/outline.h"
#include "discrete/samples/soft_relaxation.h"
#include "discrete/samples/sample_preparation.h"
#include "tests/discrete/small_scenes.h"
#include "tests/common.h"

namespace
{
  using namespace diptych::tests;

  TEST(SamplePreparation, GivesADenseQuietSampleUnderPressure)
  {
    const SampleOptions  options = small_sample(800);
    const PreparedSample sample  = prepare_sample(options, {}, [](int, int) { return true; });
    EXPECT_TRUE(sample.report.quiet);
    // Frictionless packings of this size distribution jam near 0.845. Free sides reduce this a little in a small sample.
    EXPECT_GT(sample.report.solid_fraction, 0.83);
    EXPECT_LT(sample.report.solid_fraction, 0.86);
    const double mean = std::accumulate(sample.state.grains.radius.begin(), sample.state.grains.radius.end(), 0.) / 800;
    EXPECT_NEAR(mean, 0.5, 1e-12);

    // The lateral action gives s_xx = P (sum of moments / area) within the sampling of a few hundred grains.
    std::vector<ContactForce> forces;
    for (std::size_t k = 0; k < sample.last_step.contacts.size(); ++k)
      {
        const Contact &c = sample.last_step.contacts[k];
        forces.push_back({c.i, c.j, c.point, c.normal, sample.last_step.impulses[k].normal / sample.step * c.normal});
      }
    double moment = 0;
    for (const Eigen::Matrix2d &m : internal_moments(sample.state.grains.position, forces, spin_terms(sample.state.grains)))
      moment += m(0, 0);
    const double area = outline_area(make_outline(sample.state, 1.));
    EXPECT_NEAR(moment / area, 1, 0.1);
  }

  // For all sides, sizes and friction. Such a sample can take springs of any stiffness and steps of any length.
  TEST(SamplePreparation, LeavesNoOverlap)
  {
    SampleOptions by_mass         = small_sample(300);
    by_mass.radius_distribution   = RadiusKind::uniform_by_mass;
    by_mass.radius_min            = 0.2;
    by_mass.radius_max            = 1;
    SampleOptions rough           = small_sample(300);
    rough.preparation_friction    = 0.3;
    SampleOptions large_and_loose = small_sample(300);
    large_and_loose.mean_diameter = 20, large_and_loose.preparation_friction = 0.5, large_and_loose.box_solid_fraction = 0.78;
    const LateralCondition sides[] = {EndGrains{}, RigidSides{}, PeriodicSides{}};
    for (const SampleOptions &options : {small_sample(300), by_mass, rough, large_and_loose})
      for (const LateralCondition &side : sides)
        {
          PreparationSetting setting;
          setting.lateral             = side;
          const PreparedSample sample = prepare_sample(options, setting, [](int, int) { return true; });
          const double         d      = options.mean_diameter;
          EXPECT_TRUE(sample.report.quiet) << sample.report.unbalanced_force;
          EXPECT_GT(sample.report.settling_steps, 0);
          double overlap = 0;
          for (const Contact &c : find_contacts(sample.state, std::vector<double>(sample.state.grains.size(), 0.)))
            overlap = std::max(overlap, -c.gap / d);
          EXPECT_EQ(overlap, sample.report.largest_overlap) << "sides " << side.index();
          EXPECT_LE(overlap, 1e-4) << "sides " << side.index();
        }
  }

  TEST(SamplePreparation, ContradictoryOptionsAreRefusedByName)
  {
    SampleOptions options = small_sample();
    options.radius_max    = 0.8;
    expect_refused({"radius_max"}, [&] { validate(options); });
  }

  State soft_discs(const std::vector<Eigen::Vector2d> &centres)
  {
    State state;
    state.walls = {{{0, 0}, {0, 1}}, {{0, 5}, {0, -1}}, {{0, 0}, {1, 0}}, {{5, 0}, {-1, 0}}};
    for (const Eigen::Vector2d &x : centres)
      add_grain(state.grains, x, 0.5, 1.);
    return state;
  }

  // Three overlapping soft discs in a wide box must end without overlap.
  TEST(SoftRelaxation, RemovesOverlaps)
  {
    State                  state  = soft_discs({{2, 2}, {2.2, 2.1}, {0.1, 4.9}});
    const RelaxationReport report = relax_soft_discs(state, 1e-6, 10000);
    EXPECT_LT(report.largest_overlap, 1e-6);
    EXPECT_GT((state.grains.position[0] - state.grains.position[1]).norm(), 1 - 2e-6);
    EXPECT_GT(state.grains.position[2].x(), 0.5 - 2e-6);
  }

  // The callback comes before every iteration. At its third call two iterations are done.
  TEST(SoftRelaxation, EndsBetweenTwoIterationsWhenAsked)
  {
    State                  state  = soft_discs({{2, 2}, {2.2, 2.1}});
    int                    asked  = 0;
    const RelaxationReport report = relax_soft_discs(state, 1e-6, 10000, [&] { return ++asked < 3; });
    EXPECT_TRUE(report.stopped);
    EXPECT_EQ(report.iterations, 2);
    EXPECT_EQ(asked, 3);
  }

  // The preparation stops after the first call that returns false, and never counts as at rest. The calls are in the soft discs
  // (the 5th), in the sweeps of the first steps, and at several places of a preparation with `whole` calls.
  TEST(SamplePreparation, EndsWhenTheCallbackReturnsFalse)
  {
    int whole = 0;
    ASSERT_TRUE(prepare_sample(small_sample(100), {}, [&](int, int) { return ++whole > 0; }).report.quiet);
    for (const int last : {1, 5, whole / 2, whole - 1})
      {
        int                  asked  = 0;
        const PreparedSample sample = prepare_sample(small_sample(100), {}, [&](int, int) { return ++asked < last; });
        EXPECT_FALSE(sample.report.quiet) << last;
        EXPECT_LE(asked, last + 3) << "each outer loop may call once more";
      }
  }

  // 10 x 20 discs of diameter 1 between two platens.
  State lattice()
  {
    State state;
    for (int a = 0; a < 10; ++a)
      for (int b = 0; b < 20; ++b)
        add_grain(state.grains, {0.5 + a, 0.5 + b}, 0.5, 1.);
    state.walls = {{{0, 0}, {0, 1}}, {{0, 20}, {0, -1}}};
    return state;
  }

  // The lattice fills a rectangle. The outline has the area of the rectangle, except for the scallops of its edge.
  TEST(Outline, OfALatticeHasItsArea)
  {
    const Outline outline = make_outline(lattice(), 1.);
    // Mean depth of a scallop: r (1 - pi/4) = 0.107 on either side, so the width is 10 - 0.215.
    EXPECT_NEAR(outline_area(outline), 20 * (10 - 2 * 0.5 * (1 - M_PI / 4)), 0.02 * 200);
    EXPECT_EQ(outline.left.front().y(), 0);
    EXPECT_EQ(outline.right.back().y(), 20);
    for (const double cut : {-1., 3.3, 12., 20.})
      EXPECT_NEAR(outline_area(outline, -1e9, cut) + outline_area(outline, cut, 1e9), outline_area(outline), 1e-10);
    EXPECT_NEAR(outline_area(outline, 6, 7), outline_area(outline) / 20, 0.1) << "up to the scallops";
  }

  // Grains that press on a platen without overlap still touch it, whatever the last bits of their positions.
  TEST(Outline, DoesNotDependOnWhatIsBetweenAGrainAndItsPlaten)
  {
    const State   state   = lattice();
    const Outline outline = make_outline(state, 1.);
    for (const double gap : {1e-5, 1e-3})
      {
        State apart = state;
        apart.grains.position[0].y() += gap; // at the lower left corner
        apart.grains.position[199].y() -= gap;
        const Outline other = make_outline(apart, 1.);
        for (const auto side : {&Outline::left, &Outline::right})
          for (std::size_t k = 0; k < (outline.*side).size(); ++k)
            EXPECT_LT(((outline.*side)[k] - (other.*side)[k]).norm(), 10 * gap) << gap << ", point " << k;
      }
  }

  using namespace diptych::discrete;

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

  // A cell begins from rest, so given velocities would be lost.
  TEST(Cells, MovingGrainsAreRefused)
  {
    SampleOptions options;
    options.width = options.height = 10;
    PreparationSetting setting;
    setting.lateral    = CellSides{};
    Grains     grains  = three_discs(false);
    const auto prepare = [&] {
      return prepare_sample(
        options, setting, [](int, int) { return true; }, &grains);
    };
    EXPECT_NO_THROW(prepare());
    grains.spin[1] = 1;
    EXPECT_THROW(prepare(), std::invalid_argument);
    grains.spin[1]     = 0;
    grains.velocity[2] = {0, 1};
    EXPECT_THROW(prepare(), std::invalid_argument);
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
