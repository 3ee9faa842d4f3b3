// diptych: CPU time of a scope
// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <ctime>

namespace diptych::continuum
{
  struct Stopwatch
  {
    double      &seconds;
    std::clock_t start = std::clock();
    ~Stopwatch() { seconds += double(std::clock() - start) / CLOCKS_PER_SEC; }
  };
} // namespace diptych::continuum
