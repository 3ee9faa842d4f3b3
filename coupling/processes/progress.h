// diptych: progress of long work with the remaining time
// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <chrono>
#include <string>

namespace diptych::coupling
{
  // On a terminal it rewrites one line (bar, per cent, remaining time); in a log it prints one line per tenth of a phase. It
  // writes to standard error and leaves standard output to the results.
  class Progress
  {
  public:
    explicit Progress(bool quiet);
    ~Progress();

    // A new phase name restarts the clock. fraction: done part of the phase, 0 .. 1.
    void update(const std::string &phase, double fraction);
    void finish(); // ends the line of the present phase

  private:
    using Clock = std::chrono::steady_clock;

    bool              quiet, terminal;
    std::string       phase;
    Clock::time_point begin, shown;
    int               tenths = -1;
  };

  std::string duration_text(double seconds); // "1 h 02 min", "3 min 20 s", "12 s"
} // namespace diptych::coupling
