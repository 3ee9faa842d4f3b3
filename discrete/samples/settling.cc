// diptych: removes the overlaps of a compacted sample
// SPDX-License-Identifier: LGPL-2.1-or-later
#include "discrete/samples/settling.h"

#include <algorithm>

#include "discrete/stepping/body_motion.h"

namespace diptych::discrete
{
  void stop(State &state)
  {
    for (Eigen::Vector2d &v : state.grains.velocity)
      v.setZero();
    std::fill(state.grains.spin.begin(), state.grains.spin.end(), 0.);
    for (Wall &wall : state.walls)
      wall.velocity.setZero();
    std::visit([](auto &kind) { kind.stop(); }, state.periodicity);
  }

  Settled settle(State                             &state,
                 StepSetting                        setting,
                 const SettlingOptions             &options,
                 const std::function<bool()>       &go_on,
                 const std::shared_ptr<ThreadTeam> &team)
  {
    // A residual e leaves an overlap of about e h^2 P/m. An overlap of 1e-4 d at a step of 0.2 d sqrt(rho/P) requires this
    // tolerance.
    constexpr double tolerance              = 5e-5;
    constexpr int    max_sweeps             = 2000;
    setting.stepping.penetration_correction = PenetrationCorrection::velocity;
    setting.solver.tolerance                = std::min(setting.solver.tolerance, tolerance);
    setting.solver.max_sweeps               = std::max(setting.solver.max_sweeps, max_sweeps);
    Settled   settled;
    StepCache cache;
    cache.team = team;
    stop(state);
    while (settled.steps < options.most_steps && go_on())
      {
        State next        = state;
        settled.last_step = advance(next, setting, cache); // contacts at the positions of `state`, because nothing moves yet
        settled.largest_overlap = settled.last_step.largest_penetration;
        ++settled.steps;
        state.impulses      = next.impulses;
        const double wanted = (settled.steps <= options.patient_steps ? 0.1 : 1.) * options.unbalanced_force;
        settled.quiet       = settled.largest_overlap <= options.largest_overlap &&
                        settled.last_step.solve.residual <= setting.solver.tolerance &&
                        settled.last_step.unbalanced_force <= wanted;
        if (settled.quiet)
          break;
        drift(next, 0.5 * setting.step); // to the next mid-step
        state = std::move(next);
        stop(state);
      }
    return settled;
  }

  bool carries_anything(const StepResult &step, const std::size_t n_grains, const LateralCondition &lateral)
  {
    const bool walls = std::holds_alternative<RigidSides>(lateral);
    for (std::size_t k = 0; k < step.contacts.size(); ++k)
      if (step.impulses[k].normal > 0 && (walls || std::size_t(step.contacts[k].j) < n_grains))
        return true;
    return std::holds_alternative<NoSides>(lateral);
  }
} // namespace diptych::discrete
