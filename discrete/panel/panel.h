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
  // Everything that changes while a sample is loaded. A panel that goes on from it gives the same bits as one that was never
  // interrupted. Drives of walls and cell are no part of it: they follow from the loading.
  struct Checkpoint
  {
    State        state;
    Reference    reference;
    HistoryRow   row;    // of the last step
    WindowForces window; // since the last stage
    Report       report;
    int          stage      = 0; // how many are reached
    long         steps_left = 0; // to the next one; 0: not begun
    double       step       = 0; // their length
    long         interval   = 1; // steps between two rows of the history
  };

  // All optional.
  struct Hooks
  {
    std::function<bool()>                                          stop_requested; // asked before every step, preparation too
    std::function<void()>                                          before_step; // of the loading: where a checkpoint may be taken
    std::function<void(const std::string &phase, double fraction)> on_progress;
    std::function<void(const HistoryRow &)>                        on_row;
    // The contact problem of a stage's last step with its solution, where store_problems is set; stages count from 1.
    std::function<void(int stage, const ContactProblem &, const StoredGeometry &, const std::vector<Impulse> &)> on_problem;
  };

  // One sample, from its preparation to the end of its loading. Any number of panels may live in one process.
  class Panel
  {
  public:
    // A sample by its recipe (sample.file included), or `grains` put between platens and sides as the grains of a file are; of
    // `sample` those keys count then that speak of files. Throws std::invalid_argument on options that contradict each other.
    Panel(const SampleOptions         &sample,
          const Loading               &loading,
          const Options               &options,
          Hooks                        hooks  = {},
          const std::optional<Grains> &grains = {});
    ~Panel();
    Panel(Panel &&) noexcept;
    Panel &operator=(Panel &&) noexcept;

    // Once: makes the sample ready, or takes up a loading where it was left.
    [[nodiscard]] Status prepare();
    void                 resume(const Checkpoint &checkpoint);

    // Loads up to stage 1, 2, ... number of stages. A step that does not converge is halved, up to three times; where that does
    // not help the panel stays where it is and the report says why.
    [[nodiscard]] Status advance_to(int stage);

    // Of the prepared sample, or of the last accepted step with the means since the last stage.
    Snapshot snapshot() const;
    bool     has_snapshot() const; // not before the first step of a panel that was taken up

    Checkpoint       checkpoint() const;
    const Report    &report() const;
    int              stage() const; // how many are reached
    const Reference &reference() const;

  private:
    class Course;
    std::unique_ptr<Course> course;
  };
} // namespace diptych::discrete
