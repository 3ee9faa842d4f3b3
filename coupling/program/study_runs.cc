// diptych: the runs of a study's points, on workers, and what they gave
// SPDX-License-Identifier: LGPL-2.1-or-later
#include "coupling/program/study_runs.h"

#include <algorithm>
#include <iostream>
#include <set>

#include "coupling/processes/processes.h"
#include "coupling/program/worker_command.h"
#include "coupling/scene/identity.h"
#include "coupling/studies/study_folder.h"
#include "discrete/choices.h"

namespace diptych::coupling
{
  namespace
  {
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
    std::vector<Pending> pending_runs(const CommandLine                   &line,
                                      const StudyPoints                   &asked,
                                      const std::vector<const StudyRun *> &runs)
    {
      std::vector<double> numbers; // as processes tell each other: place, resumes, place, ...
      on_first_process([&] {
        for (std::size_t k = 0; k < runs.size(); ++k)
          if (!found_end(asked.directory, *runs[k]))
            numbers.insert(numbers.end(), {double(k), double(prepare_run(asked.directory, *runs[k]))});
        if (line.resume && numbers.size() < 2 * runs.size())
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

    // What it was to go on from is damaged, as its log told.
    bool is_refused_checkpoint(const Pending &run, const TaskOutcome &outcome)
    {
      return run.resumes && !outcome.interrupted && outcome.exit_code == wrong_input;
    }

    Task task_of(const CommandLine &line, const StudyPoints &asked, const StudyRun &run, const bool resumes)
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

    std::vector<TaskOutcome> run_all(const CommandLine                   &line,
                                     const StudyPoints                   &asked,
                                     const std::vector<const StudyRun *> &runs,
                                     const std::vector<Pending>          &pending)
    {
      TaskQueue queue = workers_for(line, "runs");
      for (const Pending &one : pending)
        queue.tasks.push_back(task_of(line, asked, *runs[one.run], one.resumes));
      queue.n_finished_before = int(runs.size() - pending.size());
      const int at_once       = queue.jobs * int(n_processes());
      queue.on_ended          = [&](const TaskOutcome &outcome) {
        const Pending &one = pending[outcome.task];
        if (!outcome.interrupted && !is_refused_checkpoint(one, outcome))
          write_end(asked.directory, *runs[one.run], outcome.exit_code, at_once);
      };
      return run_tasks(queue);
    }

    // Runs that were to go on from something damaged, ready to begin.
    std::vector<Pending> begun_anew(const StudyPoints                   &asked,
                                    const std::vector<const StudyRun *> &runs,
                                    const std::vector<Pending>          &pending,
                                    const std::vector<TaskOutcome>      &outcomes)
    {
      std::vector<double> numbers; // as processes tell each other
      on_first_process([&] {
        for (const TaskOutcome &outcome : outcomes)
          if (const Pending &one = pending[outcome.task]; is_refused_checkpoint(one, outcome))
            {
              numbers.push_back(double(one.run));
              prepare_run_anew(asked.directory, *runs[one.run]);
            }
        if (!numbers.empty())
          std::cerr << numbers.size() << " runs begin anew: what they were to go on from is damaged" << std::endl;
        return 0;
      });
      std::vector<Pending> anew;
      for (const double run : from_first_process(numbers))
        anew.push_back({std::size_t(run), false});
      return anew;
    }
  } // namespace

  InputFiles inputs_of(const StudyPoints &asked)
  {
    InputFiles inputs{{"the study", asked.study.file}, {"the scene", asked.study.scene}};
    for (const StudyRun *run : runs_of(asked.points))
      for (const auto &input : input_files(*run->scene))
        inputs.push_back(input);
    return inputs;
  }

  std::vector<TaskOutcome> do_runs(const CommandLine &line, const StudyPoints &asked)
  {
    const std::vector<const StudyRun *> runs     = runs_of(asked.points);
    const std::vector<Pending>          pending  = pending_runs(line, asked, runs);
    std::vector<TaskOutcome>            outcomes = run_all(line, asked, runs, pending);
    const std::vector<Pending>          refused  = begun_anew(asked, runs, pending, outcomes);
    if (refused.empty())
      return outcomes;
    outcomes.erase(std::remove_if(outcomes.begin(), outcomes.end(),
                                  [&](const TaskOutcome &one) { return is_refused_checkpoint(pending[one.task], one); }),
                   outcomes.end());
    const std::vector<TaskOutcome> again = run_all(line, asked, runs, refused);
    outcomes.insert(outcomes.end(), again.begin(), again.end());
    return outcomes;
  }

  StudyResults results_of(const StudyPoints &asked)
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
} // namespace diptych::coupling
