// diptych: comparison of runs of one sample with different lengths of the step
// SPDX-License-Identifier: LGPL-2.1-or-later
#include "coupling/program/step_comparison.h"

#include <algorithm>
#include <cmath>
#include <sstream>
#include <stdexcept>

#include "coupling/numbers/number_json.h"
#include "discrete/files/text_file.h"
#include "coupling/store/file_names.h"
#include "discrete/panel/history.h"

namespace diptych::coupling
{
  namespace
  {
    // Columns of discrete.csv that study_step.csv repeats.
    const std::vector<std::string> repeated = {"stress_ratio",       "external_work",  "friction_dissipation",
                                               "impact_dissipation", "kinetic_energy", "max_penetration"};

    const std::vector<std::string> cumulated = {"external_work", "friction_dissipation", "impact_dissipation"};

    constexpr int    n_instants = 200; // number of instants at which runs are compared
    constexpr double margin     = 0.05;

    // Value of a cumulated column at an instant: on the broken line through its rows, which begins with 0.
    double value_at(const HistoryTable &table, const std::string &name, const double time)
    {
      const std::vector<double> &x = column(table, "time"), &y = column(table, name);
      const std::size_t          k = std::size_t(std::lower_bound(x.begin(), x.end(), time) - x.begin());
      if (k >= x.size())
        return y.back();
      const double x0 = k == 0 ? 0. : x[k - 1], y0 = k == 0 ? 0. : y[k - 1];
      return x[k] > x0 ? y0 + (y[k] - y0) * (time - x0) / (x[k] - x0) : y[k];
    }

    double measured(const HistoryTable &table, const std::string &name, const double time, const double window)
    {
      if (name == "stress_ratio")
        return mean_over(table, {"time", name}, std::max(0., time - window), time);
      return value_at(table, name, time);
    }

    // Instants that all runs have reached, beginning after one averaging window.
    std::vector<double> instants(const std::vector<StepRun> &runs, const double window)
    {
      double end = column(runs.front().history, "time").back();
      for (const StepRun &run : runs)
        end = std::min(end, column(run.history, "time").back());
      const double        from = std::min(window, 0.5 * end);
      std::vector<double> x;
      for (int k = 0; k <= n_instants; ++k)
        x.push_back(from + (end - from) * k / n_instants);
      return x;
    }
  } // namespace

  StepComparison compare_steps(const std::vector<StepRun>     &runs,
                               const double                    width,
                               const discrete::LoadingVariable loading_variable)
  {
    if (runs.size() < 2)
      throw std::invalid_argument("a study of the step needs at least two runs");
    const HistoryTable &finest = runs.back().history;
    const double        end    = column(finest, "time").back();
    // The window in units of time, because all quantities are compared at equal times.
    const double              window = end * std::min(1., width / std::abs(column(finest, "progress").back()));
    const std::vector<double> x      = instants(runs, window);
    std::vector<std::string>  names{"stress_ratio"};
    names.insert(names.end(), cumulated.begin(), cumulated.end());
    StepComparison comparison;
    comparison.window = window;
    comparison.margin = margin;
    for (const StepRun &run : runs)
      comparison.steps.push_back(run.step);
    for (const std::string &name : names)
      {
        StepComparison::Quantity q{name, {}, 0};
        double                   scale     = 0;
        const std::string        scaled_by = name == "stress_ratio" ? name : "external_work";
        for (const double time : x)
          scale = std::max(scale, std::abs(measured(finest, scaled_by, time, window)));
        for (const StepRun &run : runs)
          {
            double largest = 0;
            for (const double time : x)
              {
                const double difference = std::abs(measured(run.history, name, time, window) -
                                                   measured(finest, name, time, window));
                if (difference > largest && &run == &runs.front())
                  q.at_progress = value_at(finest, "progress", time);
                largest = std::max(largest, difference);
              }
            q.largest_difference.push_back(scale > 0 ? largest / scale : 0);
          }
        comparison.largest = std::max(comparison.largest, q.largest_difference.front());
        comparison.quantities.push_back(q);
      }
    const auto worst = std::max_element(
      comparison.quantities.begin(), comparison.quantities.end(),
      [](const auto &a, const auto &b) { return a.largest_difference.front() < b.largest_difference.front(); });
    std::ostringstream text;
    text.precision(3);
    text << "step " << runs.front().step << " against " << runs.back().step << ": "
         << (comparison.largest <= margin ? "the step does not matter" : "the step matters") << ", largest difference "
         << 100 * comparison.largest << " % (" << worst->name << ", at " << text_of(loading_variable, worst->at_progress)
         << "; margin " << 100 * margin << " %)";
    comparison.verdict = text.str();
    return comparison;
  }

  std::vector<NumberEntry> step_study_columns()
  {
    std::vector<NumberEntry>   columns{{"step", "time", "requested length of the step of the run"},
                                     {"time", "time", "time since the start of the loading"},
                                     {"progress", "strain or time", "progress of the loading"},
                                     {"stress_ratio_mean", "-", "running mean of the stress ratio"}};
    const discrete::HistoryRow row;
    for (const std::string &name : repeated)
      visit_columns(row, [&](const char *key, const auto &, const char *unit, const char *meaning) {
        if (key == name)
          columns.push_back({key, unit, meaning});
      });
    return columns;
  }

  void write_step_comparison(const std::string &directory, const std::vector<StepRun> &runs, const StepComparison &comparison)
  {
    std::ostringstream csv;
    csv.precision(10);
    csv << header_of(step_study_columns()) << '\n';
    for (const StepRun &run : runs)
      {
        HistoryTable in_time           = run.history;
        in_time["progress"]            = column(run.history, "time");
        const std::vector<double> mean = running_mean(in_time, "stress_ratio", comparison.window);
        for (std::size_t k = 0; k < column(run.history, "time").size(); ++k)
          {
            csv << run.step << ',' << column(run.history, "time")[k] << ',' << column(run.history, "progress")[k] << ','
                << mean[k];
            for (const std::string &name : repeated)
              csv << ',' << column(run.history, name)[k];
            csv << '\n';
          }
      }
    discrete::write_text(study_step(directory, ".csv"), csv.str());

    nlohmann::json root = nlohmann::json::object();
    NumbersToJson  writer{root, 1};
    list_numbers(comparison, writer);
    discrete::write_text(study_step(directory, ".json"), root.dump(1) + "\n");
  }
} // namespace diptych::coupling
