// diptych: many samples in one process leave no trace in memory or results
// SPDX-License-Identifier: LGPL-2.1-or-later
#include <malloc.h>
#include <sys/wait.h>
#include <unistd.h>

#include "tests/discrete/small_scenes.h"

namespace
{
  using namespace diptych::tests;

  // Panel k has one of five variants: friction, seed, step, sides and method.
  Course turn(const int k)
  {
    SampleOptions sample  = small_sample(40, 1 + k % 2);
    Loading       loading = short_loading();
    Options       options = quick_options();
    loading.stages        = {0.001};
    if (k % 5 == 1)
      options.law.friction = 0.2;
    if (k % 5 == 2)
      options.stepping.step = 0.05;
    if (k % 5 == 3)
      options.lateral.lateral = Lateral::periodic;
    if (k % 5 == 4)
      options.method.method = Method::penalty;
    return loaded(sample, loading, options);
  }

  std::vector<double> numbers(const Course &course)
  {
    std::vector<double> values;
    for (const Eigen::Vector2d &x : course.snapshots.back().position)
      values.insert(values.end(), {x.x(), x.y()});
    for (const Eigen::Matrix2d &m : course.snapshots.back().internal_moment)
      values.insert(values.end(), {m(0, 0), m(0, 1), m(1, 0), m(1, 1)});
    for (const HistoryRow &row : course.rows)
      values.push_back(row.stress_ratio);
    return values;
  }

  // The numbers of this run in a process that has run nothing else. They come through a file.
  std::vector<double> numbers_of_a_fresh_process(const int k)
  {
    const Folder folder;
    const pid_t  child = fork();
    if (child == 0)
      {
        const std::vector<double> values = numbers(turn(k));
        write_text(folder / "numbers", {reinterpret_cast<const char *>(values.data()), values.size() * sizeof(double)});
        _exit(0);
      }
    int status = 0;
    waitpid(child, &status, 0);
    EXPECT_EQ(status, 0);
    const std::string   bytes = read_text(folder / "numbers");
    std::vector<double> values(bytes.size() / sizeof(double));
    std::memcpy(values.data(), bytes.data(), bytes.size());
    return values;
  }

  std::size_t bytes_in_use()
  {
    const struct mallinfo2 now = mallinfo2();
    return now.uordblks + now.hblkhd;
  }

  // Fifty samples, ten of each variant. After the first ten, which fill static data of libraries, memory in use must not grow.
  TEST(ManyPanels, KeepNoMemoryAndGiveTheBitsOfAFreshProcess)
  {
    std::vector<std::vector<double>> fresh;
    for (int k = 0; k < 10; ++k)
      fresh.push_back(numbers_of_a_fresh_process(k));
    std::size_t before = 0;
    for (int k = 0; k < 50; ++k)
      {
        if (k == 10)
          before = bytes_in_use();
        const std::vector<double> here = numbers(turn(k));
        ASSERT_EQ(here, fresh[std::size_t(k % 10)]) << "panel " << k;
      }
    // 40 panels of 40 grains: if each kept only its positions, this would add 40 x 640 bytes.
    EXPECT_LT(bytes_in_use(), before + 10000);
  }
} // namespace
