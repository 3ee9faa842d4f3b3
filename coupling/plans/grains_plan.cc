// diptych: plans step, tolerance, snapshots and number of samples of the grains
// SPDX-License-Identifier: LGPL-2.1-or-later
#include "coupling/plans/grains_plan.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "coupling/plans/grain_choice.h"
#include "coupling/plans/pilot_values.h"
#include "coupling/plans/plan_question.h"
#include "coupling/plans/plan_text.h"
#include "coupling/scene/keys.h"
#include "coupling/statistics/student.h"

namespace diptych::coupling
{
  namespace
  {
    constexpr int      pilot_samples = 8, paired_samples = 4;
    constexpr int      largest_first_seed = 2140000000; // leaves room for more seeds
    constexpr double   finer              = 0.5;        // second level of the pilot / first level
    constexpr Estimate rule = {1, 0.5}, no_rule = {0, 1};
    // A cheaper setting is used if it saves more than the first share of the time and changes no quantity by more than the
    // second share of the accuracy.
    constexpr double worth_trying = 0.1, share_of_a_knob = 0.25;
    // A choice finer than the pilot by the first factor is run, at most the second factor ahead at a time.
    constexpr double far_from_the_pilot = 1.5, furthest_ahead = 4;

    struct Level
    {
      double     accuracy;
      PilotPoint point;
    };

    // A cheaper setting that is used, and its effect on each quantity.
    struct CheaperSetting
    {
      std::string         what;
      std::vector<double> shifts; // with sign
    };

    // The pilot for one question.
    class Grains
    {
    public:
      Grains(const PlanQuestion &question, const Scene &scene, const RunPilot &run)
          : question(question),
            run(run)
      {
        plan.panel   = "discrete";
        plan.command = StudyCommand::discrete;
        for (const PlanQuantity &quantity : question.grains)
          {
            quantities.push_back(quantity.quantity);
            if (quantity.quantity.source == Source::comparison)
              plan.command = StudyCommand::run;
          }
        if (scene.sample.file.empty())
          for (int k = 0; k < pilot_samples; ++k)
            seeds.push_back(std::min(scene.sample.seed, largest_first_seed) + k);
        common = {planned("discrete", "step", "auto"), planned("discrete", "tolerance", "auto")};
        if (scene.discrete.time.step || scene.discrete.accuracy.tolerance)
          plan.decisions.emplace_back(
            "step and tolerance: auto instead of the scene's values, so that discrete/accuracy sets both");
        if (scene.discrete.sampling.snapshot_max_sweeps > 0)
          {
            common.push_back(planned("discrete", "snapshot_max_sweeps", "0"));
            plan.decisions.emplace_back("sampled snapshots: off, because no quantity needs single grains");
          }
        if (plan.command == StudyCommand::run)
          for (const char *key : {"coarse_element_size", "band_resamples", "probe_resamples"})
            common.push_back(planned("comparison", key, "0"));
        penetration_correction = text_of(scene.discrete.time.penetration_correction);
        preparation_steps      = scene.sample.preparation_steps;
      }

      PanelPlan plan_it()
      {
        levels.push_back({coarsest_accuracy, run_at(coarsest_accuracy, {}, seeds)});
        if (!finished(levels.back()))
          return plan;
        levels.push_back({finer * coarsest_accuracy, run_at(finer * coarsest_accuracy, {}, first_samples())});
        if (!finished(levels.back()))
          return plan;
        if (seeds.empty())
          find_repeatability();
        else
          try_less_preparation(), try_without_correction();
        GrainChoice choice = choose();
        while (choice.samples > 0 && choice.accuracy * far_from_the_pilot < levels.back().accuracy)
          {
            const double next = std::max(choice.accuracy, rounded_to_two_digits(levels.back().accuracy / furthest_ahead));
            levels.push_back({next, run_at(next, {}, first_samples())});
            if (!finished(levels.back()))
              return plan;
            choice = choose();
          }
        conclude(choice);
        return plan;
      }

    private:
      std::vector<int> first_samples() const
      {
        return {seeds.begin(), seeds.begin() + std::ptrdiff_t(std::min(seeds.size(), std::size_t(paired_samples)))};
      }

      SampleStatistics difference(const PilotPoint &one, const PilotPoint &other, const std::size_t q) const
      {
        return relative_difference(quantities[q], one.values[q], other.values[q]);
      }

      PilotPoint run_at(const double accuracy, Settings settings, const std::vector<int> &on) const
      {
        settings.insert(settings.begin(), planned("discrete", "accuracy", accuracy));
        Settings all = question.changes;
        all.insert(all.end(), common.begin(), common.end());
        return run({plan.command, all, {settings}, on, quantities}).front();
      }

      bool finished(const Level &level)
      {
        if (!level.point.remark.empty())
          plan.decisions.push_back("discrete/accuracy = " + text_of(level.accuracy) +
                                   ": some samples are left out: " + level.point.remark);
        if (level.point.words.empty())
          return true;
        plan.reaches = false;
        plan.decisions.push_back("discrete/accuracy = " + text_of(level.accuracy) + ": " + level.point.words);
        return false;
      }

      // Both errors are upwards: long steps increase the strength and decrease the dilation, which is negative.
      double expected(const Level &level, const std::size_t q) const
      {
        const double dilation = level.point.dilation_error, strength = level.point.strength_error;
        return question.grains[q].step_error == StepError::dilation ? dilation : strength;
      }

      GrainErrors errors_of(const std::size_t q) const
      {
        const Level          &first = levels.front(), &last = levels.back();
        const bool            is_known = question.grains[q].step_error != StepError::unknown;
        std::vector<Evidence> evidence;
        for (std::size_t k = 1; k < levels.size() && !seeds.empty(); ++k)
          {
            const SampleStatistics d = difference(levels[k - 1].point, levels[k].point, q);
            evidence.push_back(
              {expected(levels[k - 1], q) - expected(levels[k], q), d.mean, half_interval(d.deviation, d.n) / normal_quantile});
          }
        const Estimate factor  = improved(is_known ? rule : no_rule, evidence);
        const double   slope   = expected(last, q) / last.accuracy;
        const double   scatter = summary_of(quantities[q], first.point.values[q]).scatter;
        return {{factor.mean * slope, factor.deviation * slope}, seeds.empty() ? 0. : scatter, is_known};
      }

      std::vector<GrainErrors> all_errors() const
      {
        std::vector<GrainErrors> errors;
        for (std::size_t q = 0; q < quantities.size(); ++q)
          errors.push_back(errors_of(q));
        return errors;
      }

      // Mean over the first samples, which all levels have.
      static double cost_of(const PilotPoint &point)
      {
        const std::size_t n = std::min(point.sample_cpu_s.size(), std::size_t(paired_samples));
        return n == 0
                 ? point.cpu_s
                 : std::accumulate(point.sample_cpu_s.begin(), point.sample_cpu_s.begin() + std::ptrdiff_t(n), 0.) / double(n);
      }

      std::vector<CostPoint> cost() const
      {
        std::vector<CostPoint> points;
        for (const Level &level : levels)
          points.push_back({level.accuracy, cost_of(level.point)});
        return points;
      }

      // Error that the cheaper settings add to a quantity.
      double error_of_knobs(const std::size_t q) const
      {
        double sum = 0;
        for (const CheaperSetting &knob : cheaper_settings)
          sum += std::abs(knob.shifts[q]);
        return sum;
      }

      GrainChoice choose() const
      {
        double most = 0;
        for (std::size_t q = 0; q < quantities.size(); ++q)
          most = std::max(most, error_of_knobs(q) + (one_run.empty() ? 0. : one_run[q]));
        return cheapest_choice(all_errors(), cost(), question.accuracy - most, seeds.empty() ? 1 : 0);
      }

      void conclude(GrainChoice choice)
      {
        plan.reaches = choice.samples > 0;
        if (!plan.reaches)
          choice = {std::clamp(question.accuracy / 2, finest_accuracy, coarsest_accuracy), seeds.empty() ? 1 : pilot_samples};
        plan.settings = common;
        plan.settings.push_back(planned("discrete", "accuracy", choice.accuracy));
        if (!seeds.empty())
          for (int k = 0; k < choice.samples; ++k)
            plan.seeds.push_back(seeds.front() + k);
        plan.cpu_s                            = cost_at(cost(), choice.accuracy);
        plan.peak_memory_mb                   = levels.back().point.peak_memory_mb;
        const std::vector<GrainErrors> errors = all_errors();
        for (std::size_t q = 0; q < quantities.size(); ++q)
          plan.quantities.push_back(budget(q, errors[q], choice));
        report_levels();
        advise();
      }

      QuantityBudget budget(const std::size_t q, const GrainErrors &errors, const GrainChoice &choice) const
      {
        QuantityBudget result;
        result.name    = quantities[q].name;
        result.mean    = summary_of(quantities[q], levels.front().point.values[q]).statistics.mean;
        result.scatter = seeds.empty() ? NAN : errors.scatter;
        result.parts.push_back({"step, tolerance", errors.at(choice.accuracy), errors.step.mean * choice.accuracy,
                                errors.step.deviation * choice.accuracy});
        if (!seeds.empty())
          result.parts.push_back({"samples", half_interval(errors.scatter, choice.samples), 0, NAN});
        else
          result.parts.push_back({"one run", one_run[q], 0, NAN});
        for (const CheaperSetting &knob : cheaper_settings)
          result.parts.push_back({knob.what, std::abs(knob.shifts[q]), knob.shifts[q], NAN});
        return result;
      }

      // Runs diverge from the last digit on. Runs with almost the same accuracy show how far one run may lie from their mean.
      void find_repeatability()
      {
        std::vector<std::vector<double>> values(quantities.size());
        for (const double share : {1., 0.98, 0.96, 0.94})
          {
            const PilotPoint point = run_at(share * levels.back().accuracy, {}, seeds);
            for (std::size_t q = 0; q < quantities.size() && point.words.empty(); ++q)
              values[q].push_back(point.values[q].front());
          }
        for (std::size_t q = 0; q < quantities.size(); ++q)
          one_run.push_back(half_interval(summary_of(quantities[q], values[q]).scatter, 1));
      }

      void report_levels()
      {
        for (const Level &level : levels)
          plan.decisions.push_back("discrete/accuracy = " + text_of(level.accuracy) + ": " + rounded(level.point.cpu_s) +
                                   " CPU s per sample");
        for (std::size_t q = 0; q < quantities.size() && !seeds.empty(); ++q)
          {
            const SampleStatistics d = difference(levels[0].point, levels[1].point, q);
            plan.decisions.push_back("  " + quantities[q].name + ": " + percent(d.mean) + " +- " +
                                     percent(half_interval(d.deviation, d.n)) + " from " + text_of(levels[0].accuracy) + " to " +
                                     text_of(levels[1].accuracy) + " on " + std::to_string(d.n) + " samples");
          }
      }

      // Runs a cheaper setting if it may be worth it and eight samples can measure its effect. Keeps it if the effect is small.
      // deviations: expected deviations of the differences, one per quantity.
      void try_knob(const std::string &what, const Entry &cheaper, const double saving, const std::vector<double> &deviations)
      {
        const double most     = share_of_a_knob * question.accuracy;
        const double interval = half_interval(*std::max_element(deviations.begin(), deviations.end()), int(seeds.size()));
        std::string  verdict;
        if (saving < worth_trying)
          verdict = "not tried; it would save " + (saving > 0 ? "only " + percent(saving) + " of the" : "no") + " time";
        else if (!(interval <= most))
          verdict = "not used; it would save " + percent(saving) + " of the time, but " + std::to_string(seeds.size()) +
                    " samples give its error only to +- " + percent(interval);
        else
          verdict = verdict_on(what, cheaper, saving);
        plan.decisions.push_back(what + ": " + verdict);
      }

      std::string verdict_on(const std::string &what, const Entry &cheaper, const double saving)
      {
        const PilotPoint point = run_at(coarsest_accuracy, {cheaper}, seeds);
        if (!point.words.empty())
          return point.words;
        CheaperSetting knob{what, {}};
        double         reach = 0;
        for (std::size_t q = 0; q < quantities.size(); ++q)
          {
            const SampleStatistics d = difference(point, levels.front().point, q);
            knob.shifts.push_back(d.mean);
            reach = std::max(reach, std::abs(d.mean) + half_interval(d.deviation, d.n));
          }
        if (!(reach <= share_of_a_knob * question.accuracy))
          return "not used; it changes a quantity by up to " + percent(reach);
        const Settings before = common;
        common.push_back(cheaper);
        const PilotPoint second = run_at(levels[1].accuracy, {}, first_samples());
        if (!second.words.empty())
          {
            common = before;
            return second.words;
          }
        cheaper_settings.push_back(knob);
        levels[0].point = point, levels[1].point = second; // the samples have changed
        return "used; it saves " + percent(saving);
      }

      // Another preparation makes different samples, so pairing brings nothing.
      void try_less_preparation()
      {
        const int           less = preparation_steps / 3;
        std::vector<double> deviations;
        for (std::size_t q = 0; q < quantities.size(); ++q)
          deviations.push_back(std::sqrt(2.) * all_errors()[q].scatter);
        if (less > 0)
          try_knob("preparation of " + std::to_string(less) + " steps",
                   planned("sample", "preparation_steps", std::to_string(less)),
                   2. / 3 * levels.back().point.preparation_cpu_s / levels.back().point.cpu_s, deviations);
      }

      // One sample gives the cost. The runs diverge as much as between two steps.
      void try_without_correction()
      {
        if (penetration_correction == "none")
          return;
        const Entry            none    = planned("discrete", "penetration_correction", "none");
        const std::vector<int> one     = {seeds.front()};
        const PilotPoint       without = run_at(coarsest_accuracy, {none}, one), with = run_at(coarsest_accuracy, {}, one);
        std::vector<double>    deviations;
        for (std::size_t q = 0; q < quantities.size(); ++q)
          deviations.push_back(difference(levels[0].point, levels[1].point, q).deviation);
        if (without.words.empty() && with.words.empty())
          try_knob("no penetration correction", none, 1 - without.cpu_s / with.cpu_s, deviations);
        else
          plan.decisions.push_back("no penetration correction: " + without.words);
      }

      void advise()
      {
        if (seeds.empty())
          {
            plan.decisions.emplace_back(
              "there is one sample from a file: the scatter of samples is unknown and not in the budget");
            return;
          }
        const auto   larger   = [](const QuantityBudget &a, const QuantityBudget &b) { return a.scatter < b.scatter; };
        const auto   deciding = std::max_element(plan.quantities.begin(), plan.quantities.end(), larger);
        const double left     = question.accuracy - (deciding->total() - half_interval(deciding->scatter, plan.n_samples()));
        const auto   text     = [&](const int n) { return n > 0 ? std::to_string(n) : std::string("more than a million"); };
        plan.decisions.push_back("eight samples give the scatter to within a factor of 0.66 to 2.0, so " +
                                 text(samples_for(0.66 * deciding->scatter, left)) + " to " +
                                 text(samples_for(2.0 * deciding->scatter, left)) + " samples may be needed");
        plan.decisions.push_back(deciding->name + " determines the number of samples; one sample scatters by " +
                                 percent(deciding->scatter) + "; the scatter falls with the square root of the number of grains");
      }

      const PlanQuestion         &question;
      const RunPilot             &run;
      PanelPlan                   plan;
      std::vector<StudyQuantity>  quantities;
      std::vector<int>            seeds;
      Settings                    common;
      std::string                 penetration_correction;
      int                         preparation_steps = 0;
      std::vector<Level>          levels; // of the pilot, ever finer
      std::vector<CheaperSetting> cheaper_settings;
      std::vector<double>         one_run; // half an interval of each quantity, for a single sample
    };
  } // namespace

  PanelPlan plan_grains(const PlanQuestion &question, const Scene &scene, const RunPilot &run)
  {
    return Grains(question, scene, run).plan_it();
  }
} // namespace diptych::coupling
