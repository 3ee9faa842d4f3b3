// diptych: a grain sample between two platens, ready to be loaded
// SPDX-License-Identifier: LGPL-2.1-or-later
#include "discrete/samples/sample_preparation.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <random>
#include <stdexcept>

#include "discrete/bodies/outline.h"
#include "discrete/files/csv_file.h"
#include "discrete/samples/placed_grains.h"
#include "discrete/samples/sample_file.h"
#include "discrete/samples/settling.h"
#include "discrete/samples/soft_relaxation.h"
#include "discrete/samples/spring_compaction.h"
#include "discrete/samples/uniform_strain.h"

namespace diptych::discrete
{
  namespace
  {
    // The standard fixes the generator, but std::uniform_real_distribution may differ between libraries.
    double uniform(std::mt19937_64 &random)
    {
      return double(random() >> 11) * 0x1.0p-53;
    }

    // Radii in random order: the mean diameter is exact for every seed. [length]
    std::vector<double> radii(const SampleOptions &o, const int n, std::mt19937_64 &random)
    {
      std::vector<double> radius = sorted_radii(o, n);
      for (int k = n - 1; k > 0; --k)
        std::swap(radius[k], radius[int(uniform(random) * (k + 1))]);
      return radius;
    }

    // Random centres in a box with the height of the sample and the width that gives box_solid_fraction. With a periodic
    // width that is fixed, the height follows instead. Periodic sides have no side walls, and a lattice has no walls.
    State random_box(const SampleOptions &o, const LateralCondition &lateral)
    {
      std::mt19937_64           random(o.seed);
      const std::vector<double> radius   = radii(o, int(std::lround(expected_grains(o))), random);
      const double              area     = disc_area(radius);
      const Eigen::Vector2d     size     = sample_size(o, area);
      const auto               *periodic = std::get_if<PeriodicSides>(&lateral);
      const bool                is_fixed = periodic && !periodic->free_width;
      const double              width    = is_fixed ? size.x() : area / (o.box_solid_fraction * size.y());
      const double              height   = is_fixed ? area / (o.box_solid_fraction * size.x()) : size.y();

      State state;
      for (const double r : radius)
        {
          const double x = r + uniform(random) * (width - 2 * r), y = r + uniform(random) * (height - 2 * r);
          add_grain(state.grains, {x, y}, r, o.density);
        }
      enclose(state, lateral, {width, height});
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
      State sorted  = state;
      sorted.grains = {};
      for (const int i : order)
        add_grain(sorted.grains, g.position[i], g.radius[i], g.mass[i] / (M_PI * g.radius[i] * g.radius[i]));
      return sorted;
    }

    void bring_to_rest(State &state)
    {
      stop(state);
      for (Wall &wall : state.walls)
        wall.drive_x = wall.drive_y = KeptVelocity{};
      if (PeriodicWidth *width = state.width())
        width->pressure.reset();
      state.time = 0;
    }

    void roughen_platens(State &state)
    {
      Grains   &g = state.grains;
      const int n = int(g.size());
      for (int i = 0; i < n; ++i)
        for (int platen = 0; platen < 2; ++platen)
          if (make_contact(state, i, n + platen).gap < 0.2 * g.radius[i] && !g.fixed[i])
            g.fixed[i] = std::uint8_t(lower_platen_grain + platen);
      if (std::all_of(g.fixed.begin(), g.fixed.end(), [](const std::uint8_t fixed) { return fixed != 0; }))
        throw std::invalid_argument("sample/rough_platens = true: every grain touches a platen, and none remains free to move");
    }

    double step_of_preparation(const SampleOptions &o, const double pressure)
    {
      const double unit = pressure > 0 ? o.mean_diameter * std::sqrt(o.density / pressure) : 1; // of time
      return o.preparation_step.value_or(0.2 * unit);
    }

    StepSetting compaction_setting(const SampleOptions &options, const PreparationSetting &preparation, const double friction)
    {
      StepSetting setting;
      setting.step               = step_of_preparation(options, preparation.pressure);
      setting.stepping.gravity_x = preparation.gravity.x();
      setting.stepping.gravity_y = preparation.gravity.y();
      setting.law                = same_friction(friction);
      setting.solver             = preparation.solver;
      setting.solver.tolerance   = options.preparation_tolerance;
      setting.solver.max_sweeps  = options.preparation_max_sweeps;
      setting.lateral            = preparation.lateral;
      setting.pressure           = preparation.pressure;
      setting.mean_diameter      = options.mean_diameter;
      setting.accept_unconverged = true;
      return setting;
    }

    double solid_fraction(const State &state, const double mean_diameter)
    {
      return disc_area(state.grains.radius) / outline_area(make_outline(state, mean_diameter));
    }

    void move_until_quiet(PreparedSample              &sample,
                          const SampleOptions         &options,
                          const StepSetting           &setting,
                          StepCache                   &cache,
                          const std::function<bool()> &go_on)
    {
      PreparationReport &report = sample.report;
      while (!report.quiet && report.steps < 10 * options.preparation_steps && go_on())
        {
          sample.last_step        = advance(sample.state, setting, cache);
          report.residual         = sample.last_step.solve.residual;
          report.unbalanced_force = sample.last_step.unbalanced_force;
          ++report.steps;
          report.quiet = report.steps >= options.preparation_steps && report.residual <= options.preparation_tolerance &&
                         report.unbalanced_force <= options.quiet_unbalanced_force;
        }
    }

    PreparedSample compact_rigid(State                                start,
                                 const SampleOptions                 &options,
                                 StepSetting                          setting,
                                 const std::shared_ptr<ThreadTeam>   &team,
                                 const std::function<bool(int, int)> &progress)
    {
      const int          steps = options.preparation_steps;
      PreparedSample     sample{std::move(start), {}, setting.step, {}};
      PreparationReport &report     = sample.report;
      const auto         go_on      = [&] { return progress(report.steps, std::max(report.steps, steps)); };
      setting.solver.stop_requested = [&] { return !go_on(); };
      StepCache cache;
      cache.team = team;
      move_until_quiet(sample, options, setting, cache, go_on);
      if (!report.quiet)
        return sample;
      const SettlingOptions wanted{largest_prepared_overlap * options.mean_diameter, options.quiet_unbalanced_force, steps,
                                   10 * steps};
      Settled               settled = settle(sample.state, setting, wanted, go_on, team);
      report.quiet                  = settled.quiet;
      report.settling_steps         = settled.steps;
      report.largest_overlap        = settled.largest_overlap / options.mean_diameter;
      report.residual               = settled.last_step.solve.residual;
      report.unbalanced_force       = settled.last_step.unbalanced_force;
      sample.last_step              = std::move(settled.last_step);
      return sample;
    }

    PreparedSample compact(State                                start,
                           const SampleOptions                 &options,
                           const StepSetting                   &setting,
                           const std::shared_ptr<ThreadTeam>   &team,
                           const std::function<bool(int, int)> &progress)
    {
      PreparedSample sample        = has_far_sides(start, setting)
                                       ? compact_with_springs(std::move(start), options, setting, team, progress)
                                       : compact_rigid(std::move(start), options, setting, team, progress);
      sample.report.friction       = setting.law.friction;
      sample.report.solid_fraction = solid_fraction(sample.state, options.mean_diameter);
      return sample;
    }

    PreparedSample relaxed_and_compacted(const SampleOptions                 &options,
                                         const PreparationSetting            &preparation,
                                         const double                         friction,
                                         const std::function<bool(int, int)> &progress)
    {
      const StepSetting setting = compaction_setting(options, preparation, friction);
      const auto        go_on   = [&] { return progress(0, options.preparation_steps); };
      State             state   = random_box(options, preparation.lateral);
      if (is_large(state))
        state = numbered_upward(state);
      const double           overlap = has_far_sides(state, setting) ? 1e-2 : 1e-3; // springs can take up more
      const RelaxationReport loose   = relax_soft_discs(state, overlap * options.mean_diameter, 4000, go_on);
      PreparedSample         sample;
      if (loose.stopped)
        sample.state = std::move(state);
      else
        {
          state = numbered_upward(state);
          set_sides(state, preparation);
          sample = compact(std::move(state), options, setting, preparation.team, progress);
        }
      sample.report.soft_overlap = loose.largest_overlap;
      return sample;
    }

    std::string three_digits(const double value)
    {
      return exact_text(std::round(1e3 * value) / 1e3);
    }

    // Bisection: more friction gives a looser sample.
    PreparedSample at_solid_fraction(SampleOptions                        options,
                                     const PreparationSetting            &preparation,
                                     const std::function<bool(int, int)> &progress)
    {
      constexpr double tolerance = 0.002, loosest_friction = 1;
      constexpr int    most_tries = 12;
      const double     target     = options.target_solid_fraction;
      // The box must be looser than the target; below 0.6 soft discs carry nothing.
      double low = 0, high = loosest_friction, densest = 0, loosest = 1;
      bool   bracketed = false;
      for (const double box : {std::max(0.6, target - 0.04), 0.6})
        {
          options.box_solid_fraction = std::min(options.box_solid_fraction, box);
          for (const double friction : {low, high})
            {
              PreparedSample end = relaxed_and_compacted(options, preparation, friction, progress);
              if (std::abs(end.report.solid_fraction - target) <= tolerance || !end.report.quiet)
                return end;
              densest = std::max(densest, end.report.solid_fraction);
              loosest = std::min(loosest, end.report.solid_fraction);
            }
          bracketed = loosest < target && target < densest;
          if (bracketed || target > densest)
            break;
        }
      if (!bracketed)
        throw std::invalid_argument("sample/target_solid_fraction = " + three_digits(target) +
                                    " is out of reach: " + three_digits(loosest) + " to " + three_digits(densest) +
                                    " is the range for preparation friction between 0 and 1");
      for (int k = 0; k < most_tries; ++k)
        {
          const double   middle = k == 0 ? 0.2 : 0.5 * (low + high); // half of the range of solid fractions lies below 0.2
          PreparedSample sample = relaxed_and_compacted(options, preparation, middle, progress);
          if (std::abs(sample.report.solid_fraction - target) <= tolerance || !sample.report.quiet)
            return sample;
          (sample.report.solid_fraction > target ? low : high) = middle;
        }
      throw std::invalid_argument("sample/target_solid_fraction = " + three_digits(target) +
                                  ": no preparation friction between " + three_digits(low) + " and " + three_digits(high) +
                                  " gives it within " + three_digits(tolerance));
    }

    PreparedSample ready_sample(const SampleOptions                 &o,
                                const PreparationSetting            &preparation,
                                const std::function<bool(int, int)> &progress,
                                FileSample                           file)
    {
      State            &state   = file.state;
      const StepSetting setting = compaction_setting(o, preparation, o.preparation_friction);
      if (o.prepare_file)
        return compact(std::move(state), o, setting, preparation.team, progress);
      PreparedSample sample;
      sample.step = setting.step;
      if (file.stage)
        {
          state.impulses = file.stage->impulses;
          if (file.stage->step > 0)
            sample.step = file.stage->step;
        }
      sample.report.quiet          = true; // a sample from a file need not be at rest
      sample.report.solid_fraction = solid_fraction(state, o.mean_diameter);
      sample.last_step.contacts    = find_contacts(state, std::vector<double>(state.grains.size(), 0.));
      for (const Contact &c : sample.last_step.contacts)
        sample.report.largest_overlap = std::max(sample.report.largest_overlap, -c.gap / o.mean_diameter);
      sample.last_step.impulses.resize(sample.last_step.contacts.size());
      sample.last_step.wall_force.assign(state.walls.size(), Eigen::Vector2d::Zero());
      sample.last_step.applied_force = applied_forces(state, setting);
      sample.state                   = std::move(state);
      return sample;
    }
  } // namespace

  PreparedSample prepare_sample(const SampleOptions                 &options,
                                const PreparationSetting            &setting,
                                const std::function<bool(int, int)> &progress,
                                const Grains                        *grains)
  {
    validate(options);
    PreparedSample sample;
    if (grains != nullptr)
      sample = ready_sample(options, setting, progress, place_grains(options, setting, {"the sample", *grains, {}, {}}));
    else if (!options.file.empty())
      {
        std::optional<FileSample> file = file_sample(options, setting, [&] { return progress(0, 1); });
        if (!file)
          return sample;
        sample = ready_sample(options, setting, progress, std::move(*file));
      }
    else
      {
        sample = options.target_solid_fraction > 0
                   ? at_solid_fraction(options, setting, progress)
                   : relaxed_and_compacted(options, setting, options.preparation_friction, progress);
        bring_to_rest(sample.state);
      }
    PreparationReport &report = sample.report;
    report.touches = report.steps == 0 || carries_anything(sample.last_step, sample.state.grains.size(), setting.lateral);
    report.quiet   = report.quiet && report.touches;
    if (options.rough_platens)
      roughen_platens(sample.state);
    return sample;
  }
} // namespace diptych::discrete
