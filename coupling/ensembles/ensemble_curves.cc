// diptych: running means of every member of an ensemble, and their mean
// SPDX-License-Identifier: LGPL-2.1-or-later
#include "coupling/ensembles/ensemble_curves.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "continuum/history.h"
#include "coupling/ensembles/ensemble_folder.h"
#include "coupling/statistics/equivalence.h"
#include "coupling/statistics/history_table.h"
#include "discrete/files/hdf5_file.h"
#include "discrete/files/table_file.h"
#include "discrete/panel/history.h"

namespace diptych::coupling
{
  namespace
  {
    constexpr int n_points = 401;

    const std::vector<std::string> quantities = {"stress_ratio", "volumetric_strain"};

    template <class Row>
    std::vector<HistoryTable> histories(const std::string &directory, const std::vector<int> &seeds, const std::string &file)
    {
      std::vector<HistoryTable> tables;
      for (const int seed : seeds)
        {
          const std::string      path = member_folder(directory, seed) + "/" + file;
          const std::vector<Row> rows = discrete::read_rows<Row>(path);
          if (rows.empty())
            throw std::invalid_argument(path + ": has no rows");
          tables.push_back(history_table(rows));
        }
      return tables;
    }

    double last_progress(const std::vector<HistoryTable> &tables)
    {
      double last = 0;
      for (const HistoryTable &table : tables)
        last = std::max(last, column(table, "progress").back());
      return last;
    }
  } // namespace

  EnsembleCurves with_means(std::vector<std::vector<double>> members)
  {
    EnsembleCurves    curves{std::move(members), {}, {}, {}};
    const std::size_t n = curves.members.empty() ? 0 : curves.members.front().size();
    for (std::size_t k = 0; k < n; ++k)
      {
        std::vector<double> values;
        for (const std::vector<double> &member : curves.members)
          values.push_back(member[k]);
        const bool             known = std::all_of(values.begin(), values.end(), [](const double v) { return std::isfinite(v); });
        const SampleStatistics s     = known ? statistics(values) : SampleStatistics();
        curves.mean.push_back(s.mean), curves.low.push_back(s.low), curves.high.push_back(s.high);
      }
    return curves;
  }

  void check_member_histories(const std::string &directory, const std::vector<int> &seeds)
  {
    (void)histories<discrete::HistoryRow>(directory, seeds, "discrete.csv");
    (void)histories<continuum::HistoryRow>(directory, seeds, "continuum.csv");
  }

  void write_ensemble_curves(const std::string &directory, const Scene &scene, const std::vector<int> &seeds)
  {
    const auto   discrete  = histories<discrete::HistoryRow>(directory, seeds, "discrete.csv");
    const auto   continuum = histories<continuum::HistoryRow>(directory, seeds, "continuum.csv");
    const double last      = std::max(last_progress(discrete), last_progress(continuum));
    EnsembleGrid grid{{}, seeds, averaging_width(scene)};
    for (int k = 0; k < n_points; ++k)
      grid.progress.push_back(last * k / (n_points - 1));

    discrete::Hdf5Writer file(directory + "/ensemble.h5");
    list_grid(grid, IntoGroup{file, "/"});
    for (const auto &[panel, tables] : {std::pair{"discrete", &discrete}, std::pair{"continuum", &continuum}})
      for (const std::string &quantity : quantities)
        {
          std::vector<std::vector<double>> members;
          for (const HistoryTable &table : *tables)
            members.push_back(
              resampled(column(table, "progress"), running_mean(table, quantity, grid.averaging_width), grid.progress));
          list_curve_arrays(with_means(std::move(members)), IntoGroup{file, std::string(panel) + "/" + quantity});
        }
    file.finish();
  }
} // namespace diptych::coupling
