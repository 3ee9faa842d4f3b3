// diptych: progress of long work with the time remaining
// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <chrono>
#include <string>

namespace diptych::coupling
{
  // On a terminal, rewrites one line (bar, per cent, time elapsed and remaining). In a log, writes one plain line per tenth of
  // a phase. Writes to standard error, so that standard output stays clean.
  class Progress
  {
  public:
    explicit Progress(bool quiet);
    ~Progress(); // a phase that is still open ends here without success
    Progress(const Progress &)            = delete;
    Progress &operator=(const Progress &) = delete;

    // A new phase name starts a new clock and completes the phase before. `fraction`: 0 .. 1, of the phase.
    void update(const std::string &phase, double fraction);
    void finish(bool is_complete = true); // ends the present phase; after a stop on request it is never complete

    // Completes an open phase, so that the next message begins on a new line.
    static void make_room();

  private:
    using Clock = std::chrono::steady_clock;

    double elapsed() const; // seconds

    bool              quiet, terminal;
    std::string       phase;
    Clock::time_point begin, shown;
    int               tenths = -1;
  };

  std::string duration_text(double seconds); // "1 h 02 min", "3 min 20 s", "12 s"
} // namespace diptych::coupling
