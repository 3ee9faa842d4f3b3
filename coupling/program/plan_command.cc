// diptych: plan SCENE: what a scene needs for an accuracy
// SPDX-License-Identifier: LGPL-2.1-or-later
#include "coupling/program/plan_command.h"

#include <algorithm>
#include <cmath>
#include <iostream>
#include <set>

#include "coupling/panels/continuum_loading.h"
#include "coupling/plans/continuum_plan.h"
#include "coupling/plans/error_law.h"
#include "coupling/plans/grains_plan.h"
#include "coupling/plans/pilot_values.h"
#include "coupling/plans/plan_output.h"
#include "coupling/plans/plan_question.h"
#include "coupling/plans/plan_text.h"
#include "coupling/processes/stop_signal.h"
#include "coupling/program/study_runs.h"
#include "coupling/scene/identity.h"
#include "coupling/scene/scene_file.h"
#include "coupling/store/provenance.h"
#include "coupling/store/result_folder.h"
#include "coupling/studies/study_folder.h"
#include "coupling/studies/study_part.h"
#include "coupling/version.h"

namespace diptych::coupling
{
  namespace
  {
    // A sample that does not come to its end is left out, as long as they are few.
    constexpr double least_share_that_finishes = 0.75;

    const RunsFolder folder_of_a_plan = {"plan", "plan_input", {"plan.json", "planned.prm"}};

    Study study_of(const PlanQuestion &question, const PilotTask &task)
    {
      Study study;
      study.name = study.file = study.scene = question.scene;
      study.command                         = task.command;
      study.settings                        = task.common;
      study.seeds                           = task.seeds;
      study.reference                       = task.points.front();
      study.quantities                      = task.quantities;
      study.families.push_back(family_of(task.points));
      return study;
    }

    double cpu_of(const RunResult &result, const bool of_preparation)
    {
      double sum = 0;
      for (const PhaseCost &phase : result.phases)
        sum += of_preparation == (phase.name == "preparation") || !of_preparation ? phase.cpu_s : 0;
      return sum;
    }

    // The runs of a plan, each done once.
    class Pilot
    {
    public:
      Pilot(const CommandLine &line, const PlanQuestion &question, std::string directory)
          : line(line),
            question(question),
            directory(std::move(directory))
      {
        this->line.resume = false; // what is finished is told once
      }

      std::vector<PilotPoint> run(const PilotTask &task)
      {
        StudyPoints asked{study_of(question, task), {}, directory};
        try
          {
            asked.points = points_of(asked.study);
          }
        catch (const SceneError &error) // settings that contradict the scene
          {
            PilotPoint refused;
            refused.words = error.what();
            return {refused};
          }
        for (const TaskOutcome &outcome : do_runs(line, asked))
          if (outcome.interrupted)
            throw StoppedOnRequest("stopped on request; to go on: diptych plan " + line.target + " --output " + directory +
                                   " --resume (with the same options)");
        const StudyResults      results = results_of(asked);
        std::vector<PilotPoint> points;
        for (std::size_t k = 0; k < asked.points.size(); ++k)
          if (asked.points[k].family >= 0)
            points.push_back(point_of(asked.points[k], results[k], task));
        return points;
      }

      double cpu_s() const { return spent; }

    private:
      PilotPoint point_of(const ScenePoint &point, const std::vector<RunResult> &results, const PilotTask &task)
      {
        PilotPoint        made;
        const std::size_t n_quantities = task.quantities.size();
        made.values.resize(n_quantities);
        made.cpu_s = made.strength_error = made.dilation_error = 0;
        double n_finished                                      = 0;
        for (const RunResult &result : results)
          n_finished += result.is_known && result.exit_code == 0;
        const bool is_usable = n_finished > 0 && n_finished >= least_share_that_finishes * double(results.size());
        for (std::size_t k = 0; k < results.size(); ++k)
          {
            const RunResult &result   = results[k];
            const bool       finished = result.is_known && result.exit_code == 0;
            if (!finished)
              (is_usable ? made.remark : made.words) = !result.words.empty() ? result.words : "the run was lost";
            if (counted.insert(point.runs[k].name).second)
              spent += cpu_of(result, false);
            for (std::size_t q = 0; q < n_quantities; ++q)
              made.values[q].push_back(result.values[q]);
            for (const PhaseCost &phase : result.phases)
              made.peak_memory_mb = std::max(made.peak_memory_mb, phase.peak_memory_mb);
            if (!finished)
              continue;
            made.sample_cpu_s.push_back(cpu_of(result, false));
            made.cpu_s += cpu_of(result, false) / n_finished;
            made.preparation_cpu_s += cpu_of(result, true) / n_finished;
            const DiscreteFacts facts = read_run_facts(run_folder(directory, point.runs[k])).discrete;
            made.strength_error += facts.expected_strength_error / n_finished;
            made.dilation_error += facts.expected_dilation_error / n_finished;
          }
        for (std::size_t q = 0; made.words.empty() && q < n_quantities; ++q)
          if (const auto &v = made.values[q];
              std::none_of(v.begin(), v.end(), [](const double value) { return std::isfinite(value); }))
            made.words = task.quantities[q].name + " has no value in any run: a window beyond the loading, or no band";
        return made;
      }

      CommandLine           line;
      const PlanQuestion   &question;
      std::string           directory;
      std::set<std::string> counted;
      double                spent = 0; // CPU s of all runs
    };

    // The planned samples of a panel, and more where they scatter more than the pilot's did.
    class Execution
    {
    public:
      Execution(const PlanQuestion &question, const Plan &plan, Pilot &pilot)
          : question(question),
            pilot(pilot),
            settings(question.changes)
      {
        for (const PanelPlan &panel : plan.panels)
          settings.insert(settings.end(), panel.settings.begin(), panel.settings.end());
      }

      // Whether the accuracy is reached.
      bool run(PanelPlan &panel)
      {
        const int        most  = 2 * panel.n_samples() + spare_samples;
        std::vector<int> seeds = panel.seeds;
        for (int more = 0;; more = samples_missing(panel, int(seeds.size())))
          {
            const int wanted = std::min(most, int(seeds.size()) + more);
            while (more > 0 && int(seeds.size()) < wanted)
              seeds.push_back(seeds.back() + 1);
            measure(panel, seeds);
            const int missing = samples_missing(panel, int(seeds.size()));
            if (missing == 0 || panel.outcomes.empty())
              return missing == 0 && !panel.outcomes.empty();
            if (int(seeds.size()) >= most)
              return false;
          }
      }

    private:
      static constexpr int spare_samples = 8;

      void measure(PanelPlan &panel, const std::vector<int> &seeds)
      {
        const auto &wanted = panel.panel == "discrete" ? question.grains : question.continuum;
        PilotTask   task{panel.command, settings, {{}}, seeds, {}};
        for (const PlanQuantity &quantity : wanted)
          task.quantities.push_back(quantity.quantity);
        const PilotPoint point = pilot.run(task).front();
        panel.outcomes.clear();
        panel.outcome_cpu_s = point.cpu_s;
        if (!point.words.empty())
          {
            panel.decisions.push_back("--run: " + point.words);
            return;
          }
        for (std::size_t q = 0; q < wanted.size(); ++q)
          {
            const PilotSummary s = summary_of(wanted[q].quantity, point.values[q]);
            const int          n = s.statistics.n;
            panel.outcomes.push_back(
              {wanted[q].quantity.name, s.statistics, s.scatter, n > 1 ? half_interval(s.scatter, n) : NAN});
          }
      }

      // How many samples more the intervals need: of those that have a value (a band, for one) only some may be among them.
      int samples_missing(const PanelPlan &panel, const int n) const
      {
        int missing = 0;
        for (std::size_t q = 0; q < panel.outcomes.size() && n > 1; ++q)
          {
            double method = 0;
            for (const ErrorPart &part : panel.quantities[q].parts)
              method += part.cause == "samples" ? 0 : part.error;
            const QuantityOutcome &outcome = panel.outcomes[q];
            if (outcome.half_interval + method <= question.accuracy)
              continue;
            const double share  = double(outcome.statistics.n) / n;
            const int    needed = samples_for(outcome.scatter, question.accuracy - method);
            missing             = std::max(missing, needed == 0 || share == 0 ? n : std::max(1, int(needed / share) - n));
          }
        return missing;
      }

      const PlanQuestion &question;
      Pilot              &pilot;
      Settings            settings;
    };

    // What `diptych run` costs with the settings of both panels; the plan's first samples tell.
    void find_shared_cost(const PlanQuestion &question, Plan &plan, Pilot &pilot)
    {
      constexpr std::size_t most = 4;
      PilotTask             task{StudyCommand::run, question.changes, {{}}, {}, {}};
      for (const PanelPlan &panel : plan.panels)
        {
          task.common.insert(task.common.end(), panel.settings.begin(), panel.settings.end());
          if (panel.seeds.size() > task.seeds.size())
            task.seeds = panel.seeds;
        }
      task.seeds.resize(std::min(task.seeds.size(), most));
      const PilotPoint point = pilot.run(task).front();
      for (PanelPlan &panel : plan.panels)
        if (point.words.empty())
          {
            panel.cpu_s          = point.cpu_s;
            panel.peak_memory_mb = point.peak_memory_mb;
          }
    }

    Plan plan_of(const PlanQuestion &question, const Scene &scene, Pilot &pilot)
    {
      const RunPilot run = [&](const PilotTask &task) { return pilot.run(task); };
      Plan           plan;
      plan.scene    = question.scene.substr(question.scene.rfind('/') + 1);
      plan.revision = git_revision;
      plan.accuracy = question.accuracy;
      if (!question.grains.empty())
        plan.panels.push_back(plan_grains(question, scene, run));
      if (!question.continuum.empty())
        plan.panels.push_back(plan_continuum(question, scene, run));
      if (plan.shares_samples())
        find_shared_cost(question, plan, pilot);
      plan.pilot_cpu_s = pilot.cpu_s();
      return plan;
    }

    bool reaches(const Plan &plan)
    {
      return std::all_of(plan.panels.begin(), plan.panels.end(), [](const PanelPlan &panel) { return panel.reaches; });
    }

    int carry_out(const CommandLine &line, const PlanQuestion &question, const Scene &scene, const std::string &directory)
    {
      Pilot pilot(line, question, directory);
      Plan  plan = plan_of(question, scene, pilot);
      write_plan(directory, question, plan);
      bool is_reached = reaches(plan);
      if (line.runs_the_plan)
        {
          Execution execution(question, plan, pilot);
          for (PanelPlan &panel : plan.panels)
            if (panel.reaches)
              is_reached = execution.run(panel) && is_reached;
          write_plan(directory, question, plan);
        }
      std::cout << text_of(plan) << directory << "/planned.prm, plan.json" << std::endl;
      if (!is_reached)
        std::cerr << "diptych: the accuracy of " << percent(question.accuracy) << " is not reached" << std::endl;
      return is_reached ? done : not_converged;
    }
  } // namespace

  int make_plan(const CommandLine &line)
  {
    for (const std::string &text : line.overrides)
      refuse_folder(entry_of_override(text));
    const PlanQuestion question = read_question({line.target, line.overrides, line.accuracy, line.wanted});
    const Scene        scene    = read_changed_scene(question.scene, question.changes, question.needs_comparison);
    if (!question.continuum.empty())
      require_continuum(scene);
    const std::string directory = line.output.empty() ? "results/" + scene.name + "_plan" : line.output;
    InputFiles        inputs    = input_files(scene);
    inputs.emplace_back("the scene", question.scene);
    for (const std::string &file : line.set_files)
      inputs.emplace_back("--set-file", file);
    return writing(directory, [&](FolderLock &lock) {
      open_runs_folder(lock, folder_of_a_plan, question.scene, opening_of(line), inputs);
      return carry_out(line, question, scene, directory);
    });
  }
} // namespace diptych::coupling
