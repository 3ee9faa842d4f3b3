// diptych: study STUDY.json: many points of a scene, each on every sample
// SPDX-License-Identifier: LGPL-2.1-or-later
#include "coupling/program/study_command.h"

#include <algorithm>
#include <filesystem>
#include <iostream>
#include <map>
#include <set>
#include <sstream>

#include "coupling/folders/result_folder.h"
#include "coupling/panels/continuum_loading.h"
#include "coupling/processes/processes.h"
#include "coupling/program/report_command.h"
#include "coupling/program/worker_command.h"
#include "coupling/studies/study_curves.h"
#include "coupling/studies/study_file.h"
#include "coupling/studies/study_folder.h"
#include "coupling/studies/study_output.h"

namespace diptych::coupling
{
  namespace
  {
    // A study with its points and its folder.
    struct Asked
    {
      Study                   study;
      std::vector<ScenePoint> points;
      std::string             directory;
    };

    Asked asked_by(const CommandLine &line)
    {
      Asked asked{read_study(line.target, line.overrides), {}, line.output};
      asked.points = points_of(asked.study);
      if (asked.directory.empty())
        asked.directory = "results/" + asked.study.name + "_study";
      return asked;
    }

    // Different runs, in the order of the points: two points may be the same scene.
    std::vector<const StudyRun *> runs_of(const std::vector<ScenePoint> &points)
    {
      std::vector<const StudyRun *> runs;
      std::set<std::string>         names;
      for (const ScenePoint &point : points)
        for (const StudyRun &run : point.runs)
          if (run.scene && names.insert(run.name).second)
            runs.push_back(&run);
      return runs;
    }

    // A run that is to be done.
    struct Pending
    {
      std::size_t run     = 0; // its place
      bool        resumes = false;
    };

    // Makes the folder ready; the runs that are not finished in it.
    std::vector<Pending> pending_runs(const CommandLine &line, const Asked &asked, const std::vector<const StudyRun *> &runs)
    {
      std::vector<double> numbers; // as processes tell each other: place, resumes, place, ...
      on_first_process([&] {
        open_study_folder(asked.directory, asked.study, line.resume);
        for (std::size_t k = 0; k < runs.size(); ++k)
          if (!found_end(asked.directory, *runs[k]))
            numbers.insert(numbers.end(), {double(k), double(prepare_run(asked.directory, *runs[k]))});
        if (numbers.size() < 2 * runs.size())
          say(line, std::to_string(runs.size() - numbers.size() / 2) + " of " + std::to_string(runs.size()) +
                      " runs are finished in " + asked.directory + ": not run again");
        return 0;
      });
      numbers = from_first_process(numbers);
      std::vector<Pending> pending;
      for (std::size_t k = 0; k < numbers.size(); k += 2)
        pending.push_back({std::size_t(numbers[k]), numbers[k + 1] != 0});
      return pending;
    }

    Task task_of(const CommandLine &line, const Asked &asked, const StudyRun &run, const bool resumes)
    {
      const StudyCommand command = asked.study.command;
      Task               task{
        "run " + run.name,
        {discrete::name_of(command), run_scene(asked.directory, run), "--quiet", "--output", run_folder(asked.directory, run)},
        run_log(asked.directory, run)};
      if (command == StudyCommand::discrete || command == StudyCommand::run)
        task.words.insert(task.words.end(), {"--threads", std::to_string(line.threads)});
      if (resumes && command != StudyCommand::material_point)
        task.words.emplace_back("--resume");
      return task;
    }

    std::vector<TaskOutcome> do_runs(const CommandLine &line, const Asked &asked, const std::vector<const StudyRun *> &runs)
    {
      const std::vector<Pending> pending = pending_runs(line, asked, runs);
      TaskQueue                  queue   = workers_for(line, "runs");
      for (const Pending &one : pending)
        queue.tasks.push_back(task_of(line, asked, *runs[one.run], one.resumes));
      queue.n_finished_before = int(runs.size() - pending.size());
      const int at_once       = queue.jobs * int(n_processes());
      queue.on_ended          = [&](const TaskOutcome &outcome) {
        if (!outcome.interrupted)
          write_end(asked.directory, *runs[pending[outcome.task].run], outcome.exit_code, at_once);
      };
      return run_tasks(queue);
    }

    StudyResults results_of(const Asked &asked)
    {
      StudyResults results;
      for (const ScenePoint &point : asked.points)
        {
          results.emplace_back();
          for (const StudyRun &run : point.runs)
            results.back().push_back(result_of(asked.directory, asked.study, run));
        }
      return results;
    }

    void write_tables(const Asked &asked, const StudyResults &results, const StudyRecord &record)
    {
      const StudyTables tables{asked.study, asked.points, results, record};
      write_study_json(asked.directory, tables);
      write_study_csv(asked.directory, tables);
      write_study_cost(asked.directory, cost_of(asked.study, asked.points, results, record));
      write_study_curves(asked.directory, tables);
    }

    // "12 points: 7 right, 3 silently wrong, 2 stopped"
    std::string summary(const Asked &asked, const StudyRecord &record)
    {
      std::map<PointClass, int> counts;
      int                       n = 0;
      for (std::size_t k = 0; k < record.points.size(); ++k)
        if (asked.points[k].family >= 0)
          ++counts[record.points[k].kind], ++n;
      std::ostringstream text;
      text << n << " points";
      const char *mark = ": ";
      for (const auto &[kind, count] : counts)
        text << mark << count << ' ' << discrete::name_of(kind), mark = ", ";
      return text.str();
    }

    // A window that the loading does not reach, a number that no comparison has.
    void warn_of_missing(const Asked &asked, const StudyRecord &record)
    {
      const PointRecord &reference = record.points.front();
      const bool         finished  = reference.kind != PointClass::not_run && reference.kind != PointClass::stopped &&
                            reference.kind != PointClass::refused;
      for (std::size_t q = 0; finished && q < asked.study.quantities.size(); ++q)
        if (reference.quantities[q].statistics.n == 0)
          std::cerr << "diptych: warning: the reference has no value of '" << asked.study.quantities[q].name
                    << "': a window beyond the end of the loading, or a number that no comparison has" << std::endl;
    }

    int conclude(const CommandLine &line, const Asked &asked, const std::vector<TaskOutcome> &outcomes, const StudyRecord &record)
    {
      warn_of_missing(asked, record);
      say(line, summary(asked, record) + "; tables: " + asked.directory + "/study.json, study.csv");
      const auto interrupted = std::count_if(outcomes.begin(), outcomes.end(),
                                             [](const TaskOutcome &outcome) { return outcome.interrupted; });
      const auto lost        = std::count_if(record.points.begin(), record.points.end(),
                                             [](const PointRecord &point) { return point.kind == PointClass::not_run; });
      if (interrupted > 0)
        std::cerr << "stopped on request; " << interrupted << " runs are left";
      else if (lost > 0)
        std::cerr << lost << " points have runs that the system ended";
      if (interrupted > 0 || lost > 0)
        std::cerr << ", the rest is kept in " << asked.directory << "; to go on: diptych study " << line.target << " --output "
                  << asked.directory << " --resume (with the same --set)" << std::endl;
      return interrupted > 0 || lost > 0 ? not_converged : done;
    }
  } // namespace

  int run_study(const CommandLine &line)
  {
    const Asked asked    = asked_by(line);
    const auto  runs     = runs_of(asked.points);
    const auto  outcomes = do_runs(line, asked, runs);
    return on_first_process([&] {
      return keeping(asked.directory, [&] {
        const StudyResults results = results_of(asked);
        const StudyRecord  record  = evaluate(asked.study, asked.points, results);
        write_tables(asked, results, record);
        draw_page(line, Drawing::study, asked.directory);
        return conclude(line, asked, outcomes, record);
      });
    });
  }
} // namespace diptych::coupling
