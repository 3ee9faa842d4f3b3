// diptych: explicit smooth contacts (penalty method), for comparison with the non-smooth scheme
// SPDX-License-Identifier: LGPL-2.1-or-later
#include "discrete/stepping/penalty.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>

#include "discrete/contacts/natural_map.h"
#include "discrete/stepping/body_motion.h"
#include "discrete/contacts/contact_law.h"
#include "discrete/stepping/step_problem.h"
#include "discrete/stepping/warm_start.h"

namespace diptych::discrete
{
  namespace
  {
    void validate(const StepSetting &setting, const PenaltyOptions &options)
    {
      if (!(options.stiffness * setting.pressure > 0))
        throw std::invalid_argument(
          "penalty steps need penalty_stiffness x pressure > 0, because this is the stiffness of the contacts");
      if (!(setting.step > 0))
        throw std::invalid_argument("penalty steps need step > 0");
    }

    bool has_blown_up(const State &state, const double h)
    {
      const Grains &g = state.grains;
      for (std::size_t i = 0; i < g.size(); ++i)
        if (!(h * g.velocity[i].norm() <= g.radius[i]) || !g.position[i].allFinite() || !std::isfinite(g.spin[i]))
          return true;
      for (const Wall &wall : state.walls)
        if (!wall.velocity.allFinite() || !wall.point.allFinite())
          return true;
      const PeriodicWidth *periodic = state.width();
      return periodic && !(std::isfinite(periodic->width) && periodic->width > 0);
    }

    StepResult blown_up()
    {
      StepResult result;
      result.solve.status   = SolveStatus::blown_up;
      result.solve.residual = std::numeric_limits<double>::infinity();
      return result;
    }

    struct SpringLaw
    {
      double kn, kt;        // [pressure]
      double damping;       // fraction of critical
      double previous_step; // length of the step whose impulse holds the spring
    };

    // A spring with a bound: its force, and the work that the bound took since the preceding q_m.
    struct Slider
    {
      double force, work;
    };

    Slider slide(const double spring, const double bound, const double stiffness)
    {
      const double force = std::clamp(spring, -bound, bound);
      return {force, force * (spring - force) / stiffness};
    }

    // Updates one contact. `r` holds its impulse of the last step and receives that of this step.
    BoundWork apply_law(const SpringLaw                 &law,
                        const ContactRow                &c,
                        const double                     gap,
                        const std::vector<BodyVelocity> &v,
                        const double                     h,
                        Impulse                         &r)
    {
      const RelativeVelocity u       = relative_velocity(c, v);
      const double           dashpot = std::isfinite(c.inverse_wnn) ? 2 * law.damping * std::sqrt(law.kn * c.inverse_wnn) : 0.;
      const double           fn      = std::max(0., -law.kn * gap - dashpot * u.normal);
      const Slider           t = slide(r.tangential / law.previous_step - law.kt * h * u.tangential, c.friction * fn, law.kt);
      const Slider           m = c.rolling_friction == 0 ? Slider{0, 0}
                                                         : slide(r.rolling / law.previous_step - law.kt * h * rolling_velocity(c, v),
                                                                 c.rolling_friction * fn, law.kt);
      r                        = {h * fn, h * t.force, h * m.force};
      return {t.work, m.work};
    }
  } // namespace

  double penalty_step(const Grains &grains, const double stiffness, const double fraction)
  {
    double mass = std::numeric_limits<double>::infinity();
    for (std::size_t i = 0; i < grains.size(); ++i)
      if (!grains.fixed[i])
        mass = std::min(mass, grains.mass[i]);
    if (!std::isfinite(mass) || !(stiffness > 0))
      throw std::invalid_argument("a penalty step needs a positive stiffness and at least one grain that is not fixed");
    return fraction * std::sqrt(mass / stiffness);
  }

  StepResult advance_penalty(State                &state,
                             PenaltyState         &penalty,
                             const StepSetting    &setting,
                             const PenaltyOptions &options,
                             const bool            with_ledger)
  {
    validate(setting, options);
    const double h = setting.step, kn = options.stiffness * setting.pressure;
    if (has_blown_up(state, h))
      return blown_up();
    State trial = state;
    drift(trial, 0.5 * h);

    StepResult result;
    result.applied_force = applied_forces(trial, setting);
    result.contacts      = penalty.neighbours.find_contacts(trial, std::vector<double>(trial.grains.size(), 0.));
    result.impulses      = first_guess(trial.impulses, result.contacts).impulses;

    const std::vector<BodyVelocity> v = body_velocities(trial);
    penalty.problem.free_velocity     = free_velocities(trial, v, result.applied_force, setting);
    penalty.problem                   = make_problem(trial, setting, result.contacts, v, std::move(penalty.problem));
    const ContactProblem &problem     = penalty.problem;
    SpringLaw             law;
    law.kn            = kn;
    law.kt            = tangential_over_normal_stiffness * kn;
    law.damping       = options.damping;
    law.previous_step = penalty.impulse_step > 0 ? penalty.impulse_step : h;
    std::vector<BoundWork> lost;
    lost.reserve(result.contacts.size());
    for (std::size_t k = 0; k < result.contacts.size(); ++k)
      {
        const double gap = result.contacts[k].gap;
        lost.push_back(apply_law(law, problem.contacts[k], gap, v, h, result.impulses[k]));
        result.largest_penetration = std::max(result.largest_penetration, -gap);
      }

    const std::vector<int>          acting = acting_contacts(result.impulses);
    const std::vector<BodyVelocity> v_new  = velocities(problem, result.impulses, acting);
    if (with_ledger)
      {
        static_cast<StepLedger &>(result) = step_ledger(
          {trial, problem, result.contacts, result.impulses, acting, result.applied_force, v, v_new, h}, false);
        count_springs(lost, result);
      }
    take_velocities(v_new, trial);
    drift(trial, 0.5 * h);
    if (has_blown_up(trial, h))
      return blown_up();
    keep_impulses(result.contacts, result.impulses, result.impulses, acting, trial);
    trial.time += h;
    state                = std::move(trial);
    penalty.impulse_step = h;
    return result;
  }
} // namespace diptych::discrete
