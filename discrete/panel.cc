// diptych: the discrete panel, a grain sample loaded through a list of stages
// SPDX-License-Identifier: LGPL-2.1-or-later
#include "discrete/panel.h"

#include <algorithm>
#include <cmath>
#include <ctime>
#include <sstream>
#include <stdexcept>

#include "discrete/contact_law.h"
#include "discrete/internal_moment.h"
#include "discrete/outline.h"
#include "discrete/window_forces.h"

namespace diptych::discrete
{
  namespace
  {
    double cpu_seconds()
    {
      return double(std::clock()) / CLOCKS_PER_SEC;
    }

    // What stays constant while the sample is loaded.
    struct Reference
    {
      std::vector<Eigen::Vector2d> position;
      Eigen::Vector2d              platen;
      double                       height = 0, area = 0, kinetic_energy = 0, platen_kinetic_energy = 0;
      double                       strain_rate = 0, mean_density = 0;
    };

    Reference make_reference(const State &state, const double mean_diameter)
    {
      Reference reference;
      reference.position       = state.grains.position;
      reference.platen         = state.walls[1].point;
      reference.height         = state.walls[1].point.y() - state.walls[0].point.y();
      reference.area           = outline_area(make_outline(state, mean_diameter));
      reference.kinetic_energy = kinetic_energy(state.grains);
      double mass = 0, grain_area = 0;
      for (std::size_t i = 0; i < state.grains.size(); ++i)
        {
          mass += state.grains.mass[i];
          grain_area += M_PI * state.grains.radius[i] * state.grains.radius[i];
        }
      reference.mean_density          = mass / grain_area;
      reference.platen_kinetic_energy = 0.25 * mass * state.walls[1].velocity.squaredNorm();
      reference.strain_rate           = -state.walls[1].velocity.y() / reference.height;
      return reference;
    }

    double axial_strain(const State &state, const Reference &reference)
    {
      return (reference.platen.y() - state.walls[1].point.y()) / reference.height;
    }

    std::vector<ContactForce> contact_forces(const State &state, const StepResult &result, const double step)
    {
      std::vector<ContactForce> forces;
      forces.reserve(result.contacts.size());
      for (std::size_t k = 0; k < result.contacts.size(); ++k)
        {
          const Contact c = make_contact(state, result.contacts[k].i, result.contacts[k].j);
          forces.push_back({c.i, c.j, c.point, c.normal, impulse_vector(result.contacts[k], result.impulses[k]) / step});
        }
      return forces;
    }

    ContactStatus contact_status(const Contact &c, const Impulse &r, const int n_grains, const ContactLawOptions &law)
    {
      if (r.normal == 0)
        return ContactStatus::open;
      ContactRow row{};
      row.friction = c.j >= n_grains ? law.platen_friction : law.friction;
      return is_slipping(row, r) ? ContactStatus::slipping : ContactStatus::sticking;
    }

    std::vector<std::uint8_t> rattlers(const StepResult &result, const std::size_t n_grains)
    {
      std::vector<std::uint8_t> free(n_grains, 1);
      for (std::size_t k = 0; k < result.contacts.size(); ++k)
        if (result.impulses[k].normal > 0)
          {
            free[result.contacts[k].i] = 0;
            if (std::size_t(result.contacts[k].j) < n_grains)
              free[result.contacts[k].j] = 0;
          }
      return free;
    }

    Snapshot make_snapshot(const State        &state,
                           const StepResult   &result,
                           const WindowForces &window,
                           const Reference    &reference,
                           const StepSetting  &setting)
    {
      const Grains &g = state.grains;
      Snapshot      s;
      s.axial_strain  = axial_strain(state, reference);
      s.time          = state.time;
      s.step          = setting.time.step;
      s.residual      = result.solve.residual;
      s.mean_diameter = setting.mean_diameter;
      s.position      = g.position;
      s.velocity      = g.velocity;
      s.rotation      = g.rotation;
      s.spin          = g.spin;
      s.radius        = g.radius;
      s.mass          = g.mass;
      for (std::size_t i = 0; i < g.size(); ++i)
        s.displacement.push_back(g.position[i] - reference.position[i]);
      s.contacts             = contact_forces(state, result, s.step);
      s.internal_moment      = internal_moments(g.position, s.contacts, spin_terms(g));
      s.window_forces        = window.time() > 0 ? window.mean_forces(state) : s.contacts;
      s.mean_spin_term       = window.time() > 0 ? window.mean_spin_term() : spin_terms(g);
      s.window_time          = window.time();
      s.mean_internal_moment = internal_moments(g.position, s.window_forces, s.mean_spin_term);
      s.rattler              = rattlers(result, g.size());
      s.applied_force        = result.applied_force;
      for (std::size_t k = 0; k < s.contacts.size(); ++k)
        {
          s.gap.push_back(make_contact(state, s.contacts[k].i, s.contacts[k].j).gap);
          s.status.push_back(contact_status(result.contacts[k], result.impulses[k], int(g.size()), setting.law));
        }
      s.lower_y                   = state.walls[0].point.y();
      s.upper_y                   = state.walls[1].point.y();
      s.upper_platen_displacement = state.walls[1].point - reference.platen;
      s.lower_platen_force        = result.wall_force[0];
      s.upper_platen_force        = result.wall_force[1];
      s.outline                   = make_outline(state, setting.mean_diameter);
      s.area                      = outline_area(s.outline);
      return s;
    }

    // Adds one step to the ledger and says where the sample stands. `total` is the row of the preceding step.
    HistoryRow next_row(const HistoryRow  &last,
                        const State       &before,
                        const State       &state,
                        const StepResult  &result,
                        const Reference   &reference,
                        const StepSetting &setting)
    {
      const Grains             &g      = state.grains;
      const std::vector<double> spin   = spin_terms(g);
      const double              area   = outline_area(make_outline(state, setting.mean_diameter));
      Eigen::Matrix2d           moment = Eigen::Matrix2d::Zero();
      for (const Eigen::Matrix2d &m : internal_moments(g.position, contact_forces(state, result, setting.time.step), spin))
        moment += m;

      HistoryRow row        = last;
      row.step              = last.step + 1;
      row.time              = state.time;
      row.axial_strain      = axial_strain(state, reference);
      row.stress            = moment / area;
      row.stress_ratio      = stress_ratio(row.stress);
      row.volumetric_strain = 1 - area / reference.area;
      row.lower_force       = result.wall_force[0];
      row.upper_force       = result.wall_force[1];
      row.contacts          = int(
        std::count_if(result.impulses.begin(), result.impulses.end(), [](const Impulse &r) { return r.normal > 0; }));
      row.sweeps               = result.solve.sweeps;
      row.residual             = result.solve.residual;
      row.kinetic_energy       = result.energies.kinetic;
      row.kinetic_energy_ratio = reference.platen_kinetic_energy > 0 ? row.kinetic_energy / reference.platen_kinetic_energy : 0;
      row.friction_dissipation += result.energies.friction_dissipation;
      row.impact_dissipation += result.energies.impact_dissipation;
      row.external_work += result.energies.external_work;
      row.correction_work += result.energies.correction_work;
      row.energy_residual = (row.kinetic_energy - reference.kinetic_energy - row.external_work + row.friction_dissipation +
                             row.impact_dissipation) /
                            std::abs(row.external_work);
      const double s      = 0.5 * row.stress.trace();
      row.inertial_number = s > 0 ? reference.strain_rate * setting.mean_diameter * std::sqrt(reference.mean_density / s) : 0;
      row.max_penetration = result.largest_penetration / setting.mean_diameter;
      const std::vector<std::uint8_t> free = rattlers(result, g.size());
      row.rattlers                         = int(std::count(free.begin(), free.end(), 1));
      double spin_sum                      = 0;
      for (const double x : spin)
        spin_sum += x;
      row.spin_term_share   = s > 0 ? spin_sum / area / s : 0;
      row.momentum_residual = result.momentum_residual;
      row.unbalanced_force  = unbalanced_force(before, state, result, setting.time.step);
      return row;
    }

    // Whole numbers of steps between stages; the step is shortened where they do not fit.
    double fitted_step(const Loading &loading, const double step, const double strain_rate)
    {
      double fitted = step, from = 0;
      for (const double stage : loading.stages)
        {
          const double time = (stage - from) / strain_rate;
          fitted            = std::min(fitted, time / std::ceil(time / step - 1e-9));
          from              = stage;
        }
      return fitted;
    }

    void check(const Loading &loading)
    {
      if (loading.stages.empty() || loading.stages.front() <= 0 ||
          std::adjacent_find(loading.stages.begin(), loading.stages.end(), std::greater_equal<double>()) != loading.stages.end())
        throw std::invalid_argument("the stages of the loading must be positive axial strains in ascending order");
    }

    // v = V y/H between a fixed lower platen and an upper one moving with V; the spin is that of the field.
    void start_loading(State &state, const Eigen::Vector2d &velocity, const bool affine)
    {
      const double bottom = state.walls[0].point.y(), height = state.walls[1].point.y() - bottom;
      for (std::size_t i = 0; i < state.grains.size(); ++i)
        {
          state.grains.rotation[i] = 0;
          state.grains.velocity[i] = affine ? Eigen::Vector2d(velocity * (state.grains.position[i].y() - bottom) / height)
                                            : Eigen::Vector2d::Zero();
          state.grains.spin[i]     = affine ? -0.5 * velocity.x() / height : 0.;
        }
      state.walls[1].velocity = velocity;
    }

    // A sample under way: its state, what has been summed up, and who listens.
    struct Course
    {
      State             &state;
      const StepSetting &setting;
      const Reference    reference;
      const Callbacks   &callbacks;
      Report            &report;
      HistoryRow         row    = {};
      StepResult         last   = {}; // of the last accepted step
      WindowForces       window = {};

      // One step, or the reason in `report` why there is none.
      void step(const double last_stage)
      {
        if (callbacks.stop_requested())
          {
            report.status = Status::stopped_by_user;
            return;
          }
        const State before = state;
        StepResult  result = advance(state, setting);
        report.solver_cpu_s += result.solve.cpu_s;
        report.sweeps += result.solve.sweeps;
        report.updates += result.solve.sweeps * long(result.contacts.size());
        if (result.solve.status != SolveStatus::converged)
          {
            report.status = Status::not_converged;
            std::ostringstream text;
            text << "step " << row.step + 1 << " at axial strain " << axial_strain(state, reference)
                 << " did not converge: residual " << result.solve.residual << " after " << result.solve.sweeps
                 << " sweeps, wanted " << setting.solver.tolerance;
            report.message = text.str();
            return;
          }
        ++report.steps;
        row = next_row(row, before, state, result, reference, setting);
        callbacks.on_step(row);
        window.add(result, spin_terms(state.grains), setting.time.step);
        callbacks.on_progress("loading the grains", row.axial_strain / last_stage);
        last = std::move(result);
      }

      // Snapshot of the last accepted step, with the means since the one before; nothing where there was no step.
      void hand_over()
      {
        if (window.time() == 0)
          return;
        callbacks.on_stage(make_snapshot(state, last, window, reference, setting));
        window.reset();
      }
    };
  } // namespace

  Report run(const SampleOptions &sample, const Loading &loading, const Options &options, const Callbacks &callbacks)
  {
    check(loading);
    Report         report;
    const double   start    = cpu_seconds();
    PreparedSample prepared = prepare_sample(
      sample, options.lateral, options.solver, loading.pressure, [&](const int step, const int expected) {
        callbacks.on_progress("preparing the sample", std::min(1., double(step) / expected));
        return !callbacks.stop_requested();
      });
    report.preparation       = prepared.report;
    report.preparation_cpu_s = cpu_seconds() - start;
    State &state             = prepared.state;

    const double d        = sample.mean_diameter;
    const double height   = state.walls[1].point.y() - state.walls[0].point.y();
    const double rate     = loading.inertial_number / d * std::sqrt(loading.pressure / sample.density);
    report.initial_height = height;
    report.platen_speed   = rate * height;

    StepSetting setting{options.time, options.law, options.solver, options.lateral, loading.pressure, d};
    setting.time.step = fitted_step(loading, options.time.step, rate);
    report.step       = setting.time.step;
    if (!prepared.report.quiet)
      {
        report.status = callbacks.stop_requested() ? Status::stopped_by_user : Status::not_converged;
        std::ostringstream text;
        text << "the sample was not quiet after " << prepared.report.steps << " preparation steps: residual "
             << prepared.report.residual << ", unbalanced force " << prepared.report.unbalanced_force;
        report.message = text.str();
        return report;
      }

    callbacks.on_stage(make_snapshot(state, prepared.last_step, WindowForces(), make_reference(state, d), setting));
    start_loading(state, {loading.horizontal_over_vertical * report.platen_speed, -report.platen_speed}, loading.affine_start);
    // Impulses scale with the step: those of the preparation become first guesses of the loading.
    for (PairImpulse &r : state.impulses)
      r.normal *= setting.time.step / sample.preparation_step, r.tangential *= setting.time.step / sample.preparation_step;

    Course course{state, setting, make_reference(state, d), callbacks, report};
    double from = 0;
    for (const double stage : loading.stages)
      {
        const long n_steps = std::lround((stage - from) / (rate * setting.time.step));
        for (long k = 0; k < n_steps && report.status == Status::finished; ++k)
          course.step(loading.stages.back());
        // Where the run ends early, the last accepted step is kept as an instant of its own.
        course.hand_over();
        if (report.status != Status::finished)
          break;
        from = stage;
      }
    report.axial_strain  = course.row.axial_strain;
    report.loading_cpu_s = cpu_seconds() - start - report.preparation_cpu_s;
    return report;
  }
} // namespace diptych::discrete
