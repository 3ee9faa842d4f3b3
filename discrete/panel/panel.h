// diptych: the discrete panel, a grain sample loaded through a list of stages
// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <functional>
#include <limits>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "discrete/panel/history.h"
#include "discrete/panel/options.h"
#include "discrete/panel/report.h"
#include "discrete/panel/window_forces.h"
#include "discrete/problem_files/fclib.h"
#include "discrete/snapshot.h"

namespace diptych::discrete
{
  // Everything that changes during a loading. A panel that continues from it gives the same bits as an uninterrupted one. The
  // drives of walls and cell are not included, because they follow from the loading.
  struct Checkpoint
  {
    State        state;
    Reference    reference;
    HistoryRow   row;    // of the last step
    WindowForces window; // since the last stage
    Report       report;
    int          stage      = 0; // number of finished stages
    long         steps_left = 0; // steps to the next stage; 0: not planned yet
    double       step       = 0; // length of these steps
    long         interval   = 1; // steps between two rows of the history
  };

  struct Hooks
  {
    std::function<bool()> stop_requested; // called before every step, also during the preparation
    std::function<void()> before_step;    // called before every step of the loading; a checkpoint may be taken here
    std::function<void(const std::string &phase, double fraction)> on_progress;
    std::function<void(const HistoryRow &)>                        on_row;
    Processes *processes = nullptr; // that sweep together; all must make the same calls, and stop_requested must agree

    // Called with the contact problem of a stage's last step and its solution if store_problems is set. Stages count from 1.
    std::function<void(int stage, const ContactProblem &, const StoredGeometry &, const std::vector<Impulse> &)> on_problem;
  };

  // One sample, from its preparation to the end of its loading. A process may hold any number of panels.
  class Panel
  {
  public:
    // The sample follows from the keys of `sample`, including sample.file. If `grains` is given, they take the place of a file,
    // and only the file keys of `sample` count. Throws std::invalid_argument if options contradict each other.
    Panel(const SampleOptions         &sample,
          const Loading               &loading,
          const Options               &options,
          Hooks                        hooks  = {},
          const std::optional<Grains> &grains = {});
    ~Panel();
    Panel(Panel &&) noexcept;
    Panel &operator=(Panel &&) noexcept;

    // Call one of these once: prepare() makes the sample, resume() continues a loading from a checkpoint.
    [[nodiscard]] Status prepare();
    void                 resume(const Checkpoint &checkpoint);

    // Loads up to stage 1, 2, ... number of stages. A step that does not converge is halved, up to three times. If that fails,
    // the panel keeps its state, and the report gives the reason.
    [[nodiscard]] Status advance_to(int stage);

    // Snapshot of the prepared sample, or of the last accepted step with the means since the last stage.
    Snapshot snapshot() const;
    bool     has_snapshot() const; // false for a resumed panel before its first step

    Checkpoint       checkpoint() const;
    const Report    &report() const;
    int              stage() const; // number of finished stages
    const Reference &reference() const;

  private:
    class Course;
    std::unique_ptr<Course> course;
  };
} // namespace diptych::discrete
