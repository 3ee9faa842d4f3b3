// diptych: seconds of the CPU and on the clock
// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <chrono>
#include <ctime>

namespace diptych::discrete
{
  // Since its construction.
  class Stopwatch
  {
  public:
    double cpu_s() const { return double(std::clock() - cpu_) / CLOCKS_PER_SEC; } // of all threads
    double wall_s() const { return std::chrono::duration<double>(std::chrono::steady_clock::now() - wall_).count(); }

  private:
    std::clock_t                          cpu_  = std::clock();
    std::chrono::steady_clock::time_point wall_ = std::chrono::steady_clock::now();
  };
} // namespace diptych::discrete
