// diptych: progress of long work with the time remaining
// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <chrono>
#include <cstdio>
#include <string>
#include <vector>

namespace diptych::coupling
{
  // On a terminal, rewrites one line (bar, per cent, time elapsed and remaining). In a log, writes a plain line every ten
  // seconds: strain and t/s instead of per cent, if the phase has them. Writes to standard error, so that standard output stays
  // clean.
  class Progress
  {
  public:
    using Clock = std::chrono::steady_clock;

    explicit Progress(bool quiet, Clock::duration log_interval = std::chrono::seconds(10));
    ~Progress(); // a phase that is still open ends here without success
    Progress(const Progress &)            = delete;
    Progress &operator=(const Progress &) = delete;

    // A new phase name starts a new clock and completes the phase before. `fraction`: 0 .. 1, of the phase. `state`: what it has
    // reached, such as reached_text().
    void update(const std::string &phase, double fraction, const std::string &state = "");
    void finish(bool is_complete = true); // ends the present phase; after a stop on request it is never complete

    // Completes an open phase, so that the next message begins on a new line.
    static void make_room();

  private:
    double elapsed() const; // seconds

    bool              quiet, terminal;
    Clock::duration   interval;
    std::string       phase, reached;
    Clock::time_point begin, shown;
  };

  // "1.25 % axial strain, t/s 0.351" of the last row of a history; empty before the first.
  template <class Row> std::string reached_text(const std::vector<Row> &rows)
  {
    if (rows.empty())
      return "";
    char stress_ratio[32];
    std::snprintf(stress_ratio, sizeof stress_ratio, ", t/s %.3f", rows.back().stress_ratio);
    return text_of(rows.back().loading_variable, rows.back().progress) + stress_ratio;
  }

  std::string duration_text(double seconds); // "1 h 02 min", "3 min 20 s", "12 s"
} // namespace diptych::coupling
