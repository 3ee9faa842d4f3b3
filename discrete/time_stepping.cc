// diptych: one Moreau-Jean step of Non-Smooth Contact Dynamics
// SPDX-License-Identifier: LGPL-2.1-or-later
#include "discrete/time_stepping.h"

#include <algorithm>
#include <cmath>

#include "discrete/contact_law.h"
#include "discrete/contact_order.h"

namespace diptych::discrete
{
  namespace
  {
    constexpr int projection_sweeps = 10;

    // q += (h/2) v for grains and walls.
    void drift(State &state, const double duration)
    {
      Grains &g = state.grains;
      for (std::size_t i = 0; i < g.size(); ++i)
        {
          g.position[i] += duration * g.velocity[i];
          g.rotation[i] += duration * g.spin[i];
        }
      for (Wall &wall : state.walls)
        wall.point += duration * wall.velocity;
    }

    std::vector<Eigen::Vector2d> applied_forces(const State &state, const StepSetting &setting)
    {
      const Eigen::Vector2d        gravity(setting.time.gravity_x, setting.time.gravity_y);
      std::vector<Eigen::Vector2d> force(state.grains.size());
      for (std::size_t i = 0; i < force.size(); ++i)
        force[i] = state.grains.mass[i] * gravity;
      add_lateral_forces(state, setting.lateral, setting.pressure, setting.mean_diameter, force);
      return force;
    }

    std::vector<double> detection_margins(const State                        &state,
                                          const StepSetting                  &setting,
                                          const std::vector<Eigen::Vector2d> &force)
    {
      const double        h = setting.time.step;
      const Grains       &g = state.grains;
      std::vector<double> margin(g.size());
      double              wall_speed = 0;
      for (const Wall &wall : state.walls)
        wall_speed = std::max(wall_speed, wall.velocity.norm());
      for (std::size_t i = 0; i < g.size(); ++i)
        margin[i] = 0.04 * setting.mean_diameter +
                    1.2 * h * (std::max(g.velocity[i].norm(), wall_speed) + h * force[i].norm() / g.mass[i]);
      return margin;
    }

    // Velocities of all bodies in the form of the contact problem, grains first, then walls.
    std::vector<BodyVelocity> body_velocities(const State &state)
    {
      const Grains             &g = state.grains;
      std::vector<BodyVelocity> v;
      v.reserve(g.size() + state.walls.size());
      for (std::size_t i = 0; i < g.size(); ++i)
        v.push_back({g.velocity[i].x(), g.velocity[i].y(), g.radius[i] * g.spin[i], 1 / g.mass[i]});
      for (const Wall &wall : state.walls)
        v.push_back({wall.velocity.x(), wall.velocity.y(), 0, 0});
      return v;
    }

    double normal_term(const Contact &c, const double un, const double en, const StepOptions &time)
    {
      const double h = time.step;
      if (en > 0 && un < 0 && (c.gap <= 0 || c.gap + h * un < 0))
        return en * un;
      if (c.gap < 0 && time.penetration_correction == "velocity")
        return c.gap / h;
      if (c.gap < 0 && time.penetration_correction == "soft_velocity")
        return 0.2 * c.gap / h;
      return std::max(c.gap, 0.) / h;
    }

    ContactProblem make_problem(const State                     &state,
                                const StepSetting               &setting,
                                const std::vector<Contact>      &contacts,
                                const std::vector<BodyVelocity> &v,
                                std::vector<BodyVelocity>        free_velocity)
    {
      const int      n = int(state.grains.size());
      ContactProblem problem;
      problem.free_velocity = std::move(free_velocity);
      problem.contacts.reserve(contacts.size());
      for (const Contact &c : contacts)
        {
          const bool   wall = c.j >= n;
          const double wi = v[c.i].inverse_mass, wj = v[c.j].inverse_mass;
          // r^2/I of a disc is 2/m; a wall does not turn.
          ContactRow             row{c.normal.x(),
                         c.normal.y(),
                         0,
                         0,
                         wall ? setting.law.platen_friction : setting.law.friction,
                         1 / (wi + wj),
                         1 / (wi + wj + 2 * wi + 2 * wj),
                         2 * wi,
                         2 * wj,
                         c.i,
                         c.j};
          const RelativeVelocity u = relative_velocity(row, v[c.i], v[c.j]);
          row.normal_term          = normal_term(c, u.normal, setting.law.normal_restitution, setting.time);
          row.tangential_term      = setting.law.tangential_restitution * u.tangential;
          problem.contacts.push_back(row);
        }
      return problem;
    }

    // Impulses of the preceding step by body pair; new contacts start from zero.
    std::vector<Impulse> first_guess(const std::vector<PairImpulse> &previous, const std::vector<Contact> &contacts)
    {
      std::vector<Impulse> guess(contacts.size());
      for (std::size_t k = 0; k < contacts.size(); ++k)
        {
          const auto pair = std::lower_bound(
            previous.begin(), previous.end(), contacts[k],
            [](const PairImpulse &p, const Contact &c) { return p.i != c.i ? p.i < c.i : p.j < c.j; });
          if (pair != previous.end() && pair->i == contacts[k].i && pair->j == contacts[k].j)
            guess[k] = {pair->normal, pair->tangential};
        }
      return guess;
    }

    void keep_impulses(const StepResult &result, State &state)
    {
      state.impulses.clear();
      for (std::size_t k = 0; k < result.contacts.size(); ++k)
        if (result.impulses[k].normal != 0)
          state.impulses.push_back(
            {result.contacts[k].i, result.contacts[k].j, result.impulses[k].normal, result.impulses[k].tangential});
      std::sort(state.impulses.begin(), state.impulses.end(),
                [](const PairImpulse &a, const PairImpulse &b) { return a.i != b.i ? a.i < b.i : a.j < b.j; });
    }

    // Gauss-Seidel on positions: each closed pair is parted by its penetration, in proportion to the inverse masses. Adds
    // no velocity.
    void project_positions(State &state, const std::vector<Contact> &contacts)
    {
      Grains   &g = state.grains;
      const int n = int(g.size());
      for (int sweep = 0; sweep < projection_sweeps; ++sweep)
        {
          bool moved = false;
          for (const Contact &candidate : contacts)
            {
              const Contact c = make_contact(state, candidate.i, candidate.j);
              if (c.gap >= 0)
                continue;
              const double wi = 1 / g.mass[c.i], wj = c.j < n ? 1 / g.mass[c.j] : 0;
              g.position[c.i] -= c.gap * wi / (wi + wj) * c.normal;
              if (c.j < n)
                g.position[c.j] += c.gap * wj / (wi + wj) * c.normal;
              moved = true;
            }
          if (!moved)
            return;
        }
    }

    StepEnergies step_energies(const State                     &before,
                               const ContactProblem            &problem,
                               const StepSetting               &setting,
                               const std::vector<BodyVelocity> &v,
                               const std::vector<BodyVelocity> &v_new,
                               const StepResult                &result)
    {
      const double h = setting.time.step;
      const auto   n = before.grains.size();
      StepEnergies e;
      for (std::size_t i = 0; i < n; ++i)
        {
          const double m = before.grains.mass[i];
          // m (v^2 + s^2/2)/2, since I omega^2 = m s^2 / 2.
          const double was = 0.5 * m * (v[i].x * v[i].x + v[i].y * v[i].y + 0.5 * v[i].surface * v[i].surface);
          const double is  = 0.5 * m *
                            (v_new[i].x * v_new[i].x + v_new[i].y * v_new[i].y + 0.5 * v_new[i].surface * v_new[i].surface);
          e.kinetic += is;
          e.kinetic_change += is - was;
          e.external_work += 0.5 * h * result.applied_force[i].dot(Eigen::Vector2d(v[i].x + v_new[i].x, v[i].y + v_new[i].y));
        }
      for (std::size_t k = 0; k < problem.contacts.size(); ++k)
        {
          const ContactRow      &c    = problem.contacts[k];
          const Impulse         &r    = result.impulses[k];
          const RelativeVelocity u    = relative_velocity(c, v[c.i], v[c.j]);
          const RelativeVelocity next = relative_velocity(c, v_new[c.i], v_new[c.j]);
          e.impact_dissipation -= 0.5 * r.normal * (u.normal + next.normal);
          e.friction_dissipation -= 0.5 * r.tangential * (u.tangential + next.tangential);
          if (result.contacts[k].gap < 0 && c.normal_term < 0 && setting.law.normal_restitution == 0)
            e.correction_work -= 0.5 * r.normal * c.normal_term;
        }
      for (std::size_t w = 0; w < before.walls.size(); ++w)
        e.external_work += h * result.wall_force[w].dot(before.walls[w].velocity);
      return e;
    }

    void wall_forces_and_momentum(const State                     &before,
                                  const ContactProblem            &problem,
                                  const std::vector<BodyVelocity> &v,
                                  const std::vector<BodyVelocity> &v_new,
                                  const double                     h,
                                  StepResult                      &result)
    {
      const std::size_t n = before.grains.size();
      result.wall_force.assign(before.walls.size(), Eigen::Vector2d::Zero());
      double impulse_sum = 0;
      for (std::size_t k = 0; k < problem.contacts.size(); ++k)
        {
          const ContactRow &c = problem.contacts[k];
          const Impulse    &r = result.impulses[k];
          impulse_sum += std::hypot(r.normal, r.tangential);
          if (std::size_t(c.j) >= n)
            result.wall_force[c.j - n] += Eigen::Vector2d(c.nx * r.normal - c.ny * r.tangential,
                                                          c.ny * r.normal + c.nx * r.tangential) /
                                          h;
        }
      Eigen::Vector2d balance = Eigen::Vector2d::Zero();
      for (std::size_t i = 0; i < n; ++i)
        balance += before.grains.mass[i] * Eigen::Vector2d(v_new[i].x - v[i].x, v_new[i].y - v[i].y) -
                   h * result.applied_force[i];
      for (const Eigen::Vector2d &f : result.wall_force)
        balance -= h * f;
      result.momentum_residual = impulse_sum > 0 ? balance.norm() / impulse_sum : 0;
    }
  } // namespace

  StepResult advance(State &state, const StepSetting &setting)
  {
    const double h     = setting.time.step;
    State        trial = state;
    drift(trial, 0.5 * h);

    StepResult result;
    result.applied_force = applied_forces(trial, setting);
    result.contacts      = sweep_order(find_contacts(trial, detection_margins(trial, setting, result.applied_force)),
                                       int(trial.grains.size()));
    for (const Contact &c : result.contacts)
      result.largest_penetration = std::max(result.largest_penetration, -c.gap);

    const std::vector<BodyVelocity> v             = body_velocities(trial);
    std::vector<BodyVelocity>       free_velocity = v;
    for (std::size_t i = 0; i < trial.grains.size(); ++i)
      {
        free_velocity[i].x += h * result.applied_force[i].x() * v[i].inverse_mass;
        free_velocity[i].y += h * result.applied_force[i].y() * v[i].inverse_mass;
      }
    const ContactProblem problem = make_problem(trial, setting, result.contacts, v, std::move(free_velocity));
    result.impulses              = first_guess(trial.impulses, result.contacts);
    result.solve                 = solve(problem, setting.solver, result.impulses);
    if (result.solve.status != SolveStatus::converged && !setting.accept_unconverged)
      return result;

    const std::vector<BodyVelocity> v_new = velocities(problem, result.impulses);
    wall_forces_and_momentum(trial, problem, v, v_new, h, result);
    result.energies = step_energies(trial, problem, setting, v, v_new, result);

    for (std::size_t i = 0; i < trial.grains.size(); ++i)
      {
        trial.grains.velocity[i] = {v_new[i].x, v_new[i].y};
        trial.grains.spin[i]     = v_new[i].surface / trial.grains.radius[i];
      }
    drift(trial, 0.5 * h);
    if (setting.time.penetration_correction == "projection")
      project_positions(trial, result.contacts);
    keep_impulses(result, trial);
    trial.time += h;
    state = std::move(trial);
    return result;
  }

  double kinetic_energy(const Grains &grains)
  {
    double energy = 0;
    for (std::size_t i = 0; i < grains.size(); ++i)
      energy += 0.5 * grains.mass[i] * grains.velocity[i].squaredNorm() +
                0.5 * grains.moment_of_inertia(i) * grains.spin[i] * grains.spin[i];
    return energy;
  }
} // namespace diptych::discrete
