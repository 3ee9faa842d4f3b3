// diptych: progress of long work with the remaining time
// SPDX-License-Identifier: LGPL-2.1-or-later
#include "coupling/processes/progress.h"

#include <algorithm>
#include <cmath>
#include <cstdio>

#include <unistd.h>

namespace diptych::coupling
{
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
    finish();
  }

  void Progress::update(const std::string &name, const double fraction)
  {
    if (quiet)
      return;
    const Clock::time_point now = Clock::now();
    if (name != phase)
      {
        finish();
        phase = name, begin = now, shown = now - std::chrono::hours(1), tenths = -1;
      }
    const double elapsed = std::chrono::duration<double>(now - begin).count();
    const double left    = fraction > 0 ? elapsed * (1 - fraction) / fraction : 0;
    const int    percent = std::clamp(int(100 * fraction), 0, 100);
    if (terminal && now - shown > std::chrono::milliseconds(200))
      {
        shown                 = now;
        const std::string bar = std::string(percent / 4, '#') + std::string(25 - percent / 4, '.');
        std::fprintf(stderr, "\r\033[K%s [%s] %d %%, %s remaining", phase.c_str(), bar.c_str(), percent,
                     fraction > 0.01 ? duration_text(left).c_str() : "?");
      }
    else if (!terminal && percent / 10 > tenths)
      {
        tenths = percent / 10;
        std::fprintf(stderr, "%s: %d %%, %s elapsed, %s remaining\n", phase.c_str(), percent, duration_text(elapsed).c_str(),
                     fraction > 0.01 ? duration_text(left).c_str() : "?");
      }
  }

  void Progress::finish()
  {
    if (!quiet && terminal && !phase.empty())
      std::fprintf(stderr, "\r\033[K%s: done in %s\n", phase.c_str(),
                   duration_text(std::chrono::duration<double>(Clock::now() - begin).count()).c_str());
    phase.clear();
  }
} // namespace diptych::coupling
