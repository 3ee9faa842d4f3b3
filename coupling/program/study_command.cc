// diptych: study STUDY.json: many points of a scene, each on every sample
// SPDX-License-Identifier: LGPL-2.1-or-later
#include "coupling/program/study_command.h"

#include <algorithm>
#include <iostream>
#include <map>
#include <optional>
#include <sstream>

#include "coupling/processes/processes.h"
#include "coupling/processes/stop_signal.h"
#include "coupling/program/report_command.h"
#include "coupling/program/study_runs.h"
#include "coupling/store/result_folder.h"
#include "coupling/studies/study_curves.h"
#include "coupling/studies/study_file.h"
#include "coupling/studies/study_folder.h"
#include "coupling/studies/study_output.h"

namespace diptych::coupling
{
  namespace
  {
    StudyPoints asked_by(const CommandLine &line)
    {
      StudyPoints asked{read_study(line.target, line.overrides), {}, line.output};
      asked.points = points_of(asked.study);
      if (asked.directory.empty())
        asked.directory = "results/" + asked.study.name + "_study";
      return asked;
    }

    void write_tables(const StudyPoints &asked, const StudyResults &results, const StudyRecord &record)
    {
      const StudyTables tables{asked.study, asked.points, results, record};
      write_study_json(asked.directory, tables);
      write_study_csv(asked.directory, tables);
      write_study_cost(asked.directory, cost_of(asked.study, asked.points, results, record));
      write_study_curves(asked.directory, tables);
    }

    // "12 points: 7 right, 3 silently wrong, 2 stopped"
    std::string summary(const StudyPoints &asked, const StudyRecord &record)
    {
      std::map<PointClass, int> counts;
      int                       n = 0;
      for (std::size_t k = 0; k < record.points.size(); ++k)
        if (asked.points[k].family >= 0)
          {
            ++counts[record.points[k].kind];
            ++n;
          }
      std::ostringstream text;
      text << n << " points";
      const char *mark = ": ";
      for (const auto &[kind, count] : counts)
        text << mark << count << ' ' << discrete::name_of(kind), mark = ", ";
      return text.str();
    }

    // A window that the loading does not reach, a number that no comparison has.
    void warn_of_missing(const StudyPoints &asked, const StudyRecord &record)
    {
      const PointRecord &reference = record.points.front();
      const bool         finished  = reference.kind != PointClass::not_run && reference.kind != PointClass::stopped &&
                            reference.kind != PointClass::refused;
      for (std::size_t q = 0; finished && q < asked.study.quantities.size(); ++q)
        if (reference.quantities[q].statistics.n == 0)
          std::cerr << "diptych: warning: the reference has no value of '" << asked.study.quantities[q].name
                    << "': a window beyond the end of the loading, or a number that no comparison has" << std::endl;
    }

    int conclude(const CommandLine              &line,
                 const StudyPoints              &asked,
                 const std::vector<TaskOutcome> &outcomes,
                 const StudyRecord              &record)
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
    const StudyPoints asked  = asked_by(line);
    InputFiles        inputs = inputs_of(asked);
    for (const std::string &file : line.set_files)
      inputs.emplace_back("--set-file", file);
    std::optional<FolderLock> lock;
    return keeping(asked.directory, [&] {
      on_first_process([&] {
        lock.emplace(asked.directory);
        open_runs_folder(*lock, folder_of_a_study, asked.study.file, opening_of(line), inputs);
        return 0;
      });
      const auto outcomes = do_runs(line, asked);
      return on_first_process([&] {
        const StudyResults results = results_of(asked);
        const StudyRecord  record  = evaluate(asked.study, asked.points, results);
        write_tables(asked, results, record);
        if (!stop_requested())
          draw_page(line, Drawing::study, asked.directory);
        return conclude(line, asked, outcomes, record);
      });
    });
  }
} // namespace diptych::coupling
