// diptych: progress of long work with the time remaining
// SPDX-License-Identifier: LGPL-2.1-or-later
#include "coupling/processes/progress.h"

#include <algorithm>
#include <cmath>
#include <cstdio>

#include <unistd.h>

#include "coupling/processes/stop_signal.h"

namespace diptych::coupling
{
  namespace
  {
    Progress *open_progress = nullptr; // the one with a phase under way

    // "12 s elapsed, 18 s remaining"; without the last part at the first per cent and at the end.
    std::string times_text(const double fraction, const double elapsed)
    {
      std::string text = duration_text(elapsed) + " elapsed";
      if (fraction > 0.01 && fraction < 1)
        text += ", " + duration_text(elapsed * (1 - fraction) / fraction) + " remaining";
      return text;
    }
  } // namespace

  std::string duration_text(const double seconds)
  {
    const long s = std::lround(std::max(0., seconds));
    char       text[48];
    if (s >= 3600)
      std::snprintf(text, sizeof text, "%ld h %02ld min", s / 3600, s / 60 % 60);
    else if (s >= 60)
      std::snprintf(text, sizeof text, "%ld min %02ld s", s / 60, s % 60);
    else
      std::snprintf(text, sizeof text, "%ld s", s);
    return text;
  }

  Progress::Progress(const bool quiet, const Clock::duration log_interval)
      : quiet(quiet),
        terminal(isatty(STDERR_FILENO) != 0),
        interval(terminal ? Clock::duration(std::chrono::milliseconds(200)) : log_interval)
  {}

  Progress::~Progress()
  {
    finish(false);
  }

  double Progress::elapsed() const
  {
    return std::chrono::duration<double>(Clock::now() - begin).count();
  }

  void Progress::update(const std::string &name, const double fraction, const std::string &state)
  {
    if (quiet)
      return;
    const Clock::time_point now = Clock::now();
    if (name != phase)
      {
        finish();
        phase         = name;
        begin         = now;
        shown         = terminal ? now - std::chrono::hours(1) : now;
        open_progress = this;
      }
    reached = state;
    if (now - shown < interval)
      return;
    shown                     = now;
    const int         percent = std::clamp(int(100 * fraction), 0, 100);
    const std::string share   = std::to_string(percent) + " %",
                      bar     = std::string(percent / 4, '#') + std::string(25 - percent / 4, '.');
    const std::string times   = times_text(fraction, elapsed());
    if (terminal)
      std::fprintf(stderr, "\r\033[K%s [%s] %s, %s", phase.c_str(), bar.c_str(), share.c_str(), times.c_str());
    else
      std::fprintf(stderr, "%s: %s, %s\n", phase.c_str(), (state.empty() ? share : state).c_str(), times.c_str());
  }

  void Progress::finish(const bool is_complete)
  {
    if (open_progress == this)
      open_progress = nullptr;
    if (phase.empty())
      return;
    const std::string state = reached.empty() ? "" : reached + ", ";
    if (is_complete && !stop_requested())
      std::fprintf(stderr, "%s%s: %sdone in %s\n", terminal ? "\r\033[K" : "", phase.c_str(), state.c_str(),
                   duration_text(elapsed()).c_str());
    else if (terminal)
      std::fprintf(stderr, "\n"); // the last state stays visible
    phase.clear();
  }

  void Progress::make_room()
  {
    if (open_progress != nullptr)
      open_progress->finish();
  }
} // namespace diptych::coupling
