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
        if (!(h * h * g.velocity[i].squaredNorm() <= g.radius[i] * g.radius[i]) || !g.position[i].allFinite() ||
            !std::isfinite(g.spin[i]))
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

    SpringLaw law_of(const StepSetting &setting, const PenaltyOptions &options, const double impulse_step)
    {
      const double kn = options.stiffness * setting.pressure;
      return {kn, tangential_over_normal_stiffness * kn, options.damping, impulse_step > 0 ? impulse_step : setting.step};
    }

    // Impulse of the last step; 0 for a new contact. Contacts and `springs` ascend in (i, j), so `at` goes on from one contact to
    // the next.
    Impulse spring_of(const Contact &c, const std::vector<PairImpulse> &springs, std::size_t &at)
    {
      while (at < springs.size() && (springs[at].i < c.i || (springs[at].i == c.i && springs[at].j < c.j)))
        ++at;
      if (at == springs.size() || springs[at].i != c.i || springs[at].j != c.j)
        return {};
      return {springs[at].normal, springs[at].tangential, springs[at].rolling};
    }

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
    const double h = setting.step;
    if (has_blown_up(state, h))
      return blown_up();
    State &trial = penalty.trial;
    trial        = state;
    drift(trial, 0.5 * h);

    StepResult result;
    result.applied_force = applied_forces(trial, setting);
    penalty.margin.resize(trial.grains.size(), 0.);
    result.contacts     = penalty.neighbours.find_contacts(trial, penalty.margin);
    const SpringLaw law = law_of(setting, options, penalty.impulse_step);

    const std::vector<BodyVelocity> v       = body_velocities(trial);
    ContactProblem                 &problem = penalty.problem;
    problem.free_velocity                   = free_velocities(trial, v, result.applied_force, setting);
    problem.lattice                         = lattice_problem(trial, h);
    std::vector<BodyVelocity> v_new         = problem.free_velocity;
    const std::size_t         n             = result.contacts.size();
    problem.contacts.resize(n);
    result.impulses.resize(n);
    std::vector<BoundWork> lost(n);
    std::vector<int>       acting;
    acting.reserve(n);
    trial.impulses.clear();
    std::size_t spring = 0;
    for (std::size_t k = 0; k < n; ++k)
      {
        const Contact &c   = result.contacts[k];
        ContactRow    &row = problem.contacts[k];
        Impulse       &r   = result.impulses[k];
        r                  = spring_of(c, state.impulses, spring);
        set_row(trial, setting, c, v, row);
        lost[k]                    = apply_law(law, row, c.gap, v, h, r);
        result.largest_penetration = std::max(result.largest_penetration, -c.gap);
        if (r.normal == 0)
          continue;
        acting.push_back(int(k));
        keep_impulse(c, r, trial.impulses);
        if (!problem.lattice)
          apply_impulse(row, r, v_new);
      }
    if (problem.lattice)
      v_new = velocities(problem, result.impulses, acting);
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
    trial.time += h;
    std::swap(state, trial);
    penalty.impulse_step = h;
    return result;
  }
} // namespace diptych::discrete
