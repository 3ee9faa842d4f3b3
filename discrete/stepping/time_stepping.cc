// diptych: one Moreau-Jean step of Non-Smooth Contact Dynamics
// SPDX-License-Identifier: LGPL-2.1-or-later
#include "discrete/stepping/time_stepping.h"

#include <algorithm>
#include <cmath>

#include "discrete/contacts/natural_map.h"
#include "discrete/stepping/body_motion.h"
#include "discrete/stepping/position_correction.h"
#include "discrete/stepping/step_problem.h"
#include "discrete/stepping/warm_start.h"

namespace diptych::discrete
{
  namespace
  {
    std::vector<double> detection_margins(const State                        &state,
                                          const StepSetting                  &setting,
                                          const std::vector<BodyVelocity>    &v,
                                          const std::vector<Eigen::Vector2d> &force)
    {
      const double        h = setting.step;
      std::vector<double> margin(state.grains.size());
      double wall_speed = std::visit([&](const auto &kind) { return kind.speed(setting.mean_diameter); }, state.periodicity);
      for (std::size_t w = 0; w < state.walls.size(); ++w)
        {
          const Wall &wall = state.walls[w];
          wall_speed       = std::max({wall_speed, wall.velocity.norm(), prescribed_wall_velocity(wall, state.time + h).norm()});
          // A wall under a force mostly rests on grains. The speed that it could reach without them would flood the list at long
          // steps.
          wall_speed += std::min(h * applied_wall_force(state, w, state.time).cwiseProduct(wall.inverse_mass()).norm(),
                                 0.1 * setting.mean_diameter / h);
        }
      for (std::size_t i = 0; i < margin.size(); ++i)
        {
          const Eigen::Vector2d &own   = state.grains.velocity[i];
          const double           speed = std::max(std::sqrt(own.x() * own.x() + own.y() * own.y()), wall_speed);
          margin[i] = 0.04 * setting.mean_diameter + 1.2 * h * (speed + h * force[i].norm() * v[i].inverse_mass);
        }
      return margin;
    }

    double largest_penetration(const std::vector<Contact> &contacts)
    {
      double largest = 0;
      for (const Contact &c : contacts)
        largest = std::max(largest, -c.gap);
      return largest;
    }
  } // namespace

  std::vector<Eigen::Vector2d> applied_forces(const State &state, const StepSetting &setting)
  {
    const Eigen::Vector2d        gravity(setting.stepping.gravity_x, setting.stepping.gravity_y);
    std::vector<Eigen::Vector2d> force(state.grains.size(), Eigen::Vector2d::Zero());
    for (std::size_t i = 0; i < force.size(); ++i)
      if (!state.grains.fixed[i])
        force[i] = state.grains.mass[i] * gravity;
    if (const auto *action = std::get_if<EndGrains>(&setting.lateral); action && state.walls.size() >= 2)
      add_lateral_forces(state, *action, setting.pressure, setting.mean_diameter, force);
    return force;
  }

  StepResult advance(State &state, const StepSetting &setting, StepCache &cache, const SampleRequest *sample)
  {
    const double h = setting.step;
    State        trial{state.grains, state.walls, state.periodicity, {}, state.time}; // without the impulses of the last step
    drift(trial, 0.5 * h);

    StepResult result;
    result.applied_force              = applied_forces(trial, setting);
    const std::vector<BodyVelocity> v = body_velocities(trial);
    result.contacts = cache.neighbours.find_contacts(trial, detection_margins(trial, setting, v, result.applied_force));
    result.largest_penetration      = largest_penetration(result.contacts);
    cache.problem.free_velocity     = free_velocities(trial, v, result.applied_force, setting);
    cache.problem                   = make_problem(trial, setting, result.contacts, v, std::move(cache.problem));
    const ContactProblem &problem   = cache.problem;
    const FirstGuess      previous  = first_guess(state.impulses, result.contacts);
    const bool            compliant = setting.compliance.stiffness > 0;
    if (compliant)
      add_springs(setting, result.contacts, previous.impulses, cache.problem);
    result.impulses = previous.impulses;
    extrapolate(problem, previous.changes, result.impulses);
    if (sample && sample->options.snapshot_max_sweeps > 0)
      result.solve = solve_sampled({problem, trial.grains.radius, result.contacts}, setting.solver, *sample, *cache.team,
                                   result.impulses, result.accuracy.emplace());
    else
      result.solve = solve(problem, setting.solver, result.impulses, *cache.team);
    if (sample && sample->on_problem)
      sample->on_problem(problem, result.contacts, result.impulses);
    const bool is_left_half = result.solve.status == SolveStatus::stopped;
    if (is_left_half || (result.solve.status != SolveStatus::converged && !setting.accept_unconverged))
      return result;

    const std::vector<int>          acting = acting_contacts(result.impulses);
    const std::vector<BodyVelocity> v_new  = velocities(problem, result.impulses, acting);
    static_cast<StepLedger &>(result)      = step_ledger(
           {trial, problem, result.contacts, result.impulses, acting, result.applied_force, v, v_new, h},
           setting.law.normal_restitution == 0 && corrected_share(setting.stepping) > 0);
    if (compliant)
      count_springs(work_at_bounds(problem, v_new, result.impulses), result);

    take_velocities(v_new, trial);
    drift(trial, 0.5 * h);
    if (!compliant && setting.stepping.penetration_correction == PenetrationCorrection::projection)
      correct_positions(trial, {cache.problem, result.contacts, result.impulses, v_new, h}, 1e-4 * setting.mean_diameter,
                        *cache.team);
    keep_impulses(result.contacts, result.impulses, previous.impulses, acting, trial);
    trial.time += h;
    state = std::move(trial);
    return result;
  }

  StepResult advance(State &state, const StepSetting &setting)
  {
    StepCache cache;
    return advance(state, setting, cache);
  }

  double kinetic_energy(const Grains &grains)
  {
    double energy = 0;
    for (std::size_t i = 0; i < grains.size(); ++i)
      if (grains.platen(i) < 0)
        energy += 0.5 * grains.mass[i] * grains.velocity[i].squaredNorm() +
                  0.5 * grains.moment_of_inertia(i) * grains.spin[i] * grains.spin[i];
    return energy;
  }

  double kinetic_energy(const State &state)
  {
    double energy = kinetic_energy(state.grains);
    for (const Wall &wall : state.walls)
      for (int axis = 0; axis < 2; ++axis)
        if (wall.inverse_mass()[axis] > 0)
          energy += 0.5 * wall.mass * wall.velocity[axis] * wall.velocity[axis];
    return energy + std::visit([](const auto &kind) { return kind.kinetic_energy(); }, state.periodicity);
  }
} // namespace diptych::discrete
