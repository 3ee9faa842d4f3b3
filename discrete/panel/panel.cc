// diptych: the discrete panel, a grain sample loaded through a list of stages
// SPDX-License-Identifier: LGPL-2.1-or-later
#include "discrete/panel/panel.h"

#include <cmath>
#include <stdexcept>

#include "discrete/contacts/internal_moment.h"
#include "discrete/panel/make_snapshot.h"
#include "discrete/panel/messages.h"
#include "discrete/panel/spring_press.h"
#include "discrete/panel/stopwatch.h"
#include "discrete/stepping/step_rule.h"

namespace diptych::discrete
{
  // A sample during preparation and loading. `now` holds everything that changes; the rest is constant.
  class Panel::Course
  {
  public:
    Course(const SampleOptions         &sample,
           const Loading               &loading,
           const Options               &options,
           Hooks                        hooks,
           const std::optional<Grains> &grains)
        : sample_(sample),
          loading_(loading),
          options_(options),
          hooks_(std::move(hooks)),
          grains_(grains),
          rate_(strain_rate(loading, sample.mean_diameter, sample.density))
    {
      validate(sample, loading, options);
      setting_.stepping      = options.stepping;
      setting_.law           = options.law;
      setting_.solver        = options.solver;
      setting_.lateral       = lateral_condition(options.lateral);
      setting_.pressure      = loading.pressure;
      setting_.mean_diameter = sample.mean_diameter;
      setting_.compliance    = compliance(loading, options);
      cache_.team = std::make_shared<ThreadTeam>(options.threads, hooks_.processes ? *hooks_.processes : only_process());
    }

    Checkpoint now;

    // Returns false if the sample did not come to rest.
    bool prepare()
    {
      const Stopwatch watch;
      Report         &report = now.report;
      const auto      go_on  = [&](const int step, const int expected) {
        show_progress("preparing the sample", std::min(1., double(step) / expected));
        return !stop_requested();
      };
      PreparationSetting setting = preparation_setting(loading_, options_);
      setting.team               = cache_.team;
      PreparedSample prepared    = prepare_sample(sample_, setting, go_on, grains_ ? &*grains_ : nullptr);
      if (prepared.state.grains.size() == 0)
        return fail(""); // stopped while the file was read
      now.state          = std::move(prepared.state);
      report.preparation = prepared.report;
      const bool ready   = (prepared.report.quiet || fail(unrest_text(report.preparation))) &&
                         (!presses(prepared) || press(prepared));
      report.preparation_cpu_s  = watch.cpu_s();
      report.preparation_wall_s = watch.wall_s();
      report.initial_height     = sample_height(now.state);
      report.platen_speed       = loading_.mode == LoadingMode::time ? 0 : rate_ * report.initial_height;
      if (!ready)
        return false;
      now.step = prepared.step; // length of the step that the impulses belong to
      StepSetting last;
      last.step          = prepared.step;
      last.law           = presses(prepared) && !penalty()
                             ? options_.law
                             : same_friction(presses(prepared) ? options_.penalty.preload_friction : prepared.report.friction);
      last.mean_diameter = setting_.mean_diameter;
      prepared_ = make_snapshot(now.state, prepared.last_step, {}, make_reference(now.state, setting_.mean_diameter, 0.), last);
      prepared_->loading_variable = loading_variable_of(loading_.mode);
      prepared_->time             = 0; // the time of the preparation does not count
      start_loading(now.state, loading_start());
      now.reference = make_reference(now.state, setting_.mean_diameter, loading_.mode == LoadingMode::time ? 0. : rate_);
      return true;
    }

    void resume(const Checkpoint &checkpoint)
    {
      now                       = checkpoint;
      setting_.step             = now.step;
      setting_.solver.tolerance = now.report.tolerance;
      set_drives(now.state, loading_start());
    }

    void load_to_stage(const int stage)
    {
      if (now.report.status == Status::stopped_by_user)
        now.report.status = Status::finished; // the run continues after a stop
      while (now.stage < stage && now.report.status == Status::finished)
        {
          if (now.steps_left == 0 && !plan_stage())
            return;
          while (now.steps_left > 0 && now.report.status == Status::finished)
            {
              if (hooks_.before_step)
                hooks_.before_step();
              if (stop_requested())
                now.report.status = Status::stopped_by_user;
              else
                step();
            }
          if (now.report.status == Status::finished)
            ++now.stage;
        }
    }

    bool has_snapshot() const { return prepared_ || (now.window.time > 0 && last_step_ > 0); }

    Snapshot snapshot() const
    {
      if (prepared_)
        return *prepared_;
      StepSetting setting          = setting_;
      setting.step                 = last_step_;
      Snapshot snapshot            = make_snapshot(now.state, last_, now.window, now.reference, setting);
      snapshot.error_over_residual = now.report.error_over_residual;
      snapshot.progress            = now.report.progress;
      snapshot.loading_variable    = loading_variable_of(loading_.mode);
      return snapshot;
    }

  private:
    LoadingStart loading_start() const { return {loading_, options_.lateral, options_.drives, rate_}; }

    bool stop_requested() const { return hooks_.stop_requested && hooks_.stop_requested(); }
    bool penalty() const { return options_.method.method == Method::penalty; }
    bool springs() const { return penalty() || setting_.compliance.stiffness > 0; }

    // Springs of a file may be under stress already.
    bool presses(const PreparedSample &prepared) const
    {
      return springs() && (penalty() || prepared.report.steps > 0) && loading_.mode != LoadingMode::time &&
             options_.penalty.preload > 0;
    }

    // Compresses the springs. Returns false if it was stopped or the springs blew up.
    bool press(PreparedSample &prepared)
    {
      const LoadingStart start = loading_start();
      auto pressed = press_springs(now.state, {options_.penalty, start, setting_, sample_.density, prepared, cache_.team},
                                   [this](const double share) {
                                     show_progress("pressing the springs", share);
                                     return !stop_requested();
                                   });
      if (!pressed || pressed->last_step.solve.status == SolveStatus::blown_up)
        return fail(pressed ? press_text(options_) : "");
      prepared.last_step = std::move(pressed->last_step);
      prepared.step      = pressed->step;
      return true;
    }

    void show_progress(const std::string &phase, const double fraction) const
    {
      if (hooks_.on_progress)
        hooks_.on_progress(phase, fraction);
    }

    bool fail(const std::string &message)
    {
      now.report.status  = stop_requested() ? Status::stopped_by_user : Status::not_converged;
      now.report.message = message;
      return false;
    }

    // Plans the next stage: a whole number of steps and a new window. Returns false if there are too many steps.
    bool plan_stage()
    {
      prepared_.reset();
      now.window.reset();
      const double from     = now.stage == 0 ? 0. : loading_.stages[now.stage - 1];
      const double duration = duration_between(now.state, loading_, rate_, from, loading_.stages[now.stage]);
      const double wanted   = wanted_step();
      if (duration / wanted > most_steps)
        return fail(endless_text(now.stage + 1, duration / wanted, {wanted, now.report.step_bound}));
      now.steps_left      = std::max(1L, long(std::ceil(duration / wanted - 1e-9)));
      const double fitted = duration / double(now.steps_left);
      if (now.step > 0)
        scale_impulses(now.state, fitted / now.step);
      springs_.impulse_step = fitted;
      now.step = setting_.step = now.report.step = fitted;
      if (!penalty())
        set_tolerance();
      now.interval = options_.method.history_interval > 0 ? options_.method.history_interval
                     : penalty()                          ? std::max(1L, now.steps_left / 1000)
                                                          : 1;
      return true;
    }

    double wanted_step()
    {
      if (penalty())
        return penalty_step(now.state.grains, options_.penalty.stiffness * loading_.pressure, options_.penalty.step_fraction);
      if (options_.stepping.step)
        return *options_.stepping.step;
      const StepChoice choice = choose_step(now.state, setting_, flow());
      if (!std::isfinite(choice.step))
        throw std::invalid_argument("discrete/step = auto needs motion or pressure, and there is neither: give a discrete/step");
      now.report.step_bound = choice.bound;
      return choice.step;
    }

    FlowState flow() const
    {
      return {now.row.step > 0 ? 0.5 * now.row.stress.trace() : loading_.pressure, loading_.mode == LoadingMode::time ? 0 : rate_,
              options_.accuracy};
    }

    void set_tolerance()
    {
      setting_.solver.tolerance = now.report.tolerance = choose_tolerance(now.state, setting_, flow());
      note(now.report, expected_errors(now.state, setting_, flow()));
    }

    StepResult next()
    {
      if (penalty())
        return advance_penalty(now.state, springs_, setting_, options_.penalty);
      SampleRequest request{options_.sampling, std::isnan(now.report.reference_residual)};
      if (options_.method.store_problems && hooks_.on_problem)
        request.on_problem = [this](const ContactProblem &problem, const std::vector<Contact> &contacts,
                                    const std::vector<Impulse> &r) {
          hooks_.on_problem(now.stage + 1, problem, stored_geometry(now.state.grains, contacts, setting_.step), r);
        };
      return advance(now.state, setting_, cache_, now.steps_left == 1 ? &request : nullptr);
    }

    // Impulses act in pairs, so an error above round-off is a fault of the program.
    void check_momentum(const double residual) const
    {
      if (constexpr double round_off = 1e-10; residual > round_off)
        throw std::logic_error(momentum_text(now.row.step + 1, residual));
    }

    bool note_failure(const SolveReport &solve)
    {
      now.report.status  = Status::not_converged;
      now.report.message = failure_text({now.row.step + 1, text_of(loading_variable_of(loading_.mode), now.report.progress),
                                         solve, setting_.solver.tolerance, setting_.step},
                                        loading_, options_);
      return false;
    }

    // Between prescribed walls that cannot give way, rigid grains are forced into each other; springs may be too soft.
    bool interpenetrate(const double penetration)
    {
      constexpr double limit = 0.3; // mean diameters
      return penetration > limit && !fail(interpenetration_text(now.row.step, penetration, options_));
    }

    // Takes a step. If the sweeps stall, takes two halves, and these in halves again. Each half is another problem, and it mostly
    // converges. Returns false, with the reason in the report, if the smallest step does not converge either. On return the
    // impulses of the state are those of a step of length h.
    bool advance_by(const double h, const int halvings)
    {
      setting_.step     = h;
      StepResult result = next();
      now.report.solver_cpu_s += result.solve.cpu_s;
      now.report.sweeps += result.solve.sweeps;
      now.report.updates += result.solve.sweeps * long(result.contacts.size());
      if (result.solve.status == SolveStatus::converged)
        {
          check_momentum(result.momentum_residual);
          add_step(result, setting_, now.row);
          now.window.add(result, spin_terms(now.state.grains), h);
          if (result.accuracy)
            note(now.report, *result.accuracy);
          last_      = std::move(result);
          last_step_ = h;
          return !interpenetrate(last_.largest_penetration / setting_.mean_diameter);
        }
      if (halvings == 0)
        return note_failure(result.solve);
      ++now.report.halved_steps;
      scale_impulses(now.state, 0.5);
      const bool done = advance_by(0.5 * h, halvings - 1) && advance_by(0.5 * h, halvings - 1);
      scale_impulses(now.state, 2);
      return done;
    }

    void step()
    {
      constexpr int   most_halvings = 3;
      const Stopwatch watch;
      const bool      done = advance_by(now.step, penalty() ? 0 : most_halvings);
      now.report.loading_cpu_s += watch.cpu_s();
      note_costs(now.report);
      const Strains strains   = strains_of(now.state, now.reference);
      now.report.axial_strain = strains.axial;
      now.report.shear_strain = strains.shear;
      now.report.progress     = loading_progress(now.state, loading_, now.reference.platen, now.reference.height);
      auto obstacle           = cell_obstacle(now.state, loading_, sample_.mean_diameter, sample_.density);
      if (!obstacle && done && !springs())
        obstacle = rigid_obstacle(loading_, last_, sample_.mean_diameter);
      if (!done || (obstacle && !fail(*obstacle)))
        return;
      ++now.report.steps;
      --now.steps_left;
      if (now.steps_left % now.interval == 0)
        {
          describe_state(now.state, last_, now.reference, setting_, now.row);
          now.row.progress         = now.report.progress;
          now.row.loading_variable = loading_variable_of(loading_.mode);
          if (hooks_.on_row)
            hooks_.on_row(now.row);
          now.row.max_penetration = now.row.momentum_residual = now.row.sweeps = 0;
        }
      show_progress("loading the grains", now.report.progress / loading_.stages.back());
    }

    const SampleOptions         sample_;
    const Loading               loading_;
    const Options               options_;
    const Hooks                 hooks_;
    const std::optional<Grains> grains_;
    const double                rate_;
    StepSetting                 setting_;
    StepCache                   cache_;
    PenaltyState                springs_;
    StepResult                  last_;
    double                      last_step_ = 0; // its length
    std::optional<Snapshot>     prepared_;      // until the first step
  };

  Panel::Panel(const SampleOptions         &sample,
               const Loading               &loading,
               const Options               &options,
               Hooks                        hooks,
               const std::optional<Grains> &grains)
      : course(std::make_unique<Course>(sample, loading, options, std::move(hooks), grains))
  {}

  Panel::~Panel()                            = default;
  Panel::Panel(Panel &&) noexcept            = default;
  Panel &Panel::operator=(Panel &&) noexcept = default;

  Status Panel::prepare()
  {
    (void)course->prepare(); // the report gives the reason of a failure
    return course->now.report.status;
  }

  void Panel::resume(const Checkpoint &checkpoint)
  {
    course->resume(checkpoint);
  }

  Status Panel::advance_to(const int stage)
  {
    course->load_to_stage(stage);
    return course->now.report.status;
  }

  Snapshot Panel::snapshot() const
  {
    return course->snapshot();
  }

  bool Panel::has_snapshot() const
  {
    return course->has_snapshot();
  }

  Checkpoint Panel::checkpoint() const
  {
    Checkpoint checkpoint    = course->now;
    checkpoint.report.status = Status::finished;
    checkpoint.report.message.clear();
    return checkpoint;
  }

  const Report &Panel::report() const
  {
    return course->now.report;
  }

  int Panel::stage() const
  {
    return course->now.stage;
  }

  const Reference &Panel::reference() const
  {
    return course->now.reference;
  }
} // namespace diptych::discrete
