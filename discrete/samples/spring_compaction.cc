// diptych: compaction of a large sample whose contacts are springs at first
// SPDX-License-Identifier: LGPL-2.1-or-later
#include "discrete/samples/spring_compaction.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "discrete/samples/settling.h"
#include "discrete/samples/uniform_strain.h"

namespace diptych::discrete
{
  namespace
  {
    // A stage ends when the unbalanced force, as a share of sample/quiet_unbalanced_force, and the largest overlap [mean
    // diameters] are this small, and the pressure is this even (SideStress). Between two stages the pressure rises as the
    // stiffness does, and so do the differences between parts of the sample.
    struct Stage
    {
      double stiffness, unbalanced_force, overlap, evenness; // stiffness: kn/P
    };

    constexpr double longest_step = 0.5; // d sqrt(rho/P); end grains are unstable in steps of 1

    // Way of a wave in a step. [mean diameters]
    double reach(const State &state, const double mean_diameter)
    {
      return std::max(8., box_around(state.grains).sizes().maxCoeff() / (25 * mean_diameter));
    }

    // On springs of kn/P = 1e3 the grains find their places. The next ones are as soft as their waves, in the longest step, come
    // far enough; they even out distant parts. The ratio of stiffnesses is then small enough for what the overlaps set free.
    std::array<Stage, 4> stages(const double reach)
    {
      constexpr double softest = 1e3, stiffest = 2e5;
      const double     even = std::clamp(std::pow(reach / longest_step, 2), softest, stiffest);
      return {Stage{softest, 0.08, 1, 0.85},
              {even, 0.12, 1, 0.85},
              {std::sqrt(even * stiffest), 0.2, 1, 0.7},
              {stiffest, 0.15, largest_prepared_overlap, 0.85}};
    }

    void take_springs(StepSetting &setting, const SampleOptions &options, const double stiffness, const State &state)
    {
      constexpr double tolerance = 1e-4, damping = 0.5;
      const double     unit    = setting.mean_diameter * std::sqrt(options.density / setting.pressure);
      const double     step    = step_on_springs(stiffness, state, setting.mean_diameter) * unit;
      setting.compliance       = {stiffness * setting.pressure, damping};
      setting.step             = options.preparation_step ? std::min(step, *options.preparation_step) : step;
      setting.solver.tolerance = std::min(setting.solver.tolerance, tolerance);
    }

    bool rests(const PreparationReport &report, const Stage &stage, const StepSetting &setting, const SampleOptions &options)
    {
      return report.residual <= setting.solver.tolerance &&
             report.unbalanced_force <= stage.unbalanced_force * options.quiet_unbalanced_force &&
             report.largest_overlap <= stage.overlap;
    }
  } // namespace

  double step_on_springs(const double stiffness, const State &state, const double mean_diameter)
  {
    return std::min(longest_step, reach(state, mean_diameter) / std::sqrt(stiffness));
  }

  PreparedSample compact_with_springs(State                                start,
                                      const SampleOptions                 &options,
                                      StepSetting                          setting,
                                      const std::shared_ptr<ThreadTeam>   &team,
                                      const std::function<bool(int, int)> &progress)
  {
    constexpr int      expected_steps = 200;
    PreparedSample     sample{std::move(start), {}, 0, {}};
    State             &state      = sample.state;
    PreparationReport &report     = sample.report;
    const auto         go_on      = [&] { return progress(report.steps, std::max(report.steps, expected_steps)); };
    setting.solver.stop_requested = [&] { return !go_on(); };
    StepCache cache;
    cache.team = team;
    SideStress stress;
    for (const Stage &stage : stages(reach(state, setting.mean_diameter)))
      {
        const double softer = setting.compliance.stiffness;
        take_springs(setting, options, stage.stiffness, state);
        stop(state);
        if (report.steps > 0)
          {
            scale_impulses(state, setting.step / sample.step);
            // The stiffer springs would push the grains apart. The sample gives way by half of that at once, or it would swing.
            stress.mean *= (1 + setting.compliance.stiffness / softer) / 2;
            strain_sample(elastic_strain(stress, setting.compliance.stiffness), state, cache);
          }
        StressServo servo;
        sample.step  = setting.step;
        report.quiet = false;
        for (int k = 0; k < 10 * options.preparation_steps && go_on(); ++k)
          {
            sample.last_step        = advance(state, setting, cache);
            const StepResult &step  = sample.last_step;
            report.residual         = step.solve.residual;
            report.unbalanced_force = step.unbalanced_force;
            report.largest_overlap  = step.largest_penetration / setting.mean_diameter;
            ++report.steps;
            stress              = side_stress(state, step, setting);
            report.evenness     = stress.evenness;
            report.stress_error = stress.error();
            report.quiet        = rests(report, stage, setting, options) && stress.is_reached(stage.evenness);
            if (report.quiet)
              break;
            servo.approach(stress, setting.compliance.stiffness, state, cache);
          }
      }
    stop(state);
    return sample;
  }
} // namespace diptych::discrete
