// diptych: clocks and medians of the benchmark
// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <algorithm>
#include <chrono>
#include <ctime>
#include <vector>

namespace diptych::benchmarks
{
  // CPU time of all threads of this process, so that other programs on the machine do not count.
  inline double cpu_seconds()
  {
    std::timespec now;
    clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &now);
    return double(now.tv_sec) + 1e-9 * double(now.tv_nsec);
  }

  inline double wall_seconds()
  {
    return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count();
  }

  struct Spread
  {
    double least, median, most;
  };

  inline Spread spread(std::vector<double> values)
  {
    std::sort(values.begin(), values.end());
    const std::size_t n = values.size();
    return {values.front(), 0.5 * (values[(n - 1) / 2] + values[n / 2]), values.back()};
  }

  // Seconds that each of `repeats` calls takes by the given clock.
  template <class Clock, class Work> Spread timed(const int repeats, Clock &&clock, Work &&work)
  {
    std::vector<double> seconds;
    for (int k = 0; k < repeats; ++k)
      {
        const double begin = clock();
        work();
        seconds.push_back(clock() - begin);
      }
    return spread(std::move(seconds));
  }
} // namespace diptych::benchmarks
