// diptych: samples during a loading; the benchmark solves their next contact problem
// SPDX-License-Identifier: LGPL-2.1-or-later
#include "benchmarks/contact_solver/sheared_states.h"

#include <cmath>
#include <filesystem>
#include <iostream>
#include <stdexcept>

#include "benchmarks/contact_solver/measuring.h"
#include "discrete/panel/checkpoint.h"
#include "discrete/stepping/grain_stress_error.h"
#include "discrete/stepping/step_problem.h"
#include "discrete/stepping/warm_start.h"

namespace diptych::benchmarks
{
  using namespace diptych::discrete;

  namespace
  {
    constexpr double axial_strain = 0.01;

    StepSetting setting_of(const LoadCase &load)
    {
      StepSetting setting;
      setting.step              = load.step;
      setting.lateral           = EndGrains{};
      setting.solver.tolerance  = load.tolerance;
      setting.solver.max_sweeps = 100000;
      return setting;
    }
  } // namespace

  Sheared start_shear(const int grains, const LoadCase &load)
  {
    SampleOptions options;
    options.grains          = grains;
    PreparedSample prepared = prepare_sample(options, {}, [](int, int) { return true; });
    Loading        loading;
    loading.inertial_number = load.inertial_number;
    start_loading(prepared.state, {loading, {}, {}, strain_rate(loading, options.mean_diameter, options.density)});
    for (PairImpulse &r : prepared.state.impulses)
      r.normal *= load.step / prepared.step, r.tangential *= load.step / prepared.step;
    return {std::move(prepared.state), setting_of(load)};
  }

  double strain_of_a_step(const LoadCase &load)
  {
    return load.inertial_number * load.step; // Mean diameter, density and pressure are 1.
  }

  StepResult advance(Sheared &sheared)
  {
    StepResult result = discrete::advance(sheared.state, sheared.setting, sheared.cache);
    if (result.solve.status != SolveStatus::converged)
      throw std::runtime_error("a step before the sheared state did not converge");
    return result;
  }

  Sheared sheared_state(const std::string &folder, const int grains, const LoadCase &load)
  {
    const std::string path = folder + "/" + load.name + "_" + std::to_string(grains) + ".h5";
    if (!folder.empty() && std::filesystem::exists(path))
      return {read_checkpoint(path).panel.state, setting_of(load)};
    std::cerr << "preparing " << grains << " discs in state " << load.name << std::endl;
    Sheared    sheared = start_shear(grains, load);
    const long n_steps = std::lround(axial_strain / strain_of_a_step(load));
    for (long k = 0; k < n_steps; ++k)
      (void)advance(sheared);
    if (!folder.empty())
      {
        std::filesystem::create_directories(folder);
        StoredCheckpoint checkpoint;
        checkpoint.panel.state     = sheared.state;
        checkpoint.panel.reference = make_reference(sheared.state, sheared.setting.mean_diameter, 0.);
        write_checkpoint(path, checkpoint);
      }
    return sheared;
  }

  NextStep next_step(const Sheared &sheared)
  {
    // The contacts of a step do not depend on how well it is solved, so one sweep is enough.
    StepSetting one_sweep        = sheared.setting;
    one_sweep.solver.max_sweeps  = 1;
    one_sweep.accept_unconverged = true;
    State    trial               = sheared.state;
    NextStep next;
    next.contacts = discrete::advance(trial, one_sweep).contacts;

    State middle = sheared.state;
    for (std::size_t i = 0; i < middle.grains.size(); ++i)
      middle.grains.position[i] += 0.5 * sheared.setting.step * middle.grains.velocity[i];
    for (Wall &wall : middle.walls)
      wall.point += 0.5 * sheared.setting.step * wall.velocity;
    const std::vector<BodyVelocity>    v     = body_velocities(middle);
    const std::vector<Eigen::Vector2d> force = applied_forces(middle, sheared.setting);
    next.problem                             = make_problem(middle, sheared.setting, next.contacts, v,
                                                            {free_velocities(middle, v, force, sheared.setting), {}, {}});
    next.radius                              = middle.grains.radius;
    next.guess                               = first_guess(middle.impulses, next.contacts).impulses;
    return next;
  }

  void MeasuredSolves::add(const NextStep &next, const SolverOptions &options)
  {
    std::vector<Impulse> r      = next.guess;
    const double         begin  = cpu_seconds();
    const SolveReport    report = solve(next.problem, options, r);
    seconds.push_back(cpu_seconds() - begin);
    sweeps.push_back(double(report.sweeps));
    residuals.push_back(report.residual);
    converged += report.status == SolveStatus::converged;
  }

  double stress_difference(const NextStep &step, const std::vector<Impulse> &impulses, const std::vector<Impulse> &exact)
  {
    return relative_difference(contact_moments(step.radius, step.contacts, impulses),
                               contact_moments(step.radius, step.contacts, exact));
  }
} // namespace diptych::benchmarks
