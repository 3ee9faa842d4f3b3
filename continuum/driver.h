// diptych: adaptive load steps
// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <functional>
#include <string>

#include "continuum/boundary_value_problem.h"
#include "continuum/linear_solver.h"
#include "continuum/newton.h"
#include "continuum/panel.h"

namespace diptych::continuum
{
  struct StepCounts
  {
    int steps = 0, cut_backs = 0, newton_iterations = 0;
  };

  // Walks the problem along its load path. A step that does not converge is halved and leaves no trace; after an easy
  // one the next is longer.
  class LoadDriver
  {
  public:
    LoadDriver(BoundaryValueProblem &problem, const Options &options);

    // Initial equilibrium under the lateral load, platens at rest: immediate for a rectangle, some steps where the
    // outline is wavy and the load is not normal to it. Empty text, or why it was not found.
    [[nodiscard]] std::string equilibrate();

    // Up to exactly `axial_strain`. `after_step` is called after every accepted step and ends the walk by returning
    // false. Empty text, or why the run cannot go on.
    [[nodiscard]] std::string advance(double axial_strain, const std::function<bool()> &after_step);

    const StepCounts        &counts() const { return count; }
    const KeptFactorisation &linear_solver() const { return solver; }

  private:
    DistributedVector predict(double step);
    NewtonReport      attempt(DistributedVector &increment);
    void              adapt(const NewtonReport &report);

    BoundaryValueProblem &problem;
    Options               options;
    KeptFactorisation     solver;
    StepCounts            count;
    double                step;           // wanted length of the next one [axial strain]
    DistributedVector     last_increment; // accepted
    double                last_step = 0;
  };
} // namespace diptych::continuum
