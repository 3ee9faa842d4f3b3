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

    // "40 %, 12 s elapsed, 18 s remaining"; without the last part at the first per cent and at the end.
    std::string state_text(const int percent, const double fraction, const double elapsed)
    {
      std::string text = std::to_string(percent) + " %, " + duration_text(elapsed) + " elapsed";
      if (fraction > 0.01 && percent < 100)
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

  Progress::Progress(const bool quiet)
      : quiet(quiet),
        terminal(isatty(STDERR_FILENO) != 0)
  {}

  Progress::~Progress()
  {
    finish(false);
  }

  double Progress::elapsed() const
  {
    return std::chrono::duration<double>(Clock::now() - begin).count();
  }

  void Progress::update(const std::string &name, const double fraction)
  {
    if (quiet)
      return;
    const Clock::time_point now = Clock::now();
    if (name != phase)
      {
        finish();
        phase         = name;
        begin         = now;
        shown         = now - std::chrono::hours(1);
        tenths        = -1;
        open_progress = this;
      }
    const int         percent = std::clamp(int(100 * fraction), 0, 100);
    const std::string state   = state_text(percent, fraction, elapsed());
    if (terminal && now - shown > std::chrono::milliseconds(200))
      {
        shown                 = now;
        const std::string bar = std::string(percent / 4, '#') + std::string(25 - percent / 4, '.');
        std::fprintf(stderr, "\r\033[K%s [%s] %s", phase.c_str(), bar.c_str(), state.c_str());
      }
    else if (!terminal && percent / 10 > tenths)
      {
        tenths = percent / 10;
        std::fprintf(stderr, "%s: %s\n", phase.c_str(), state.c_str());
      }
  }

  void Progress::finish(const bool is_complete)
  {
    if (open_progress == this)
      open_progress = nullptr;
    if (phase.empty())
      return;
    const bool is_done = is_complete && !stop_requested();
    if (terminal && is_done)
      std::fprintf(stderr, "\r\033[K%s: done in %s\n", phase.c_str(), duration_text(elapsed()).c_str());
    else if (terminal)
      std::fprintf(stderr, "\n"); // the last state stays visible
    else if (is_done && tenths < 10)
      std::fprintf(stderr, "%s: %s\n", phase.c_str(), state_text(100, 1, elapsed()).c_str());
    phase.clear();
  }

  void Progress::make_room()
  {
    if (open_progress != nullptr)
      open_progress->finish();
  }
} // namespace diptych::coupling
