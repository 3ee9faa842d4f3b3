// diptych: options of the discrete panel, with their checks
// SPDX-License-Identifier: LGPL-2.1-or-later
#include "discrete/panel/options.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "discrete/files/csv_file.h"
#include "discrete/files/wrong_keys.h"

namespace diptych::discrete
{
  namespace
  {
    struct Unused
    {
      std::string             section;
      std::vector<UnusedKey> &keys;

      void unless(const bool read, const std::string &because, const std::vector<const char *> &names) const
      {
        for (const char *name : names)
          if (!read)
            keys.push_back({section + "/" + name, because});
      }
    };

    void add_unused(const SampleOptions &o, std::vector<UnusedKey> &keys)
    {
      const Unused      unused{"sample", keys};
      const bool        generated = o.file.empty(), prepared = generated || o.prepare_file;
      const std::string file = generated ? "sample/file is empty" : "sample/file = " + o.file;
      unused.unless(!generated, file,
                    {"lower_platen", "upper_platen", "left_wall", "right_wall", "allowed_overlap", "prepare_file"});
      unused.unless(generated, file,
                    {"grains", "radius_distribution", "radius_min", "radius_max", "radius_table", "width_over_height",
                     "solid_fraction", "box_solid_fraction", "target_solid_fraction"});
      unused.unless(prepared, "sample/prepare_file = false",
                    {"preparation_steps", "preparation_step", "preparation_tolerance", "preparation_max_sweeps",
                     "preparation_friction", "quiet_unbalanced_force"});
      unused.unless(!generated || !(o.width > 0 && o.height > 0), "sample/width and sample/height are given",
                    {"grains", "width_over_height"});
      unused.unless(!generated || o.radius_distribution != RadiusKind::table, "sample/radius_distribution = table",
                    {"radius_min", "radius_max"});
      unused.unless(!generated || !(o.target_solid_fraction > 0), "sample/target_solid_fraction is given",
                    {"preparation_friction"});
    }

    bool has_springs(const Options &o)
    {
      return o.method.method == Method::penalty || o.method.method == Method::compliant;
    }

    void add_unused(const Options &o, std::vector<UnusedKey> &keys)
    {
      const Unused      unused{"discrete", keys};
      const bool        penalty = o.method.method == Method::penalty, springs = has_springs(o);
      const std::string method  = "discrete/method = " + name_of(o.method.method),
                        lateral = "discrete/lateral = " + name_of(o.lateral.lateral);
      const bool moves          = o.lateral.lateral == Lateral::rigid_walls || o.lateral.lateral == Lateral::periodic;
      unused.unless(springs, method, {"penalty_stiffness", "penalty_damping", "penalty_preload"});
      unused.unless(penalty, method, {"penalty_step_fraction", "penalty_preload_friction"});
      unused.unless(!penalty || o.penalty.preload > 0, "discrete/penalty_preload = 0", {"penalty_preload_friction"});
      unused.unless(
        !penalty, method,
        {"step", "accuracy", "tolerance", "max_sweeps", "snapshot_accuracy", "snapshot_max_sweeps", "reference_sweeps"});
      unused.unless(!springs, method, {"penetration_correction"});
      unused.unless(penalty || !o.stepping.step || !o.accuracy.tolerance, "discrete/step and discrete/tolerance are given",
                    {"accuracy"});
      unused.unless(o.lateral.lateral == Lateral::end_grains, lateral, {"band_height", "end_grains"});
      unused.unless(o.lateral.lateral == Lateral::rigid_walls, lateral, {"wall_friction", "wall_rolling_friction"});
      unused.unless(o.lateral.lateral != Lateral::cell, lateral, {"platen_friction", "platen_rolling_friction"});
      unused.unless(moves, lateral, {"wall_mass"});
      unused.unless(o.solver.solver == ContactSolver::psor, "discrete/solver = " + name_of(o.solver.solver),
                    {"omega_sticking", "omega_slipping"});
      unused.unless(moves, lateral, {"side_motion", "side_velocity"});
      unused.unless(!moves || o.lateral.side_motion == SideMotion::velocity,
                    "discrete/side_motion = " + name_of(o.lateral.side_motion), {"side_velocity"});
      unused.unless(penalty || o.sampling.snapshot_max_sweeps > 0, "discrete/snapshot_max_sweeps = 0",
                    {"snapshot_accuracy", "reference_sweeps"});
    }

    void validate_cell(const SampleOptions &sample, const Loading &loading, const Options &options)
    {
      const bool cell = options.lateral.lateral == Lateral::cell, path = loading.mode == LoadingMode::path;
      if (cell != path)
        throw WrongKeys({"discrete/lateral", "loading/mode"}, "discrete/lateral = " + name_of(options.lateral.lateral) +
                                                                " does not go with loading/mode = " + name_of(loading.mode) +
                                                                ": a cell needs loading/mode = path, and a path a cell");
      if (!cell)
        return;
      validate(loading.path);
      if (const double end = loading.path.progress.back(); std::abs(loading.stages.back() - end) > 1e-9 * std::abs(end))
        throw WrongKeys({"loading/axial_strain", "loading/stages", "loading/path"},
                        "the last stage is at " + exact_text(loading.stages.back()) +
                          ", but the progress of loading/path ends at " + exact_text(end) +
                          ": leave out loading/axial_strain, or end there; without a column progress the rows count 0, 1, ...");
      for (const auto &[key, gravity] : {std::pair("discrete/gravity_y", options.stepping.gravity_y),
                                         std::pair("discrete/gravity_x", options.stepping.gravity_x)})
        if (gravity != 0)
          throw WrongKeys({key, "discrete/lateral"},
                          key + (" = " + exact_text(gravity)) +
                            ": nothing carries the weight of a cell, which has no bottom; leave it out");
      // As cell_obstacle() demands of the loading; discs fill 0.84 of a dense cell.
      const double grains = expected_grains(sample),
                   shape  = std::sqrt(std::min(sample.width_over_height, 1 / sample.width_over_height)),
                   side = shape * std::sqrt(0.25 * M_PI * grains / 0.84), least = 4 * (sample.radius_max + 0.5);
      if (sample.file.empty() && !(sample.width > 0 && sample.height > 0) && side < least)
        throw WrongKeys({"sample/grains", "sample/width_over_height", "discrete/lateral"},
                        "a cell of sample/grains = " + exact_text(grains) + " is only " + exact_text(std::round(10 * side) / 10) +
                          " mean diameters wide, but a grain must not meet two images of another one: give at least " +
                          exact_text(std::ceil(grains * least * least / (side * side))) + " grains");
      if (sample.rough_platens)
        throw WrongKeys({"sample/rough_platens", "discrete/lateral"}, "sample/rough_platens = true: a cell has no platens");
      if (options.method.store_problems)
        throw WrongKeys({"discrete/store_problems", "discrete/lateral"},
                        "discrete/store_problems = true: the files of contact problems cannot hold a cell");
      for_each_drive(options.drives, [](const int, int, const std::string &key, const DriveOption &drive) {
        if (!drive.is_auto())
          throw WrongKeys({"discrete/" + key, "discrete/lateral"},
                          "discrete/" + key + " = '" + text_of(drive) + "': a cell has neither platens nor walls");
      });
    }
  } // namespace

  std::vector<UnusedKey> unused_keys(const SampleOptions &sample, const Options &options)
  {
    std::vector<UnusedKey> keys;
    add_unused(sample, keys);
    add_unused(options, keys);
    const Lateral     lateral = options.lateral.lateral;
    const bool        of_file = !sample.file.empty(), sweeps = !of_file || sample.prepare_file;
    const std::string sides = "discrete/lateral = " + name_of(lateral);
    Unused{"sample", keys}.unless(lateral == Lateral::rigid_walls, sides, {"left_wall", "right_wall"});
    Unused{"sample", keys}.unless(!of_file || lateral == Lateral::cell, "sample/file with " + sides, {"height"});
    Unused{"sample", keys}.unless(!of_file || lateral == Lateral::periodic || lateral == Lateral::cell,
                                  "sample/file with " + sides, {"width"});
    Unused{"discrete", keys}.unless(options.method.method == Method::imported,
                                    "discrete/method = " + name_of(options.method.method), {"file"});
    Unused{"discrete", keys}.unless(options.method.method == Method::nscd || options.method.method == Method::compliant || sweeps,
                                    "discrete/method = penalty, and a sample from a file that is not prepared",
                                    {"solver", "omega_sticking", "omega_slipping", "sweeps_per_check"});
    return keys;
  }

  double expected_step(const SampleOptions &sample, const Loading &loading, const Options &options)
  {
    if (options.method.method == Method::imported)
      return 0;
    if (options.method.method != Method::penalty && options.stepping.step)
      return *options.stepping.step;
    if (!(loading.pressure > 0))
      return 0;
    if (options.method.method == Method::penalty)
      {
        Grains largest;
        add_grain(largest, {0, 0}, sample.mean_diameter, sample.density);
        return penalty_step(largest, options.penalty.stiffness * loading.pressure, options.penalty.step_fraction);
      }
    // Grains that yield under a lateral pressure P have t/s of about a third: s = (s1 + s2)/2 = P/(1 - t/s) = 1.5 P.
    const double stress   = (loading.mode == LoadingMode::descent ? 1.5 : 1) * loading.pressure;
    const double n_grains = sample.file.empty() ? expected_grains(sample) : 0;
    const double unit     = sample.mean_diameter * std::sqrt(sample.density / stress);
    const double rate     = loading.mode == LoadingMode::time ? 0 : strain_rate(loading, sample.mean_diameter, sample.density);
    return step_at_rest({n_grains, unit, options.lateral.lateral == Lateral::end_grains}, {stress, rate, options.accuracy}).step;
  }

  double expected_steps(const SampleOptions &sample, const Loading &loading, const Options &options)
  {
    const double step = expected_step(sample, loading, options);
    const double rate = strain_rate(loading, sample.mean_diameter, sample.density);
    const double time = loading.mode == LoadingMode::path ? times_of(loading.path, loading.pressure, rate).back()
                                                          : loading.stages.back() / rate;
    return step > 0 ? time / step : 0;
  }

  double expected_rows(const SampleOptions &sample, const Loading &loading, const Options &options)
  {
    const double steps = expected_steps(sample, loading, options);
    if (options.method.history_interval > 0)
      return steps / options.method.history_interval;
    return options.method.method == Method::penalty ? std::min(steps, 1000. * double(loading.stages.size())) : steps;
  }

  void validate(const SampleOptions &sample, const Loading &loading, const Options &options)
  {
    validate(sample);
    validate(options.drives);
    for_each_drive(options.drives, [&](const int wall, int, const std::string &key, const DriveOption &drive) {
      if (wall >= 2 && !drive.is_auto() && options.lateral.lateral != Lateral::rigid_walls)
        throw WrongKeys({"discrete/" + key, "discrete/lateral"},
                        "discrete/" + key + " = '" + text_of(drive) +
                          "': there is no such wall unless discrete/lateral = rigid_walls");
    });
    if (loading.stages.empty() || loading.stages.front() <= 0 ||
        std::adjacent_find(loading.stages.begin(), loading.stages.end(), std::greater_equal<double>()) != loading.stages.end())
      throw std::invalid_argument("the stages of the loading must be positive and in ascending order");
    if (loading.mode == LoadingMode::plane_shear && options.lateral.lateral != Lateral::periodic &&
        options.lateral.lateral != Lateral::rigid_walls)
      throw WrongKeys({"discrete/lateral", "loading/mode"},
                      "loading/mode = plane_shear: the normal force is normal_pressure x width, so discrete/lateral "
                      "must be periodic or rigid_walls, not " +
                        name_of(options.lateral.lateral));
    validate_cell(sample, loading, options);
    const bool        penalty = options.method.method == Method::penalty, springs = has_springs(options);
    const std::string method = "discrete/method = " + name_of(options.method.method);
    if (springs && (options.law.normal_restitution != 0 || options.law.tangential_restitution != 0))
      throw WrongKeys({"discrete/method", "discrete/normal_restitution", "discrete/tangential_restitution"},
                      method + ": discrete/normal_restitution and tangential_restitution must be 0; with springs, "
                               "penalty_damping controls the rebound");
    if (springs && options.method.store_problems)
      throw WrongKeys({"discrete/store_problems", "discrete/method"},
                      method + " has no problems of rigid contacts to store: discrete/store_problems must be false");
    if (const double steps = expected_steps(sample, loading, options); steps > most_steps)
      throw WrongKeys({"discrete/step", "discrete/accuracy", "discrete/penalty_stiffness", "discrete/penalty_step_fraction",
                       "loading/inertial_number", "loading/strain_rate"},
                      "the loading would take " + exact_text(std::ceil(steps)) + " steps, but at most 1e+09 are allowed: " +
                        (penalty ? "discrete/penalty_stiffness and penalty_step_fraction give the step"
                         : options.stepping.step
                           ? "discrete/step = " + exact_text(*options.stepping.step)
                           : "discrete/step = auto gives " + exact_text(expected_step(sample, loading, options)) +
                               " for discrete/accuracy = " + exact_text(options.accuracy.accuracy)) +
                        "; loading/inertial_number or strain_rate gives the duration");
    if (springs && !(loading.pressure > 0))
      throw WrongKeys({"loading/pressure", "discrete/method"},
                      method + ": the stiffness penalty_stiffness x loading/pressure must be positive");
  }

  Compliance compliance(const Loading &loading, const Options &options)
  {
    const bool compliant = options.method.method == Method::compliant;
    return {compliant ? options.penalty.stiffness * loading.pressure : 0, options.penalty.damping};
  }

  PreparationSetting preparation_setting(const Loading &loading, const Options &options)
  {
    return {lateral_condition(options.lateral),
            options.solver,
            loading.pressure,
            {options.stepping.gravity_x, options.stepping.gravity_y}};
  }
} // namespace diptych::discrete
