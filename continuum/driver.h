// diptych: adaptive load steps
// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "continuum/boundary_value_problem.h"
#include "continuum/linear_solver.h"
#include "continuum/newton.h"
#include "continuum/panel.h"

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
  };

  // Walks the problem along its load path. A step that does not converge is halved and leaves no trace; after an easy
  // one the next is longer.
  class LoadDriver
  {
  public:
    LoadDriver(BoundaryValueProblem &problem, const Options &options);

    // Equilibrium at rest from a state that is not quite in it: immediate for a rectangle under its own pressure, some steps
    // where the outline is wavy and the load is not normal to it, or the stress was mapped, or the mesh refined. Empty text,
    // or why it was not found.
    [[nodiscard]] std::string equilibrate();

    // Up to exactly `progress`. `after_step` is called after every accepted step and ends the walk by returning
    // false. Empty text, or why the run cannot go on.
    [[nodiscard]] std::string advance(double progress, const std::function<bool()> &after_step);

    // To be called when the problem's mesh has changed.
    void restart(DriverState new_state);

    void go_on_counting(int linear_iterations, int factorisations, double cpu_s)
    {
      solver.go_on_counting(linear_iterations, factorisations, cpu_s);
    }

    const DriverState  &state() const { return now; }
    const LinearSolver &linear_solver() const { return solver; }

  private:
    DistributedVector         predict(double to);
    void                      follow_structure();
    NewtonReport              attempt(DistributedVector &increment);
    [[nodiscard]] std::string refine_and_equilibrate();

    BoundaryValueProblem &problem;
    Options               options;
    LinearSolver          solver;
    DriverState           now;
    int                   version = 0; // of the problem's structure that the solver knows
  };
} // namespace diptych::continuum
