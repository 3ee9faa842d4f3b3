// diptych: a dense grain sample between two platens, ready to be loaded
// SPDX-License-Identifier: LGPL-2.1-or-later
#include "discrete/sample_preparation.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <random>
#include <stdexcept>

#include "discrete/outline.h"
#include "discrete/soft_relaxation.h"

namespace diptych::discrete
{
  namespace
  {
    // std::uniform_real_distribution may differ between libraries; 53 bits of the generator do not.
    double uniform(std::mt19937_64 &random)
    {
      return double(random() >> 11) * 0x1.0p-53;
    }

    // Quantiles of the uniform distribution in random order: the mean diameter is exact for every seed.
    std::vector<double> radii(const SampleOptions &o, std::mt19937_64 &random)
    {
      std::vector<double> radius(o.grains);
      for (int k = 0; k < o.grains; ++k)
        radius[k] = o.mean_diameter * (o.radius_min + (o.radius_max - o.radius_min) * (k + 0.5) / o.grains);
      for (int k = o.grains - 1; k > 0; --k)
        std::swap(radius[k], radius[int(uniform(random) * (k + 1))]);
      return radius;
    }

    // Random centres in the box; walls: below, above, left, right.
    State random_box(const SampleOptions &o)
    {
      std::mt19937_64           random(o.seed);
      const std::vector<double> radius = radii(o, random);
      double                    area   = 0;
      for (const double r : radius)
        area += M_PI * r * r;
      const double height = std::sqrt(area / (o.solid_fraction * o.width_over_height));
      const double width  = area / (o.box_solid_fraction * height);

      State state;
      for (const double r : radius)
        {
          const double x = r + uniform(random) * (width - 2 * r), y = r + uniform(random) * (height - 2 * r);
          add_grain(state.grains, {x, y}, r, o.density);
        }
      state.walls = {{{0, 0}, {0, 1}}, {{0, height}, {0, -1}}, {{0, 0}, {1, 0}}, {{width, 0}, {-1, 0}}};
      return state;
    }

    State numbered_upward(const State &state)
    {
      const Grains    &g = state.grains;
      std::vector<int> order(g.size());
      std::iota(order.begin(), order.end(), 0);
      std::sort(order.begin(), order.end(), [&](const int a, const int b) {
        return g.position[a].y() != g.position[b].y() ? g.position[a].y() < g.position[b].y() : a < b;
      });
      State sorted;
      sorted.walls = state.walls;
      for (const int i : order)
        add_grain(sorted.grains, g.position[i], g.radius[i], g.mass[i] / (M_PI * g.radius[i] * g.radius[i]));
      return sorted;
    }

    double solid_fraction(const State &state, const double mean_diameter)
    {
      double area = 0;
      for (const double r : state.grains.radius)
        area += M_PI * r * r;
      return area / outline_area(make_outline(state, mean_diameter));
    }

    StepSetting compaction_setting(const SampleOptions  &options,
                                   const LateralOptions &lateral,
                                   const SolverOptions  &solver,
                                   const double          pressure)
    {
      StepSetting setting;
      setting.time.step          = options.preparation_step;
      setting.law                = {0., 0., 0., 0.};
      setting.solver             = solver;
      setting.solver.tolerance   = options.preparation_tolerance;
      setting.solver.max_sweeps  = options.preparation_max_sweeps;
      setting.lateral            = lateral;
      setting.pressure           = pressure;
      setting.mean_diameter      = options.mean_diameter;
      setting.accept_unconverged = true;
      return setting;
    }
  } // namespace

  void validate(const SampleOptions &o)
  {
    if (std::abs(o.radius_min + o.radius_max - 1) > 1e-9)
      throw std::invalid_argument("sample/radius_min + sample/radius_max is " + std::to_string(o.radius_min + o.radius_max) +
                                  " mean diameters; it must be 1, so that radii uniform by number have the mean diameter 1");
    if (o.box_solid_fraction > o.solid_fraction)
      throw std::invalid_argument("sample/box_solid_fraction " + std::to_string(o.box_solid_fraction) +
                                  " exceeds sample/solid_fraction " + std::to_string(o.solid_fraction));
  }

  double unbalanced_force(const State &before, const State &after, const StepResult &result, const double step)
  {
    double unbalanced = 0, contact = 0;
    int    closed = 0;
    for (std::size_t i = 0; i < after.grains.size(); ++i)
      unbalanced += after.grains.mass[i] * (after.grains.velocity[i] - before.grains.velocity[i]).norm() / step;
    for (const Impulse &r : result.impulses)
      if (r.normal > 0)
        contact += r.normal / step, ++closed;
    return closed > 0 ? (unbalanced / after.grains.size()) / (contact / closed) : 0;
  }

  PreparedSample prepare_sample(const SampleOptions                 &options,
                                const LateralOptions                &lateral,
                                const SolverOptions                 &solver,
                                const double                         pressure,
                                const std::function<bool(int, int)> &progress)
  {
    validate(options);
    PreparedSample sample;
    sample.state               = random_box(options);
    sample.report.soft_overlap = relax_soft_discs(sample.state, 1e-3 * options.mean_diameter, 4000).largest_overlap;
    sample.state.walls.resize(2);
    sample.state = numbered_upward(sample.state);

    const StepSetting  setting = compaction_setting(options, lateral, solver, pressure);
    PreparationReport &report  = sample.report;
    while (!report.quiet && report.steps < 10 * options.preparation_steps && progress(report.steps, options.preparation_steps))
      {
        const State before      = sample.state;
        sample.last_step        = advance(sample.state, setting);
        report.residual         = sample.last_step.solve.residual;
        report.unbalanced_force = unbalanced_force(before, sample.state, sample.last_step, setting.time.step);
        ++report.steps;
        report.quiet = report.steps >= options.preparation_steps && report.residual <= options.preparation_tolerance &&
                       report.unbalanced_force <= options.quiet_unbalanced_force;
      }
    report.solid_fraction = solid_fraction(sample.state, options.mean_diameter);
    sample.state.time     = 0;
    return sample;
  }
} // namespace diptych::discrete
