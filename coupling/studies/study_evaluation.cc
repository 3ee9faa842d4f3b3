// diptych: errors of the points of a study against its reference, their classes, orders of convergence
// SPDX-License-Identifier: LGPL-2.1-or-later
#include "coupling/studies/study_evaluation.h"

#include <algorithm>
#include <cmath>
#include <map>

#include "coupling/cells/principal_axes.h"
#include "coupling/statistics/student.h"
#include "coupling/studies/convergence_order.h"

namespace diptych::coupling
{
  namespace
  {
    std::vector<double> values_of(const std::vector<RunResult> &runs, const std::size_t quantity)
    {
      std::vector<double> values;
      for (const RunResult &run : runs)
        values.push_back(run.values[quantity]);
      return values;
    }

    std::vector<double> known(const std::vector<double> &values)
    {
      std::vector<double> result;
      std::copy_if(values.begin(), values.end(), std::back_inserter(result), [](const double v) { return std::isfinite(v); });
      return result;
    }

    SampleStatistics statistics_of(const StudyQuantity &quantity, const std::vector<double> &values)
    {
      return quantity.is_line ? line_statistics(known(values)) : statistics(known(values));
    }

    Equivalence compare(const StudyQuantity &quantity, const std::vector<double> &reference, const std::vector<double> &values)
    {
      std::vector<double> first, second, difference, turn;
      for (std::size_t k = 0; k < values.size(); ++k)
        if (std::isfinite(reference[k]) && std::isfinite(values[k]))
          {
            first.push_back(reference[k]), second.push_back(values[k]);
            difference.push_back(values[k] - reference[k]), turn.push_back(line_turn(values[k], reference[k]));
          }
      const double margin = quantity.limit.value_or(1);
      if (quantity.is_relative)
        return compare_relative(first, second, margin);
      return quantity.is_line ? compare_turns(turn, margin) : compare_differences(difference, margin);
    }

    // If only the reference has a value, the point is beyond any limit. One sample has no interval, so its error decides. With
    // several samples an unknown interval leaves a doubt.
    std::string verdict_of(const StudyQuantity &quantity,
                           const PointQuantity &point,
                           const bool           reference_has_it,
                           const bool           is_alone)
    {
      if (!quantity.limit)
        return "";
      if (point.pairs == 0)
        return reference_has_it ? "beyond" : "cannot tell";
      const double   limit = *quantity.limit;
      const Interval e     = point.error;
      if (is_alone)
        return std::abs(e.value) <= limit ? "within" : "beyond";
      if (e.low > -limit && e.high < limit)
        return "within";
      return e.low > limit || e.high < -limit ? "beyond" : "cannot tell";
    }

    bool is_beyond_limit(const StudyQuantity &quantity, const PointQuantity &point)
    {
      return point.verdict == "beyond" || (point.verdict == "cannot tell" && std::abs(point.error.value) > *quantity.limit);
    }

    double scatter_of(const StudyQuantity &quantity, const std::vector<double> &reference)
    {
      const SampleStatistics s = statistics_of(quantity, reference);
      return quantity.is_relative ? s.deviation / std::abs(s.mean) : s.deviation;
    }

    PointQuantity quantity_at(const StudyQuantity       &quantity,
                              const std::vector<double> &reference,
                              const std::vector<double> &values,
                              const bool                 is_alone)
    {
      PointQuantity     result;
      const Equivalence found = compare(quantity, reference, values);
      result.values           = values;
      result.statistics       = statistics_of(quantity, values);
      result.pairs            = found.n;
      result.error            = found.difference;
      result.scatter          = scatter_of(quantity, reference);
      result.verdict          = verdict_of(quantity, result, !known(reference).empty(), is_alone);
      return result;
    }

    void add_facts(const std::vector<RunResult> &runs, PointRecord &point)
    {
      for (const RunResult &run : runs)
        {
          point.warned += int(run.warned);
          point.halved_steps = std::max(point.halved_steps, run.halved_steps);
          point.cut_backs    = std::max(point.cut_backs, run.cut_backs);
          if (point.words.empty())
            point.words = run.words;
        }
    }

    bool any(const std::vector<RunResult> &runs, bool (*is_so)(const RunResult &))
    {
      return std::any_of(runs.begin(), runs.end(), is_so);
    }

    void classify(const Study &study, const std::vector<RunResult> &runs, PointRecord &point)
    {
      point.is_certain = true;
      if (any(runs, [](const RunResult &run) { return !run.is_known; }))
        point.kind = PointClass::not_run;
      else if (any(runs, [](const RunResult &run) { return run.is_refused; }))
        point.kind = PointClass::refused;
      else if (any(runs, [](const RunResult &run) { return run.exit_code != 0; }))
        point.kind = PointClass::stopped;
      else
        {
          bool is_judged = false, is_wrong = false, is_sure_wrong = false, is_sure_right = true;
          for (std::size_t k = 0; k < study.quantities.size(); ++k)
            if (const PointQuantity &quantity = point.quantities[k]; study.quantities[k].limit)
              {
                is_judged     = is_judged || quantity.pairs > 0 || quantity.verdict == "beyond";
                is_wrong      = is_wrong || is_beyond_limit(study.quantities[k], quantity);
                is_sure_wrong = is_sure_wrong || quantity.verdict == "beyond";
                is_sure_right = is_sure_right && quantity.verdict == "within";
              }
          const bool struggled = point.halved_steps > 0 || point.cut_backs > 0;
          point.kind           = !is_judged ? PointClass::unjudged
                                 : is_wrong ? (point.warned > 0 ? PointClass::wrong_warned : PointClass::silently_wrong)
                                            : (struggled ? PointClass::struggled : PointClass::right);
          point.is_certain     = is_judged && (is_wrong ? is_sure_wrong : is_sure_right);
        }
    }

    // Points along one axis that share all other settings, by the labels of the other axes.
    using Lines = std::map<std::vector<std::string>, std::vector<std::size_t>>;

    Lines lines_along(const std::vector<ScenePoint> &points, const int family, const std::size_t axis)
    {
      Lines lines;
      for (std::size_t k = 0; k < points.size(); ++k)
        if (points[k].family == family)
          {
            std::vector<std::string> others = points[k].labels;
            others[axis].clear();
            lines[others].push_back(k);
          }
      return lines;
    }

    // Means over the samples that every point has, except the sample `left_out`.
    struct AxisLine
    {
      std::vector<double>              h;
      std::vector<std::vector<double>> values; // [point][sample]

      std::vector<double> means(const std::size_t left_out) const
      {
        std::vector<double> result;
        for (const std::vector<double> &point : values)
          {
            double sum = 0, n = 0;
            for (std::size_t k = 0; k < point.size(); ++k)
              if (k != left_out)
                sum += point[k], ++n;
            result.push_back(sum / n);
          }
        return result;
      }
    };

    // Tukey's jackknife.
    Interval jackknifed(const double value, const std::vector<double> &without_one)
    {
      const int n = int(without_one.size());
      if (n < 3)
        return {value};
      const SampleStatistics s    = statistics(without_one);
      const double           half = student_quantile(0.975, n - 1) * (n - 1) / std::sqrt(double(n)) * s.deviation;
      return {value, value - half, value + half};
    }

    std::optional<OrderRecord> order_along(const AxisLine &line)
    {
      constexpr std::size_t none = std::size_t(-1);
      const auto            all  = line.h.size() < 3 ? std::nullopt : fit_convergence(line.h, line.means(none));
      if (!all)
        return std::nullopt;
      std::vector<double> orders, limits;
      for (std::size_t k = 0; k < line.values.front().size() && line.values.front().size() > 2; ++k)
        if (const auto part = fit_convergence(line.h, line.means(k)))
          orders.push_back(part->order), limits.push_back(part->limit);
      if (orders.size() < line.values.front().size()) // without that sample there is no power law
        orders.clear(), limits.clear();
      OrderRecord record;
      record.points      = int(line.h.size());
      record.order       = jackknifed(all->order, orders);
      record.limit       = jackknifed(all->limit, limits);
      record.coefficient = all->coefficient;
      return record;
    }

    // The points of the line that have all their values.
    AxisLine line_of(const std::vector<std::size_t> &on_line,
                     const std::vector<double>      &h,
                     const std::vector<PointRecord> &points,
                     const std::size_t               quantity)
    {
      AxisLine line;
      for (std::size_t k = 0; k < on_line.size(); ++k)
        {
          const std::vector<double> &values = points[on_line[k]].quantities[quantity].values;
          if (!values.empty() && known(values).size() == values.size())
            line.h.push_back(h[k]), line.values.push_back(values);
        }
      return line;
    }

    std::vector<OrderRecord> orders_of(const Study &study, const std::vector<ScenePoint> &points, const StudyRecord &record)
    {
      std::vector<OrderRecord> orders;
      for (std::size_t f = 0; f < study.families.size(); ++f)
        for (std::size_t a = 0; a < study.families[f].axes.size(); ++a)
          if (const Axis &axis = study.families[f].axes[a]; axis.converges && study.families[f].is_grid)
            for (const auto &[labels, on_line] : lines_along(points, int(f), a))
              for (std::size_t q = 0; q < study.quantities.size(); ++q)
                {
                  std::vector<double> h;
                  for (const std::size_t k : on_line)
                    h.push_back(axis.points[points[k].places[a]].value);
                  if (auto found = order_along(line_of(on_line, h, record.points, q)))
                    {
                      found->family = f, found->axis = a, found->quantity = q, found->labels = labels;
                      orders.push_back(*found);
                    }
                }
      return orders;
    }
  } // namespace

  StudyRecord evaluate(const Study &study, const std::vector<ScenePoint> &points, const StudyResults &results)
  {
    StudyRecord record;
    for (std::size_t k = 0; k < points.size(); ++k)
      {
        PointRecord point;
        for (std::size_t q = 0; q < study.quantities.size(); ++q)
          point.quantities.push_back(quantity_at(study.quantities[q], values_of(results[points[k].reference], q),
                                                 values_of(results[k], q), study.seeds.empty()));
        add_facts(results[k], point);
        classify(study, results[k], point);
        record.points.push_back(std::move(point));
      }
    record.orders = orders_of(study, points, record);
    return record;
  }
} // namespace diptych::coupling
