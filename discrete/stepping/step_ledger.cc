// diptych: energy and momentum of one step
// SPDX-License-Identifier: LGPL-2.1-or-later
#include "discrete/stepping/step_ledger.h"

#include <algorithm>
#include <cmath>

#include "discrete/bodies/boundary.h"
#include "discrete/contacts/contact_law.h"
#include "discrete/contacts/lattice_motion.h"

namespace diptych::discrete
{
  namespace
  {
    double kinetic(const double mass, const BodyVelocity &v)
    {
      return 0.5 * mass * (v.x * v.x + v.y * v.y + 0.5 * v.surface * v.surface);
    }

    Eigen::Vector2d mean_velocity(const SolvedStep &s, const std::size_t body)
    {
      return {0.5 * (s.v[body].x + s.v_new[body].x), 0.5 * (s.v[body].y + s.v_new[body].y)};
    }

    void add_grains(const SolvedStep &s, StepEnergies &e)
    {
      const Grains &g      = s.state.grains;
      double        energy = e.kinetic, change = e.kinetic_change, work = e.external_work; // local copies stay in registers
      for (std::size_t i = 0; i < g.size(); ++i)
        {
          if (g.platen(i) >= 0)
            continue; // the mass of the platen includes it
          const double was = kinetic(g.mass[i], s.v[i]), is = kinetic(g.mass[i], s.v_new[i]);
          energy += is;
          change += is - was;
          if (!g.fixed[i])
            work += s.step * s.applied_force[i].dot(mean_velocity(s, i));
        }
      e.kinetic        = energy;
      e.kinetic_change = change;
      e.external_work  = work;
    }

    struct ContactSums
    {
      double impulse = 0, normal = 0;                  // |r| and r_n
      double impact = 0, friction = 0, correction = 0; // work, split by direction
      double rolling = 0;                              // work of the couples
    };

    // Sums over the acting contacts. Also stores the work of each contact and the forces of the walls in the ledger.
    ContactSums sum_contacts(const SolvedStep &s, const bool corrects_by_velocity, StepLedger &ledger)
    {
      const std::size_t n = s.state.grains.size();
      ContactSums       sum;
      for (std::size_t a = 0; a < s.acting.size(); ++a)
        {
          fetch_ahead(s.problem.contacts, s.acting, a);
          const int              k    = s.acting[a];
          const ContactRow      &c    = s.problem.contacts[k];
          const Impulse         &r    = s.impulses[k];
          const RelativeVelocity u    = relative_velocity(c, s.v);
          const RelativeVelocity next = relative_velocity(c, s.v_new);
          sum.impulse += std::sqrt(r.normal * r.normal + r.tangential * r.tangential);
          sum.normal += r.normal;
          const double impact = 0.5 * r.normal * (u.normal + next.normal);
          sum.impact += impact;
          const double friction = 0.5 * r.tangential * (u.tangential + next.tangential);
          sum.friction += friction;
          ledger.contact_dissipation[k] = 0 - friction;
          if (r.rolling != 0)
            {
              const double rolling = 0.5 * r.rolling * (rolling_velocity(c, s.v) + rolling_velocity(c, s.v_new));
              sum.rolling += rolling;
              ledger.contact_dissipation[k] -= rolling;
            }
          ledger.contact_impact[k] = 0 - impact;
          if (corrects_by_velocity && c.normal_term < 0 && s.contacts[k].gap < 0)
            sum.correction += 0.5 * r.normal * c.normal_term;
          if (std::size_t(c.j) >= n)
            ledger.wall_force[c.j - n] += vector_of(c, r) / s.step;
        }
      return sum;
    }

    // A held grain takes contact impulses without changing its motion. Its support returns these impulses and does work with
    // them.
    Eigen::Vector2d add_held_grains(const SolvedStep &s, StepEnergies &e)
    {
      const Grains   &g        = s.state.grains;
      Eigen::Vector2d reaction = Eigen::Vector2d::Zero();
      const auto      hold     = [&](const int body, const Eigen::Vector2d &impulse, const double turning) {
        if (std::size_t(body) >= g.size() || g.fixed[body] != held_grain)
          return;
        reaction -= impulse;
        e.external_work -= impulse.dot(mean_velocity(s, body)) + turning * s.v[body].surface;
      };
      if (std::none_of(g.fixed.begin(), g.fixed.end(), [](const std::uint8_t fixed) { return fixed == held_grain; }))
        return reaction;
      for (std::size_t k = 0; k < s.contacts.size(); ++k)
        {
          const ContactRow     &c       = s.problem.contacts[k];
          const Impulse        &r       = s.impulses[k];
          const Eigen::Vector2d impulse = vector_of(c, r);
          hold(s.contacts[k].i, impulse, c.rolling_arm * r.rolling - r.tangential);
          hold(s.contacts[k].j, -impulse, 0 - (1 - c.rolling_arm) * r.rolling - r.tangential);
        }
      return reaction;
    }

    // Free components gain kinetic energy from applied forces. Prescribed components do work on the sample.
    void add_walls(const SolvedStep &s, const std::vector<Eigen::Vector2d> &wall_force, StepEnergies &e)
    {
      const std::size_t n = s.state.grains.size();
      for (std::size_t w = 0; w < s.state.walls.size(); ++w)
        {
          const Eigen::Vector2d mean = mean_velocity(s, n + w), mobility = s.state.walls[w].inverse_mass();
          const Eigen::Vector2d push   = applied_wall_force(s.state, w, s.state.time + 0.5 * s.step);
          const double          was[2] = {s.v[n + w].x, s.v[n + w].y}, is[2] = {s.v_new[n + w].x, s.v_new[n + w].y};
          for (int a = 0; a < 2; ++a)
            {
              e.external_work += s.step * (mobility[a] > 0 ? push[a] : wall_force[w][a]) * mean[a];
              if (mobility[a] > 0)
                {
                  e.kinetic += 0.5 * is[a] * is[a] / mobility[a];
                  e.kinetic_change += 0.5 * (is[a] * is[a] - was[a] * was[a]) / mobility[a];
                }
            }
        }
    }

    // A free width is a body under -pressure x height. A prescribed one works against the impulses across the edge.
    void add_width(const SolvedStep &s, StepEnergies &e)
    {
      const PeriodicWidth *periodic = s.state.width();
      if (!periodic || !periodic->moves())
        return;
      const double was = s.v.back().x, is = s.v_new.back().x, mean = 0.5 * (was + is);
      if (periodic->pressure)
        {
          e.external_work -= s.step * *periodic->pressure * sample_height(s.state) * mean;
          e.kinetic += 0.5 * periodic->mass * is * is;
          e.kinetic_change += 0.5 * periodic->mass * (is * is - was * was);
          return;
        }
      for (std::size_t k = 0; k < s.contacts.size(); ++k)
        if (const ContactRow &c = s.problem.contacts[k]; c.image_body >= 0)
          e.external_work += c.image.along * vector_of(c, s.impulses[k]).x() * mean;
    }

    // The drive balances contacts and inertia, and works with the rate of strain.
    void add_lattice(const SolvedStep &s, const Lattice &lattice, StepLedger &ledger)
    {
      const Eigen::Vector3d was = rate_of(s.v.back()), is = rate_of(s.v_new.back());
      Eigen::Matrix2d       sum = Eigen::Matrix2d::Zero();
      for (const int k : s.acting)
        {
          const Contact        &c      = s.contacts[k];
          const Eigen::Vector2d branch = (s.state.grains.radius[c.i] + s.state.grains.radius[c.j] + c.gap) * c.normal;
          sum += vector_of(s.problem.contacts[k], s.impulses[k]) * branch.transpose();
        }
      const Eigen::Vector3d moment(sum(0, 0), sum(1, 1), 0.5 * (sum(0, 1) + sum(1, 0)));
      const Eigen::Vector3d momentum = lattice.drive.inertia * (is - was), drive = moment + momentum;
      ledger.lattice = {moment / (s.step * lattice.area()), drive / (s.step * lattice.area())};
      ledger.energies.external_work += 0.5 * drive.dot(was + is);
      ledger.energies.kinetic += 0.5 * is.dot(lattice.drive.inertia * is);
      ledger.energies.kinetic_change += 0.5 * momentum.dot(was + is);
    }

    // Velocities of the grains beyond the mean strain of the lattice.
    std::vector<BodyVelocity> without_strain(const State &state, std::vector<BodyVelocity> v)
    {
      add_gradient(state.grains.position, -velocity_gradient(rate_of(v.back())), v);
      return v;
    }

    // `own`: the same step with the velocities of the grains that count as their motion.
    StepLedger ledger_of(const SolvedStep &s, const SolvedStep &own, const bool corrects_by_velocity)
    {
      const Grains     &g = s.state.grains;
      const std::size_t n = g.size();
      StepLedger        ledger;
      ledger.wall_force.assign(s.state.walls.size(), Eigen::Vector2d::Zero());
      ledger.contact_dissipation.assign(s.contacts.size(), 0.);
      ledger.contact_impact.assign(s.contacts.size(), 0.);
      const ContactSums contacts           = sum_contacts(s, corrects_by_velocity, ledger);
      ledger.energies.impact_dissipation   = 0 - contacts.impact;
      ledger.energies.friction_dissipation = 0 - contacts.friction;
      ledger.energies.rolling_dissipation  = 0 - contacts.rolling;
      ledger.energies.correction_work      = 0 - contacts.correction;
      add_grains(own, ledger.energies);
      add_walls(s, ledger.wall_force, ledger.energies);
      add_width(s, ledger.energies);

      double          unbalanced = 0, momentum_sum = 0;
      Eigen::Vector2d balance = -add_held_grains(s, ledger.energies);
      for (std::size_t i = 0; i < n; ++i)
        if (!g.fixed[i])
          {
            const Eigen::Vector2d change = g.mass[i] * Eigen::Vector2d(own.v_new[i].x - own.v[i].x, own.v_new[i].y - own.v[i].y);
            unbalanced += change.norm();
            momentum_sum += g.mass[i] * (std::abs(own.v_new[i].x) + std::abs(own.v_new[i].y));
            balance += change - s.step * s.applied_force[i];
          }
      for (const Eigen::Vector2d &f : ledger.wall_force)
        balance -= s.step * f;
      ledger.unbalanced_force  = s.acting.empty() ? 0 : (unbalanced / double(n)) / (contacts.normal / double(s.acting.size()));
      ledger.momentum_residual = contacts.impulse > 0 ? balance.norm() / (contacts.impulse + momentum_sum) : 0;
      return ledger;
    }
  } // namespace

  StepLedger step_ledger(const SolvedStep &s, const bool corrects_by_velocity)
  {
    const Lattice *lattice = s.state.lattice();
    if (!lattice)
      return ledger_of(s, s, corrects_by_velocity);
    const std::vector<BodyVelocity> v = without_strain(s.state, s.v), v_new = without_strain(s.state, s.v_new);
    const SolvedStep                own{s.state, s.problem, s.contacts, s.impulses, s.acting, s.applied_force, v, v_new, s.step};
    StepLedger                      ledger = ledger_of(s, own, corrects_by_velocity);
    add_lattice(s, *lattice, ledger);
    return ledger;
  }

  void count_springs(const std::vector<BoundWork> &lost, StepLedger &ledger)
  {
    BoundWork all;
    for (std::size_t k = 0; k < lost.size(); ++k)
      {
        double here = lost[k].sliding;
        if (lost[k].rolling != 0) // adding 0 would change the sign of a zero
          here += lost[k].rolling;
        all.sliding += lost[k].sliding;
        all.rolling += lost[k].rolling;
        ledger.contact_impact[k] += ledger.contact_dissipation[k] - here;
        ledger.contact_dissipation[k] = here;
      }
    StepEnergies &e = ledger.energies;
    e.impact_dissipation += e.friction_dissipation - all.sliding;
    e.impact_dissipation += e.rolling_dissipation - all.rolling;
    e.friction_dissipation = all.sliding;
    e.rolling_dissipation  = all.rolling;
  }
} // namespace diptych::discrete
