// diptych: the discrete panel, a grain sample loaded through a list of stages
// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "discrete/fclib.h"
#include "discrete/history.h"
#include "discrete/loading.h"
#include "discrete/penalty.h"
#include "discrete/sample_preparation.h"
#include "discrete/snapshot.h"
#include "discrete/window_forces.h"

namespace diptych::discrete
{
  struct MethodOptions
  {
    std::string method             = "nscd";
    int         history_interval   = 0;
    double      checkpoint_minutes = 10;
    bool        store_problems     = false;
  };

  template <class Visitor> void visit_parameters(MethodOptions &o, Visitor &&visitor)
  {
    visitor(
      "method", o.method, "-", {"nscd", "penalty"},
      "nscd: Non-Smooth Contact Dynamics; penalty: explicit springs, dashpots and Coulomb friction (Cundall & Strack 1979)");
    visitor("history_interval", o.history_interval, "steps", {0, 1000000000},
            "between two rows of discrete.csv; 0: every step, penalty: about a thousand rows a stage");
    visitor("checkpoint_minutes", o.checkpoint_minutes, "min", {0., 1e6},
            "between two checkpoints of a run, from which --resume goes on; 0: at every step");
    visitor("store_problems", o.store_problems, "-", {},
            "write the contact problem of every snapshot's step with its solution to problem_NNNN.h5 (FCLIB layout, for "
            "`diptych solve` and other solvers)");
  }

  // Everything of the scene's section `discrete`.
  struct Options
  {
    MethodOptions     method;
    StepOptions       time;
    ContactLawOptions law;
    SolverOptions     solver;
    SamplingOptions   sampling;
    LateralOptions    lateral;
    WallDriveOptions  drives;
    PenaltyOptions    penalty;
    int               threads = 1; // of the command line; results do not depend on it
  };

  template <class Visitor> void visit_parameters(Options &o, Visitor &&visitor)
  {
    visit_parameters(o.method, visitor);
    visit_parameters(o.time, visitor);
    visit_parameters(o.law, visitor);
    visit_parameters(o.solver, visitor);
    visit_parameters(o.sampling, visitor);
    visit_parameters(o.lateral, visitor);
    visit_parameters(o.drives, visitor);
    visit_parameters(o.penalty, visitor);
  }

  enum class Status
  {
    finished,
    stopped_by_user,
    not_converged
  };

  struct [[nodiscard]] Report
  {
    Status            status       = Status::finished;
    double            axial_strain = 0; // reached
    std::string       message;          // empty when finished
    PreparationReport preparation;
    double            step = 0;                           // of the last stage
    std::string       step_bound;                         // step = auto: which bound of the rule gave it
    long              steps = 0, sweeps = 0, updates = 0; // of the loading; one update = one contact in one sweep
    double            preparation_cpu_s = 0, loading_cpu_s = 0, solver_cpu_s = 0;
    double            initial_height = 0, platen_speed = 0;                           // speed: strain rate x height
    double            error_over_residual = std::numeric_limits<double>::quiet_NaN(); // of grain stress, measured once
    double            reference_residual  = error_over_residual;                      // of the solve it was measured against
    double            reference_error = error_over_residual, estimated_error = error_over_residual; // true and estimated, there
    int               snapshots_sampled = 0, snapshots_accurate = 0;
    int               halved_steps = 0; // because the sweeps stalled
  };

  // Everything that changes while a sample is loaded: what a checkpoint keeps. A run that goes on from it gives the same bits as
  // one that was never interrupted.
  struct Progress
  {
    State        state;
    Reference    reference;
    HistoryRow   row;    // of the last step
    WindowForces window; // since the last stage
    Report       report;
    int          stage      = 0; // the next one, counted from 0
    long         steps_left = 0; // to it
    double       step       = 0; // their length
    long         interval   = 1; // steps between two rows of the history
  };

  struct Callbacks
  {
    std::function<bool()>                            stop_requested = [] { return false; };
    std::function<void(const std::string &, double)> on_progress    = [](const std::string &, double) {};
    std::function<void(const Snapshot &)>            on_stage       = [](const Snapshot &) {};
    std::function<void(const HistoryRow &)>          on_step        = [](const HistoryRow &) {};
    // Asked before every step; a checkpoint is handed over where it says yes, and when the run is stopped.
    std::function<bool()>                 checkpoint_due = [] { return false; };
    std::function<void(const Progress &)> on_checkpoint  = [](const Progress &) {};
    // The contact problem of a stage's last step with its solution, where store_problems is set; stages count from 1.
    std::function<void(int stage, const ContactProblem &, const StoredGeometry &, const std::vector<Impulse> &)> on_problem = {};
  };

  // Throws std::invalid_argument on options that contradict each other or name wrong files.
  void validate(const SampleOptions &sample, const Loading &loading, const Options &options);

  PreparationSetting preparation_setting(const Loading &loading, const Options &options);

  // Prepares the sample and loads it through all stages, or goes on from `resume`. Snapshots are made of the prepared sample
  // (stage 0) and at every stage. Throws std::invalid_argument on options that contradict each other. A step that does not
  // converge is halved, up to three times; where that does not help the run stops, with what was reached kept.
  Report run(const SampleOptions &sample,
             const Loading       &loading,
             const Options       &options,
             const Callbacks     &callbacks,
             const Progress      *resume = nullptr);
} // namespace diptych::discrete
