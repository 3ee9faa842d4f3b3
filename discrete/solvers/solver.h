// diptych: common interface of the contact solvers
// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <functional>
#include <string>

#include "discrete/contacts/contact_problem.h"
#include "discrete/solvers/solver_options.h"
#include "discrete/solvers/thread_team.h"

namespace diptych::discrete
{
  // A condition in addition to the residual. It is called where the residual is below the tolerance. Arguments: the report so
  // far, and a function that returns the present impulses.
  using StopTest = std::function<bool(const SolveReport &, const std::function<std::vector<Impulse>()> &impulses)>;

  // Solves in place from the given first guess (one impulse per contact). If the residual is already below the tolerance, this
  // costs one check and no sweep. `psor` gives the same bits for every size of the team. `nsgs` uses one thread.
  SolveReport solve(const ContactProblem &problem,
                    const SolverOptions  &options,
                    std::vector<Impulse> &impulses,
                    ThreadTeam           &team,
                    const StopTest       &stop_test = {});
  SolveReport solve(const ContactProblem &problem, const SolverOptions &options, std::vector<Impulse> &impulses);

  // Reason why a problem was not solved; empty unless the contacts still violate their laws by most of their free velocity.
  std::string obstacle_to(const SolveReport &report);
} // namespace diptych::discrete
