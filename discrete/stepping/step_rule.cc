// diptych: step length and tolerance, from forces, motion and accuracy
// SPDX-License-Identifier: LGPL-2.1-or-later
#include "discrete/stepping/step_rule.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace diptych::discrete
{
  namespace
  {
    double grain_density(const Grains &g)
    {
      double mass = 0, area = 0;
      for (std::size_t i = 0; i < g.size(); ++i)
        {
          mass += g.mass[i];
          area += M_PI * g.radius[i] * g.radius[i];
        }
      return mass / area;
    }

    // Demands of the tables and forces of walls: future speeds, intervals to resolve, accelerations from rest.
    struct DriveDemands
    {
      double speed = 0, interval = std::numeric_limits<double>::infinity(), acceleration = 0;
    };

    void add_table(const TimeTable &table, const bool is_velocity, const double mass, DriveDemands &demands)
    {
      for (const double value : table.value)
        if (is_velocity)
          demands.speed = std::max(demands.speed, std::abs(value));
        else
          demands.acceleration = std::max(demands.acceleration, std::abs(value) / mass);
      for (std::size_t k = 1; k < table.time.size(); ++k)
        demands.interval = std::min(demands.interval, table.time[k] - table.time[k - 1]);
    }

    DriveDemands drive_demands(const State &state)
    {
      DriveDemands demands;
      for (const Wall &wall : state.walls)
        for (const Drive *drive : {&wall.drive_x, &wall.drive_y})
          {
            if (const auto *velocity = std::get_if<PrescribedVelocity>(drive))
              add_table(velocity->velocity, true, wall.mass, demands);
            else if (const auto *force = std::get_if<AppliedForce>(drive))
              add_table(force->force, false, wall.mass, demands);
          }
      return demands;
    }

    constexpr double infinity = std::numeric_limits<double>::infinity();

    // Coefficients of the relative errors, as measured (benchmarks/rigid_limit, benchmarks/studies). The error of the strength is
    // the larger of two: it grows with the root of the step in units of d sqrt(rho/s), and in fast flow with the strain per step.
    // The error of the dilation grows with tolerance x step / I and with the step.
    constexpr double strength_of_root = 0.06, strength_of_strain = 55;
    constexpr double dilation_of_noise = 0.2, dilation_of_noise_and_step = 0.8;
    // Residuals add up along extended chains, so larger samples lose more, until all contacts of a region approach together.
    constexpr double grains_of_rule = 1000, power_of_grains = 0.75, grains_that_lose_most = 8000;
    // Beyond these limits the rule fails: half of the dilation is lost.
    constexpr double longest_loading_step = 0.4, coarsest_accuracy = 0.05;
    // The residual of a looser solve says nothing about its error.
    constexpr double loosest_tolerance = 1e-2;

    double accuracy_of(const FlowState &flow)
    {
      return std::min(flow.accuracy.accuracy, coarsest_accuracy);
    }

    double least_tolerance(const FlowState &flow)
    {
      return 1e-3 * accuracy_of(flow);
    }

    // d sqrt(rho/s); infinity without pressure.
    double unit_of_time(const State &state, const StepSetting &setting, const FlowState &flow)
    {
      const bool   end_grains = std::holds_alternative<EndGrains>(setting.lateral);
      const double stress     = std::max(flow.mean_stress, end_grains ? setting.pressure : 0.);
      return stress > 0 ? setting.mean_diameter * std::sqrt(grain_density(state.grains) / stress) : infinity;
    }

    double strength_error(const double step, const double unit, const double rate)
    {
      return std::max(strength_of_root * std::sqrt(step / unit), strength_of_strain * rate * step);
    }

    // Inverse of strength_error, and at most the longest step that keeps the dilation.
    double longest_step_for_strength(const double allowed, const double unit, const double rate)
    {
      const double root = allowed / strength_of_root;
      return std::min({root * root * unit, allowed / (strength_of_strain * rate), longest_loading_step * unit});
    }

    double size_factor(const double n_grains)
    {
      return std::pow(std::clamp(n_grains, grains_of_rule, grains_that_lose_most) / grains_of_rule, power_of_grains);
    }

    // Error for 1000 grains. `step` is in the unit of time, noise = tolerance x step / I.
    double dilation_error(const double step, const double noise)
    {
      return noise * (dilation_of_noise + dilation_of_noise_and_step * step);
    }

    // Step, in the unit of time, at which a tolerance causes the allowed error. `per_step`: noise / step.
    double longest_step(const double allowed, const double per_step)
    {
      const double a = dilation_of_noise_and_step, b = dilation_of_noise;
      return (std::sqrt(b * b + 4 * a * allowed / per_step) - b) / (2 * a);
    }

    double fastest(const State &state)
    {
      double speed = 0, squares = 0;
      for (const Wall &wall : state.walls)
        speed = std::max(speed, wall.velocity.norm());
      for (const Eigen::Vector2d &v : state.grains.velocity)
        squares += v.squaredNorm() / double(state.grains.size());
      return std::max(speed, 3 * std::sqrt(squares));
    }

    void bound(StepChoice &choice, const double step, const char *name)
    {
      if (step < choice.step)
        choice = {step, name};
    }
  } // namespace

  StepChoice choose_step(const State &state, const StepSetting &setting, const FlowState &flow)
  {
    const double       d          = setting.mean_diameter;
    const bool         end_grains = std::holds_alternative<EndGrains>(setting.lateral);
    const DriveDemands demands    = drive_demands(state);
    const double       speed      = std::max(fastest(state), demands.speed),
                 gravity          = std::hypot(setting.stepping.gravity_x, setting.stepping.gravity_y);

    StepChoice choice = step_at_rest({double(state.grains.size()), unit_of_time(state, setting, flow), end_grains}, flow);
    bound(choice, speed > 0 ? 0.1 * d / speed : infinity, "motion");
    bound(choice, demands.acceleration > 0 ? std::sqrt(0.1 * d / demands.acceleration) : infinity, "drives");
    bound(choice, 0.1 * demands.interval, "drives");
    bound(choice, gravity > 0 ? 0.3 * std::sqrt(d / gravity) : infinity, "gravity");
    return choice;
  }

  StepChoice step_at_rest(const SampleScales &sample, const FlowState &flow)
  {
    const double unit = sample.unit_of_time;
    StepChoice   choice{infinity, "none"};
    bound(choice, (sample.end_grains ? 1. : 5.) * unit, "forces");
    if (flow.rate > 0)
      bound(choice, longest_step_for_strength(accuracy_of(flow), unit, flow.rate), "strength");
    if (flow.rate > 0 && std::isfinite(unit))
      bound(choice,
            unit * longest_step(dilation_share * accuracy_of(flow) / size_factor(sample.n_grains),
                                flow.accuracy.tolerance.value_or(least_tolerance(flow)) / (flow.rate * unit)),
            "solver");
    return choice;
  }

  double choose_tolerance(const State &state, const StepSetting &setting, const FlowState &flow)
  {
    if (flow.accuracy.tolerance)
      return *flow.accuracy.tolerance;
    const double unit = unit_of_time(state, setting, flow);
    if (!(flow.rate > 0) || !std::isfinite(unit))
      return least_tolerance(flow);
    const double step = setting.step / unit;
    return std::min(loosest_tolerance, dilation_share * accuracy_of(flow) * flow.rate * unit /
                                         (size_factor(double(state.grains.size())) * step * dilation_error(step, 1)));
  }

  ExpectedErrors expected_errors(const State &state, const StepSetting &setting, const FlowState &flow)
  {
    const double unit = unit_of_time(state, setting, flow);
    if (!(flow.rate > 0) || !std::isfinite(unit))
      return {};
    const double step = setting.step / unit;
    return {strength_error(setting.step, unit, flow.rate),
            std::min(1., size_factor(double(state.grains.size())) *
                           dilation_error(step, setting.solver.tolerance * step / (flow.rate * unit)))};
  }
} // namespace diptych::discrete
