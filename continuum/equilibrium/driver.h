// diptych: adaptive load steps
// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <string>
#include <vector>

#include "continuum/equilibrium/boundary_value_problem.h"
#include "continuum/equilibrium/linear_solver.h"
#include "continuum/equilibrium/newton.h"
#include "continuum/equilibrium/refinement.h"
#include "continuum/options.h"
#include "continuum/stopping.h"

namespace diptych::continuum
{
  struct StepCounts
  {
    int steps = 0, cut_backs = 0, newton_iterations = 0, refinements = 0;
  };

  struct DriverState
  {
    StepCounts count;
    double     step      = 0;     // intended length of the next step [progress]
    double     last_step = 0;     // last accepted length; 0: none yet
    bool       is_smooth = false; // the motion of the last step was closer to the extrapolated one than to that before
    LastMotion last;
    Divisions  divisions; // history of the mesh
  };

  // Drives the problem along its loading path. A step that does not converge is halved; after an easy step the next one is
  // longer. A step stopped between two Newton iterations leaves problem, driver and solver unchanged, bit for bit.
  class LoadDriver
  {
  public:
    LoadDriver(BoundaryValueProblem &problem, const Options &options, StopRequest stop_requested = {});

    // Finds equilibrium at rest. This is immediate for a rectangle under its own pressure. It takes some steps if the outline
    // is wavy, the stress was mapped or the mesh was refined. Returns an empty text, or the reason for failure.
    [[nodiscard]] std::string equilibrate();

    // Makes one accepted step towards `progress`; the last step of a stage ends there exactly. Returns an empty text, or the
    // reason why the run cannot continue.
    [[nodiscard]] std::string step_towards(double progress);

    // Whether the last of these two calls returned early because of a request to stop.
    bool was_stopped() const { return stopped; }

    void restart(DriverState new_state);

    const DriverState  &state() const { return now; }
    const LinearSolver &linear_solver() const { return solver; }
    LinearSolver       &linear_solver() { return solver; }

  private:
    DistributedVector         predict(double to);
    void                      follow_structure();
    NewtonReport              attempt(DistributedVector &increment, const StopRequest &stop);
    [[nodiscard]] std::string find_equilibrium(const StopRequest &stop);
    [[nodiscard]] std::string give_up(DriverState before);
    void                      accept(const DistributedVector &increment, double size, int iterations);
    [[nodiscard]] std::string refine_and_equilibrate();

    BoundaryValueProblem &problem;
    Options               options;
    StopRequest           stop_requested;
    LinearSolver          solver;
    DriverState           now;
    bool                  stopped = false;
    int                   version = 0; // structure version for which the solver was set up
  };
} // namespace diptych::continuum
