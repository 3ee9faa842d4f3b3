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

  // What a walk that goes on later must know.
  struct DriverState
  {
    StepCounts          count;
    double              step      = 0;  // wanted length of the next one [progress]
    double              last_step = 0;  // accepted; 0: none yet
    std::vector<double> last_increment; // accepted; relevant dofs
    Divisions           divisions;      // the mesh's history
  };

  // Walks the problem along its load path. A step that does not converge is halved and leaves no trace; after an easy
  // one the next is longer. One that is stopped between two Newton iterations leaves problem, driver and solver as they were
  // before it, to the last bit.
  class LoadDriver
  {
  public:
    LoadDriver(BoundaryValueProblem &problem, const Options &options, StopRequest stop_requested = {});

    // Equilibrium at rest from a state that is not quite in it: immediate for a rectangle under its own pressure, some steps
    // where the outline is wavy and the load is not normal to it, or the stress was mapped, or the mesh refined. Empty text,
    // or why it was not found.
    [[nodiscard]] std::string equilibrate();

    // One accepted step towards `progress`, which the last one of a stage meets exactly. Empty text, or why the run cannot go on.
    [[nodiscard]] std::string step_towards(double progress);

    // Whether the last of the two gave its text because it was stopped on request.
    bool was_stopped() const { return stopped; }

    // To be called when the problem's mesh has changed.
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
    int                   version = 0; // of the problem's structure that the solver knows
  };
} // namespace diptych::continuum
