// diptych: several processes sweep one problem and get the bits of one
// SPDX-License-Identifier: LGPL-2.1-or-later
#include "discrete/files/table_file.h"
#include "tests/discrete/crew.h"
#include "tests/discrete/small_scenes.h"

namespace
{
  using namespace diptych::tests;

  // Rows and positions of a run on `n` processes; all of them must agree.
  struct Bits
  {
    std::vector<std::string>     rows;
    std::vector<Eigen::Vector2d> position;

    bool operator==(const Bits &other) const { return rows == other.rows && position == other.position; }
  };

  Bits bits_of(const Course &course)
  {
    Bits bits;
    for (const HistoryRow &row : course.rows)
      bits.rows.push_back(csv_line(row));
    bits.position = course.snapshots.back().position;
    return bits;
  }

  void expect_the_same_bits(const SampleOptions &sample, const Loading &loading, Options options)
  {
    const Bits alone = bits_of(loaded(sample, loading, options));
    ASSERT_GT(alone.rows.size(), 1u);
    for (const auto &[processes, threads] : {std::pair{2, 2}, {3, 1}})
      {
        Crew              crew(processes);
        std::vector<Bits> bits(static_cast<std::size_t>(processes));
        options.threads = threads;
        crew.run([&](Processes &own) {
          Hooks hooks;
          hooks.processes  = &own;
          bits[own.rank()] = bits_of(loaded(sample, loading, options, hooks));
        });
        EXPECT_GT(crew.messages(), 0);
        for (const Bits &of_one : bits)
          EXPECT_TRUE(of_one == alone) << processes << " processes of " << threads << " threads";
      }
  }

  SampleOptions three_blocks()
  {
    SampleOptions sample     = small_sample(2000);
    sample.preparation_steps = 10;
    return sample;
  }

  Loading few_steps(const LoadingMode mode = LoadingMode::descent)
  {
    Loading loading;
    loading.mode            = mode;
    loading.inertial_number = 1e-2;
    loading.stages          = {0.002, 0.004};
    return loading;
  }

  TEST(Processes, WithFreeSidesAndRolling)
  {
    Options options              = quick_options();
    options.law.rolling_friction = 0.1;
    expect_the_same_bits(three_blocks(), few_steps(), options);
  }

  // A wall or a width under a force, whose rows are taken one by one.
  TEST(Processes, WithSidesUnderPressure)
  {
    for (const Lateral lateral : {Lateral::rigid_walls, Lateral::periodic})
      {
        Options options         = quick_options();
        options.lateral.lateral = lateral;
        expect_the_same_bits(three_blocks(), few_steps(), options);
      }
  }

  TEST(Processes, WithAFreePlaten)
  {
    Options options         = quick_options();
    options.lateral.lateral = Lateral::periodic;
    expect_the_same_bits(three_blocks(), few_steps(LoadingMode::plane_shear), options);
  }

  TEST(Processes, WithACell)
  {
    Options options         = quick_options();
    options.lateral.lateral = Lateral::cell;
    Loading loading         = few_steps(LoadingMode::path);
    loading.path.form << 0, 0, 1, 0, 1, 0, 1, 0, 0; // 2 exy, syy, exx
    loading.path.is_stress = {false, true, false};
    loading.path.values    = {{0, 1, 0}, {1e-3, 1, 0}};
    loading.path.progress  = {0, 1};
    loading.stages         = {0.5, 1};
    expect_the_same_bits(three_blocks(), loading, options);
  }

  TEST(Processes, WithImplicitAndExplicitSprings)
  {
    for (const Method method : {Method::compliant, Method::penalty})
      {
        Options options         = quick_options();
        options.method.method   = method;
        options.penalty.preload = 0.5;
        expect_the_same_bits(three_blocks(), few_steps(), options);
      }
  }
} // namespace
