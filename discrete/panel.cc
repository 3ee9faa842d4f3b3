// diptych: the discrete panel, a grain sample loaded through a list of stages
// SPDX-License-Identifier: LGPL-2.1-or-later
#include "discrete/panel.h"

#include <algorithm>
#include <cmath>
#include <ctime>
#include <sstream>
#include <stdexcept>

#include "discrete/internal_moment.h"
#include "discrete/make_snapshot.h"
#include "discrete/step_rule.h"

namespace diptych::discrete
{
  namespace
  {
    double cpu_seconds()
    {
      return double(std::clock()) / CLOCKS_PER_SEC;
    }

    void scale_impulses(State &state, const double factor)
    {
      if (factor == 1)
        return;
      for (PairImpulse &r : state.impulses)
        r.normal *= factor, r.tangential *= factor;
    }

    // A sample under way: what changes is in `now`, the rest stays.
    class Course
    {
    public:
      Course(const SampleOptions &sample,
             const Loading       &loading,
             const Options       &options,
             const Callbacks     &callbacks,
             Progress             progress)
          : now(std::move(progress)),
            loading_(loading),
            options_(options),
            callbacks_(callbacks),
            rate_(strain_rate(loading, sample.mean_diameter, sample.density))
      {
        setting_.time          = options.time;
        setting_.law           = options.law;
        setting_.solver        = options.solver;
        setting_.lateral       = lateral_condition(options.lateral);
        setting_.pressure      = loading.pressure;
        setting_.mean_diameter = sample.mean_diameter;
        setting_.step          = now.step;
        cache_.team            = std::make_shared<ThreadTeam>(options.threads);
      }

      Progress now;

      const StepSetting &setting() const { return setting_; }
      double             rate() const { return rate_; }

      // Chooses the step of the next stage, in whole numbers.
      void plan_stage()
      {
        const double from     = now.stage == 0 ? 0. : loading_.stages[now.stage - 1];
        const double duration = (loading_.stages[now.stage] - from) / rate_;
        const double wanted   = wanted_step();
        now.steps_left        = std::max(1L, long(std::ceil(duration / wanted - 1e-9)));
        const double fitted   = duration / double(now.steps_left);
        if (now.step > 0)
          scale_impulses(now.state, fitted / now.step);
        springs_.impulse_step = fitted;
        now.step = setting_.step = now.report.step = fitted;
        now.interval                               = options_.method.history_interval > 0 ? options_.method.history_interval
                                                     : penalty()                          ? std::max(1L, now.steps_left / 1000)
                                                                                          : 1;
      }

      void load_to_stage()
      {
        while (now.steps_left > 0 && now.report.status == Status::finished)
          {
            const bool stop = callbacks_.stop_requested();
            if (stop)
              now.report.status = Status::stopped_by_user;
            if (stop || callbacks_.checkpoint_due())
              hand_checkpoint();
            if (!stop)
              step();
          }
      }

      // Snapshot of the last accepted step, with the means since the one before; nothing where there was no step.
      void hand_over()
      {
        if (now.window.time == 0 || last_step_ == 0)
          return;
        StepSetting setting          = setting_;
        setting.step                 = last_step_;
        Snapshot snapshot            = make_snapshot(now.state, last_, now.window, now.reference, setting);
        snapshot.error_over_residual = now.report.error_over_residual;
        callbacks_.on_stage(snapshot);
      }

    private:
      bool penalty() const { return options_.method.method == "penalty"; }

      double wanted_step()
      {
        if (penalty())
          return penalty_step(now.state.grains, options_.penalty.stiffness * loading_.pressure, options_.penalty.step_fraction);
        if (options_.time.step)
          return *options_.time.step;
        const double     rate   = loading_.mode == LoadingMode::time ? 0 : rate_;
        const double     stress = now.row.step > 0 ? 0.5 * now.row.stress.trace() : loading_.pressure;
        const StepChoice choice = choose_step(now.state, setting_, stress, rate);
        if (!std::isfinite(choice.step))
          throw std::invalid_argument("discrete/step = auto: nothing moves and nothing presses, so no step follows; give one");
        now.report.step_bound = choice.bound;
        return choice.step;
      }

      void hand_checkpoint()
      {
        Progress copy      = now;
        copy.report.status = Status::finished;
        callbacks_.on_checkpoint(copy);
      }

      StepResult next()
      {
        if (penalty())
          return advance_penalty(now.state, springs_, setting_, options_.penalty);
        SampleRequest request{options_.sampling, std::isnan(now.report.reference_residual)};
        if (options_.method.store_problems && callbacks_.on_problem)
          request.on_problem = [this](const ContactProblem &problem, const std::vector<Contact> &contacts,
                                      const std::vector<Impulse> &r) { store(problem, contacts, r); };
        return advance(now.state, setting_, cache_, now.steps_left == 1 ? &request : nullptr);
      }

      void store(const ContactProblem &problem, const std::vector<Contact> &contacts, const std::vector<Impulse> &impulses) const
      {
        // Contacts were found at mid-step.
        const Grains  &g = now.state.grains;
        StoredGeometry geometry{setting_.step, {}, g.radius, g.position};
        for (std::size_t i = 0; i < g.size(); ++i)
          geometry.position[i] += 0.5 * setting_.step * g.velocity[i];
        for (const Contact &c : contacts)
          geometry.gap.push_back(c.gap);
        callbacks_.on_problem(now.stage + 1, problem, geometry, impulses);
      }

      void note_accuracy(const SampledAccuracy &accuracy)
      {
        ++now.report.snapshots_sampled;
        now.report.snapshots_accurate += accuracy.reached;
        if (std::isnan(accuracy.reference_residual))
          return;
        now.report.error_over_residual = accuracy.error_over_residual;
        now.report.reference_residual  = accuracy.reference_residual;
        now.report.reference_error     = accuracy.true_error;
        now.report.estimated_error     = accuracy.stress_error;
      }

      // Impulses are given and taken in pairs: more than round-off means that the program is wrong.
      void check_momentum(const double residual) const
      {
        constexpr double round_off = 1e-10;
        if (residual <= round_off)
          return;
        std::ostringstream text;
        text << "the balance of momentum is violated in step " << now.row.step + 1 << ": " << residual
             << " of the contact impulses, more than round-off";
        throw std::logic_error(text.str());
      }

      void note_failure(const SolveReport &solve)
      {
        now.report.status = Status::not_converged;
        std::ostringstream text;
        text << "step " << now.row.step + 1 << " at axial strain " << now.report.axial_strain;
        if (penalty())
          text << " blew up: a grain went further than its radius in one step, penalty_step_fraction is "
               << options_.penalty.step_fraction;
        else
          text << " did not converge: residual " << solve.residual << " after " << solve.sweeps << " sweeps, wanted "
               << setting_.solver.tolerance << ", nor did its halves, down to a step of " << setting_.step
               << "; a larger step, tolerance or max_sweeps may help";
        now.report.message = text.str();
      }

      // Where nothing gives way between prescribed walls, rigid grains end up within each other.
      bool interpenetrate(const double penetration)
      {
        constexpr double limit = 0.3; // mean diameters
        if (penetration <= limit || penalty())
          return false;
        now.report.status = Status::not_converged;
        std::ostringstream text;
        text << "step " << now.row.step << ": grains interpenetrate by " << penetration << " mean diameters";
        now.report.message = text.str();
        return true;
      }

      // A step on which the sweeps stall is taken in two halves, these in halves again if need be: another problem, which
      // they mostly solve. False, with the reason in the report, where the smallest does not converge either. On return the
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
              note_accuracy(*result.accuracy);
            const double penetration = result.largest_penetration / setting_.mean_diameter;
            last_ = std::move(result), last_step_ = h;
            return !interpenetrate(penetration);
          }
        if (halvings == 0)
          {
            note_failure(result.solve);
            return false;
          }
        ++now.report.halved_steps;
        scale_impulses(now.state, 0.5);
        const bool done = advance_by(0.5 * h, halvings - 1) && advance_by(0.5 * h, halvings - 1);
        scale_impulses(now.state, 2);
        return done;
      }

      // One step, or the reason in the report why there is none.
      void step()
      {
        constexpr int most_halvings = 3;
        const double  begin         = cpu_seconds();
        const bool    done          = advance_by(now.step, penalty() ? 0 : most_halvings);
        now.report.loading_cpu_s += cpu_seconds() - begin;
        const Eigen::Vector2d travel = now.state.walls[1].point - now.reference.platen;
        now.report.axial_strain      = (0. - travel.y()) / now.reference.height;
        if (!done)
          return;
        ++now.report.steps;
        --now.steps_left;
        if (now.steps_left % now.interval == 0)
          {
            describe_state(now.state, last_, now.reference, setting_, now.row);
            callbacks_.on_step(now.row);
            now.row.max_penetration = now.row.momentum_residual = 0, now.row.sweeps = 0;
          }
        callbacks_.on_progress("loading the grains",
                               loading_progress(now.state, loading_.mode, now.reference.platen, now.reference.height) /
                                 loading_.stages.back());
      }

      const Loading    loading_;
      const Options    options_;
      const Callbacks &callbacks_;
      const double     rate_;
      StepSetting      setting_;
      StepCache        cache_;
      PenaltyState     springs_;
      StepResult       last_;
      double           last_step_ = 0; // its length
    };

    // The sample as it will be loaded; stage 0 is handed over. False where it did not get ready.
    bool prepare(const SampleOptions &sample,
                 const Loading       &loading,
                 const Options       &options,
                 const Callbacks     &callbacks,
                 Progress            &now)
    {
      const double   start    = cpu_seconds();
      Report        &report   = now.report;
      PreparedSample prepared = prepare_sample(
        sample, preparation_setting(loading, options), [&](const int step, const int expected) {
          callbacks.on_progress("preparing the sample", std::min(1., double(step) / expected));
          return !callbacks.stop_requested();
        });
      const double d = sample.mean_diameter, rate = strain_rate(loading, d, sample.density);
      now.state                = std::move(prepared.state);
      now.step                 = prepared.step; // that of the impulses
      report.preparation       = prepared.report;
      report.preparation_cpu_s = cpu_seconds() - start;
      report.initial_height    = sample_height(now.state);
      report.platen_speed      = loading.mode == LoadingMode::time ? 0 : rate * report.initial_height;
      if (!prepared.report.quiet)
        {
          report.status = callbacks.stop_requested() ? Status::stopped_by_user : Status::not_converged;
          std::ostringstream text;
          text << "the sample was not quiet after " << prepared.report.steps << " preparation steps: residual "
               << prepared.report.residual << ", unbalanced force " << prepared.report.unbalanced_force
               << "; a little sample/preparation_friction quiets slender or tiny samples";
          report.message = text.str();
          return false;
        }
      StepSetting setting;
      setting.step          = prepared.step;
      setting.law           = {prepared.report.friction, prepared.report.friction, 0, 0, prepared.report.friction};
      setting.mean_diameter = d;
      callbacks.on_stage(make_snapshot(now.state, prepared.last_step, {}, make_reference(now.state, d, 0.), setting));
      start_loading(now.state, {loading, options.lateral, options.drives, rate});
      now.reference = make_reference(now.state, d, loading.mode == LoadingMode::time ? 0. : rate);
      return true;
    }
  } // namespace

  void validate(const SampleOptions &sample, const Loading &loading, const Options &options)
  {
    validate(sample);
    validate(options.drives);
    const WallDriveOptions &d = options.drives;
    for (const auto &[key, text] : {std::pair{"left_x", &d.left_x}, std::pair{"left_y", &d.left_y},
                                    std::pair{"right_x", &d.right_x}, std::pair{"right_y", &d.right_y}})
      if (*text != "auto" && options.lateral.lateral != "rigid_walls")
        throw std::invalid_argument(std::string("discrete/drive_") + key + " = '" + *text +
                                    "': there is no such wall unless discrete/lateral = rigid_walls");
    if (loading.stages.empty() || loading.stages.front() <= 0 ||
        std::adjacent_find(loading.stages.begin(), loading.stages.end(), std::greater_equal<double>()) != loading.stages.end())
      throw std::invalid_argument("the stages of the loading must be positive and in ascending order");
    if (loading.mode == LoadingMode::plane_shear && options.lateral.lateral != "periodic" &&
        options.lateral.lateral != "rigid_walls")
      throw std::invalid_argument("loading/mode = plane_shear: the normal force is normal_pressure x width, so discrete/lateral "
                                  "must be periodic or rigid_walls, not " +
                                  options.lateral.lateral);
    const bool penalty = options.method.method == "penalty";
    if (penalty && (options.law.normal_restitution != 0 || options.law.tangential_restitution != 0))
      throw std::invalid_argument("discrete/method = penalty: discrete/normal_restitution and tangential_restitution must be 0; "
                                  "what rebounds there follows from penalty_damping");
    if (penalty && options.method.store_problems)
      throw std::invalid_argument("discrete/method = penalty has no contact problems: discrete/store_problems must be false");
    if (penalty && !(loading.pressure > 0))
      throw std::invalid_argument(
        "discrete/method = penalty: the stiffness is penalty_stiffness x loading/pressure, which must be positive");
  }

  PreparationSetting preparation_setting(const Loading &loading, const Options &options)
  {
    return {
      lateral_condition(options.lateral), options.solver, loading.pressure, {options.time.gravity_x, options.time.gravity_y}};
  }

  Report run(const SampleOptions &sample,
             const Loading       &loading,
             const Options       &options,
             const Callbacks     &callbacks,
             const Progress      *resume)
  {
    validate(sample, loading, options);
    Progress now;
    if (resume)
      {
        now = *resume;
        set_drives(now.state,
                   {loading, options.lateral, options.drives, strain_rate(loading, sample.mean_diameter, sample.density)});
      }
    else if (!prepare(sample, loading, options, callbacks, now))
      return now.report;

    Course course(sample, loading, options, callbacks, std::move(now));
    while (course.now.stage < int(loading.stages.size()) && course.now.report.status == Status::finished)
      {
        if (course.now.steps_left == 0)
          course.plan_stage();
        course.load_to_stage();
        // Where the run ends early, the last accepted step is kept as an instant of its own.
        course.hand_over();
        if (course.now.report.status == Status::finished)
          course.now.window.reset(), ++course.now.stage;
      }
    return course.now.report;
  }
} // namespace diptych::discrete
