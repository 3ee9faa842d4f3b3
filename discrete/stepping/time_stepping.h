// diptych: one Moreau-Jean step of Non-Smooth Contact Dynamics
// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <memory>
#include <optional>

#include "discrete/contacts/contact_detection.h"
#include "discrete/stepping/grain_stress_error.h"
#include "discrete/solvers/solver.h"
#include "discrete/stepping/step_ledger.h"
#include "discrete/stepping/step_setting.h"

namespace diptych::discrete
{
  // Data that one step passes to the next to save work. Results do not depend on them.
  struct StepCache
  {
    NeighbourList               neighbours;
    ContactProblem              problem; // reused for its memory
    std::shared_ptr<ThreadTeam> team = std::make_shared<ThreadTeam>(1);
  };

  struct [[nodiscard]] StepResult : StepLedger
  {
    SolveReport                    solve;
    std::vector<Contact>           contacts;                // at mid-step, ascending in (i, j)
    std::vector<Impulse>           impulses;                // of each contact
    std::vector<Eigen::Vector2d>   applied_force;           // on each grain: lateral action and gravity
    double                         largest_penetration = 0; // at mid-step [length]
    std::optional<SampledAccuracy> accuracy;                // if the step was sampled
  };

  // Advances the state by one step h (Moreau 1988, Jean 1999, theta = 1/2). Symbols: positions q, velocities v, masses M,
  // applied forces F. H maps impulses of contacts to impulses on bodies. A prime marks values at the end of the step.
  //   q_m = q + (h/2) v; contacts are found at q_m; v_f = v + h M^-1 F; the solver finds the impulses r; v' = v_f + M^-1 H r;
  //   q' = q_m + (h/2) v'; penetrations are corrected.
  // Normal law of a contact with relative velocity u_n and impulse r_n >= 0: u_n' + c_n >= 0, and r_n (u_n' + c_n) = 0.
  //   Impact (u_n < 0 and the gap g is or would be closed): c_n = e_n u_n.
  //   Otherwise: c_n = max(g, 0)/h. For g >= 0 the law then says that the gap at the next q_m, g + h u_n', is not negative.
  // Detection margin of a grain: 0.04 d + 1.2 h (|v| + h |F|/m).
  // If the solver does not converge, the state stays unchanged unless accept_unconverged is set. With `sample` the solve
  // continues until the grains' stress has the requested accuracy.
  StepResult advance(State &state, const StepSetting &setting, StepCache &cache, const SampleRequest *sample = nullptr);
  StepResult advance(State &state, const StepSetting &setting);

  // Lateral action and gravity on each grain at the present positions; zero for fixed grains. [pressure x length]
  std::vector<Eigen::Vector2d> applied_forces(const State &state, const StepSetting &setting);

  // Kinetic energy of the grains, or of all bodies with free walls, a free width or a lattice.
  double kinetic_energy(const Grains &grains);
  double kinetic_energy(const State &state);
} // namespace diptych::discrete
