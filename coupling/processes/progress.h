// diptych: progress of long work with the time left
// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <chrono>
#include <string>

namespace diptych::coupling
{
  // On a terminal one line that is rewritten (bar, per cent, time left); in a log one plain line per tenth of a phase.
  // Writes to standard error, so that standard output stays clean.
  class Progress
  {
  public:
    explicit Progress(bool quiet);
    ~Progress();

    // A new phase name starts a new clock. fraction: 0 .. 1, of the phase.
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
