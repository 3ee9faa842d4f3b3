// diptych: curves of the points of a study
// SPDX-License-Identifier: LGPL-2.1-or-later
#include "coupling/studies/study_curves.h"

#include <algorithm>
#include <filesystem>
#include <limits>

#include "coupling/statistics/history_table.h"
#include "discrete/files/hdf5_file.h"

namespace diptych::coupling
{
  namespace
  {
    constexpr int n_points = 201;

    std::vector<Source> panels_of(const StudyCommand command)
    {
      switch (command)
        {
        case StudyCommand::discrete:
          return {Source::discrete};
        case StudyCommand::continuum:
          return {Source::continuum};
        case StudyCommand::material_point:
          return {Source::material_point};
        default:
          return {Source::discrete, Source::continuum};
        }
    }

    using Tables = std::vector<std::vector<HistoryTable>>; // [point][sample]; empty where there is none

    Tables tables_of(const std::string &directory, const StudyTables &study, const Source source)
    {
      Tables tables;
      for (std::size_t point = 0; point < study.points.size(); ++point)
        {
          tables.emplace_back();
          for (std::size_t sample = 0; sample < study.results[point].size(); ++sample)
            tables.back().push_back(study.results[point][sample].exit_code == 0 && study.results[point][sample].is_known
                                      ? panel_table(run_folder(directory, study.points[point].runs[sample]), source)
                                      : HistoryTable());
        }
      return tables;
    }

    double last_progress(const Tables &tables)
    {
      double last = 0;
      for (const std::vector<HistoryTable> &point : tables)
        for (const HistoryTable &table : point)
          if (!table.empty() && !table.at("progress").empty())
            last = std::max(last, table.at("progress").back());
      return last;
    }

    std::vector<double> mean_curve(const std::vector<HistoryTable> &samples, const std::string &name, const StudyGrid &grid)
    {
      std::vector<double> sum(grid.progress.size(), 0.);
      for (const HistoryTable &table : samples)
        {
          const bool known = !table.empty() && !table.at("progress").empty();
          for (std::size_t k = 0; k < sum.size() && !known; ++k)
            sum[k] = std::numeric_limits<double>::quiet_NaN();
          if (!known)
            continue;
          const std::vector<double> values = resampled(table.at("progress"), running_mean(table, name, grid.averaging_width),
                                                       grid.progress);
          for (std::size_t k = 0; k < sum.size(); ++k)
            sum[k] += values[k] / double(samples.size());
        }
      return sum;
    }
  } // namespace

  void write_study_curves(const std::string &directory, const StudyTables &tables)
  {
    discrete::Hdf5Writer file(directory + "/study.h5");
    for (const Source source : panels_of(tables.study.command))
      {
        const Tables histories = tables_of(directory, tables, source);
        StudyGrid    grid{{}, averaging_width(*tables.points.front().runs.front().scene)};
        const double last = last_progress(histories);
        for (int k = 0; k < n_points; ++k)
          grid.progress.push_back(last * k / (n_points - 1));
        StudyCurves curves;
        for (const std::vector<HistoryTable> &samples : histories)
          {
            curves.stress_ratio.push_back(mean_curve(samples, "stress_ratio", grid));
            curves.volumetric_strain.push_back(mean_curve(samples, "volumetric_strain", grid));
          }
        const std::string group = discrete::name_of(source);
        list_grid(grid, IntoGroup{file, group});
        list_curve_arrays(curves, IntoGroup{file, group});
      }
    file.finish();
  }
} // namespace diptych::coupling
