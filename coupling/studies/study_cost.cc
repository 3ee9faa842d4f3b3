// diptych: cost of the points of a study, and the cheapest right ones
// SPDX-License-Identifier: LGPL-2.1-or-later
#include "coupling/studies/study_cost.h"

#include <algorithm>
#include <set>
#include <utility>

namespace diptych::coupling
{
  namespace
  {
    constexpr double spare_process = 0.5;

    bool counts(const Study &study, const std::string &phase)
    {
      return study.cost.empty() ? phase != "report" : std::find(study.cost.begin(), study.cost.end(), phase) != study.cost.end();
    }

    PointCost mean_cost(const Study &study, const std::vector<RunResult> &runs, const std::size_t point)
    {
      PointCost cost;
      cost.point = int(point);
      for (const RunResult &run : runs)
        {
          cost.disturbed += int(is_disturbed(run));
          for (const PhaseCost &phase : run.phases)
            {
              const auto is_it = [&](const PhaseMean &mean) { return mean.name == phase.name; };
              auto       found = std::find_if(cost.phases.begin(), cost.phases.end(), is_it);
              if (found == cost.phases.end())
                found = cost.phases.insert(cost.phases.end(), {phase.name});
              found->cpu_s += phase.cpu_s / double(runs.size());
              cost.peak_memory_mb = std::max(cost.peak_memory_mb, phase.peak_memory_mb);
            }
        }
      for (const PhaseMean &phase : cost.phases)
        cost.cpu_s += counts(study, phase.name) ? phase.cpu_s : 0;
      return cost;
    }

    bool is_finished(const PointRecord &point)
    {
      return point.kind != PointClass::not_run && point.kind != PointClass::refused && point.kind != PointClass::stopped;
    }

    // The finished points that share a reference.
    using Rivals = std::vector<PointCost *>;

    // Equal runs: a point that is its own reference has no error and must not compete.
    bool is_same(const ScenePoint &a, const ScenePoint &b)
    {
      return !a.runs.empty() && std::equal(a.runs.begin(), a.runs.end(), b.runs.begin(), b.runs.end(),
                                           [](const StudyRun &one, const StudyRun &other) { return one.name == other.name; });
    }

    std::vector<Rivals> by_reference(const std::vector<ScenePoint> &points, StudyCost &cost)
    {
      std::vector<Rivals> groups;
      for (PointCost &one : cost.points)
        if (const ScenePoint &point = points[std::size_t(one.point)];
            point.family >= 0 && !is_same(point, points[point.reference]))
          {
            groups.resize(std::max(groups.size(), point.reference + 1));
            groups[point.reference].push_back(&one);
          }
      return groups;
    }

    void mark_fronts(const Study &study, const StudyRecord &record, const Rivals &rivals)
    {
      for (std::size_t q = 0; q < study.quantities.size(); ++q)
        {
          const auto error = [&](const PointCost &c) {
            return std::abs(record.points[std::size_t(c.point)].quantities[q].error.value);
          };
          for (PointCost *one : rivals)
            if (std::isfinite(error(*one)) && std::none_of(rivals.begin(), rivals.end(), [&](const PointCost *other) {
                  return other->cpu_s < one->cpu_s && error(*other) < error(*one);
                }))
              one->front_of.push_back(study.quantities[q].name);
        }
    }

    // Largest distance of a quantity's error from 0: of its mean, and of its interval. A single sample has no interval.
    struct Reach
    {
      double found, possible;
    };

    Reach reach_of(const Study &study, const PointRecord &point, const std::size_t quantity)
    {
      const Interval &e     = point.quantities[quantity].error;
      const double    found = std::abs(e.value);
      return {found, study.seeds.empty() ? found : std::max(std::abs(e.low), std::abs(e.high))};
    }

    // The cheapest point at which no reach exceeds its accuracy; reaches(point) returns pairs of both.
    template <class Reaches> CheapestPoint cheapest(const Rivals &rivals, CheapestPoint wanted, Reaches &&reaches)
    {
      for (const PointCost *one : rivals)
        {
          bool keeps = !(one->cpu_s >= wanted.cpu_s), certain = true;
          for (const auto &[reach, accuracy] : reaches(std::size_t(one->point)))
            keeps = keeps && reach.found <= accuracy, certain = certain && reach.possible <= accuracy;
          if (keeps)
            wanted.point = one->point, wanted.cpu_s = one->cpu_s, wanted.is_certain = certain;
        }
      return wanted;
    }

    std::vector<CheapestPoint> find_cheapest(const Study       &study,
                                             const StudyRecord &record,
                                             const Rivals      &rivals,
                                             const int          reference)
    {
      using Pairs                       = std::vector<std::pair<Reach, double>>;
      const std::vector<double>  shares = {0.05, 0.02, 0.01}, multiples = {2.5, 1, 0.5};
      std::vector<CheapestPoint> result;
      for (std::size_t q = 0; q < study.quantities.size(); ++q)
        if (const StudyQuantity &quantity = study.quantities[q]; quantity.limit)
          for (std::size_t k = 0; k < shares.size(); ++k)
            {
              const double accuracy = quantity.is_relative ? shares[k] : multiples[k] * *quantity.limit;
              result.push_back(cheapest(rivals, {quantity.name, accuracy, reference}, [&](const std::size_t point) {
                return Pairs{{reach_of(study, record.points[point], q), accuracy}};
              }));
            }
      if (result.empty()) // no quantity has a limit, so no point is right
        return result;
      for (const double multiple : multiples)
        result.push_back(cheapest(rivals, {"", multiple, reference}, [&](const std::size_t point) {
          Pairs pairs;
          for (std::size_t q = 0; q < study.quantities.size(); ++q)
            if (study.quantities[q].limit)
              pairs.emplace_back(reach_of(study, record.points[point], q), multiple * *study.quantities[q].limit);
          return pairs;
        }));
      return result;
    }
  } // namespace

  bool is_disturbed(const RunResult &run)
  {
    return run.load > run.at_once + spare_process;
  }

  StudyCost cost_of(const Study                   &study,
                    const std::vector<ScenePoint> &points,
                    const StudyResults            &results,
                    const StudyRecord             &record)
  {
    StudyCost             cost;
    std::set<std::string> phases, counted;
    for (std::size_t k = 0; k < results.size(); ++k)
      {
        for (std::size_t sample = 0; sample < results[k].size(); ++sample)
          {
            const RunResult &run = results[k][sample];
            // Points may share runs.
            if (sample < points[k].runs.size() && !counted.insert(points[k].runs[sample].name).second)
              continue;
            cost.runs += int(run.is_known && !run.phases.empty());
            cost.disturbed += int(is_disturbed(run));
            for (const PhaseCost &phase : run.phases)
              cost.total_cpu_s += phase.cpu_s, phases.insert(phase.name);
          }
        if (is_finished(record.points[k]))
          cost.points.push_back(mean_cost(study, results[k], k));
      }
    std::copy_if(phases.begin(), phases.end(), std::back_inserter(cost.phases),
                 [&](const std::string &phase) { return counts(study, phase); });
    const std::vector<Rivals> groups = by_reference(points, cost);
    for (std::size_t k = 0; k < groups.size(); ++k)
      {
        mark_fronts(study, record, groups[k]);
        for (const CheapestPoint &one : find_cheapest(study, record, groups[k], int(k)))
          cost.cheapest.push_back(one);
      }
    return cost;
  }
} // namespace diptych::coupling
