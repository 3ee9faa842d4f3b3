// diptych: a large sample compacted on springs rests under the stress of its sides
// SPDX-License-Identifier: LGPL-2.1-or-later
#include "discrete/contacts/internal_moment.h"
#include "discrete/bodies/outline.h"
#include "discrete/samples/placed_grains.h"
#include "discrete/samples/soft_relaxation.h"
#include "discrete/samples/spring_compaction.h"
#include "discrete/samples/uniform_strain.h"
#include "tests/discrete/small_scenes.h"
#include "tests/common.h"

namespace
{
  using namespace diptych::tests;

  // Discs of two sizes without overlaps, at a solid fraction of 0.78.
  State loose_discs(const PreparationSetting &preparation)
  {
    constexpr int    columns = 40, rows = 60;
    constexpr double spacing = 0.96;
    State            state;
    for (int k = 0; k < columns * rows; ++k)
      {
        const int row = k / columns, column = k % columns;
        add_grain(state.grains, {spacing * (column + 0.5), spacing * (row + 0.5)}, k % 3 == row % 2 ? 0.53 : 0.46, 1.);
      }
    enclose(state, preparation.lateral, {spacing * columns, spacing * rows});
    relax_soft_discs(state, 1e-3, 4000);
    set_sides(state, preparation);
    return state;
  }

  StepSetting compaction(const PreparationSetting &preparation, const double friction)
  {
    StepSetting setting;
    setting.law                = same_friction(friction);
    setting.lateral            = preparation.lateral;
    setting.pressure           = preparation.pressure;
    setting.accept_unconverged = true;
    return setting;
  }

  // Sums of internal moments (Moreau 1997, eq. 6) over the area.
  Eigen::Matrix2d stress_of_grains(const PreparedSample &sample)
  {
    std::vector<ContactForce> forces;
    for (std::size_t k = 0; k < sample.last_step.contacts.size(); ++k)
      {
        const Contact        &c = sample.last_step.contacts[k];
        const Impulse        &r = sample.last_step.impulses[k];
        const Eigen::Vector2d t(-c.normal.y(), c.normal.x());
        const Eigen::Vector2d force = (r.normal * c.normal + r.tangential * t) / sample.step;
        forces.push_back({c.i, c.j, c.point, c.normal, force, c.image.shift.x(), 0, c.image.shift.y()});
      }
    Eigen::Matrix2d sum = Eigen::Matrix2d::Zero();
    for (const Eigen::Matrix2d &m : internal_moments(sample.state.grains.position, forces, spin_terms(sample.state.grains)))
      sum += m;
    return sum / outline_area(make_outline(sample.state, 1.));
  }

  PreparedSample compacted(const LateralCondition &lateral, const double friction)
  {
    PreparationSetting preparation;
    preparation.lateral  = lateral;
    preparation.pressure = 2;
    return compact_with_springs(loose_discs(preparation), {}, compaction(preparation, friction), preparation.team,
                                [](int, int) { return true; });
  }

  TEST(SpringCompaction, EndsAtRestUnderTheStressOfItsSides)
  {
    struct Case
    {
      LateralCondition lateral;
      double           friction;
      bool             in_x, in_y; // the sides press along these axes
    };
    for (const Case &c :
         {Case{EndGrains{}, 0, true, false}, Case{RigidSides{}, 0.3, true, false}, Case{PeriodicSides{}, 0, false, true},
          Case{PeriodicSides{true}, 0.3, true, false}, Case{CellSides{}, 0, true, true}})
      {
        const PreparedSample sample = compacted(c.lateral, c.friction);
        const std::string    name   = "sides " + std::to_string(c.lateral.index()) + ", friction " + std::to_string(c.friction);
        EXPECT_TRUE(sample.report.quiet) << name << ", evenness " << sample.report.evenness;
        EXPECT_LE(sample.report.unbalanced_force, 0.15 * SampleOptions{}.quiet_unbalanced_force) << name;
        EXPECT_LE(sample.report.largest_overlap, 1e-4) << name;
        EXPECT_EQ(kinetic_energy(sample.state), 0) << name;
        const Eigen::Matrix2d stress = stress_of_grains(sample);
        if (c.in_x)
          {
            EXPECT_NEAR(stress(0, 0), 2, c.friction > 0 ? 0.5 : 0.15) << name; // platens carry a part
          }
        if (c.in_y)
          {
            EXPECT_NEAR(stress(1, 1), 2, 0.1) << name;
          }
      }
  }

  // Also with friction, whose forces are not normal.
  TEST(UniformStrain, MeanStressIsThatOfTheInternalMoments)
  {
    PreparationSetting preparation;
    SampleOptions      options   = small_sample(300);
    options.preparation_friction = 0.5;
    const PreparedSample sample  = prepare_sample(options, preparation, [](int, int) { return true; });
    StepSetting          setting = compaction(preparation, 0.5);
    setting.step                 = sample.step;
    const SideStress found       = side_stress(sample.state, sample.last_step, setting);
    EXPECT_LT((found.mean - stress_of_grains(sample).diagonal()).norm(), 1e-3);
    EXPECT_NEAR(found.wanted.x(), found.mean.x(), 0.01);
    EXPECT_EQ(found.wanted.y(), 0) << "no platen is free";
  }
} // namespace
