// diptych: an ensemble as files
// SPDX-License-Identifier: LGPL-2.1-or-later
#include "coupling/ensembles/ensemble_output.h"

#include <cmath>
#include <sstream>

#include <nlohmann/json.hpp>

#include "coupling/scene/keys.h"
#include "discrete/files/text_file.h"

#include "coupling/statistics/student.h"

namespace diptych::coupling
{
  namespace
  {
    using nlohmann::json;

    json number(const double value)
    {
      return std::isfinite(value) ? json(value) : json(nullptr);
    }

    json list(const std::vector<double> &values)
    {
      json result = json::array();
      for (const double value : values)
        result.push_back(number(value));
      return result;
    }

    json interval_json(const Interval &interval)
    {
      return {{"value", number(interval.value)}, {"low", number(interval.low)}, {"high", number(interval.high)}};
    }

    json quantity_json(const Quantity &quantity)
    {
      const SampleStatistics &s = quantity.statistics;
      return {{"name", quantity.name},
              {"unit", quantity.unit},
              {"n", s.n},
              {"mean", number(s.mean)},
              {"deviation", number(s.deviation)},
              {"low", number(s.low)},
              {"high", number(s.high)},
              {"values", list(quantity.values)}};
    }

    json verdict_json(const PanelVerdict &verdict)
    {
      const Equivalence &e = verdict.equivalence;
      return {{"quantity", verdict.quantity},
              {"unit", verdict.unit},
              {"margin", verdict.margin},
              {"relative", verdict.relative},
              {"difference", interval_json(e.difference)},
              {"difference_90", interval_json(e.difference_90)},
              {"n", e.n},
              {"verdict", text_of(e.verdict)},
              {"discrete", list(verdict.discrete)},
              {"continuum", list(verdict.continuum)}};
    }

    // "one band in 6 of 8, none in 2"
    std::string text_of(const BandCount &count)
    {
      const int   n = count.members[0] + count.members[1] + count.members[2];
      std::string text;
      for (const auto &[words, members] : {std::pair{"one band", count.members[1]}, std::pair{"two bands", count.members[2]},
                                           std::pair{"none", count.members[0]}})
        if (members > 0)
          text += (text.empty() ? "" : ", ") + std::string(words) + " in " + std::to_string(members) +
                  (text.empty() ? " of " + std::to_string(n) : "");
      return text;
    }

    json margins_json(const EquivalenceMargins &margins)
    {
      json                        result = json::object();
      std::vector<KeyDescription> keys;
      EquivalenceMargins          copy = margins;
      visit_parameters(copy, DescribeKeys{"comparison", keys});
      for (const KeyDescription &key : keys)
        result[key.name] = std::stod(key.value);
      return result;
    }
  } // namespace

  void write_ensemble_json(const std::string &directory, const Scene &scene, const EnsembleRecord &record)
  {
    const Ensemble &ensemble = record.ensemble;
    const int       n        = int(ensemble.seeds.size());
    json            root     = {{"format", 1},
                                {"scene", scene.name},
                                {"seeds", record.seeds},
                                {"done", ensemble.seeds},
                                {"failed", json::array()},
                                {"interrupted", record.interrupted},
                                {"margins", margins_json(scene.comparison.margins)},
                                {"walk", discrete::name_of(discrete::walk_of(scene.loading.mode))},
                                {"folded", is_mirror_symmetric(scene)},
                                {"student_t_95", n > 1 ? json(student_quantile(0.975, n - 1)) : json(nullptr)},
                                {"quantities", json::array()},
                                {"bands", json::array()},
                                {"verdicts", json::array()}};
    for (const FailedMember &member : record.failed)
      root["failed"].push_back({{"seed", member.seed}, {"exit_code", member.exit_code}, {"message", member.message}});
    for (const Quantity &quantity : ensemble.quantities)
      root["quantities"].push_back(quantity_json(quantity));
    for (const BandCount &count : ensemble.bands)
      root["bands"].push_back({{"name", count.name},
                               {"none", count.members[0]},
                               {"one", count.members[1]},
                               {"two", count.members[2]},
                               {"text", text_of(count)}});
    for (const PanelVerdict &verdict : ensemble.verdicts)
      root["verdicts"].push_back(verdict_json(verdict));
    discrete::write_text(directory + "/ensemble.json", root.dump(1) + "\n");
  }

  void write_ensemble_csv(const std::string &directory, const Ensemble &ensemble)
  {
    std::ostringstream out;
    out.precision(10);
    out << "quantity,unit,n,mean,deviation,low,high";
    for (const int seed : ensemble.seeds)
      out << ",seed_" << seed;
    out << '\n';
    const auto entry = [&](const double value) {
      out << ',';
      if (std::isfinite(value))
        out << value;
    };
    for (const Quantity &quantity : ensemble.quantities)
      {
        const SampleStatistics &s = quantity.statistics;
        out << quantity.name << ',' << quantity.unit << ',' << s.n;
        for (const double value : {s.mean, s.deviation, s.low, s.high})
          entry(value);
        for (const double value : quantity.values)
          entry(value);
        out << '\n';
      }
    discrete::write_text(directory + "/ensemble.csv", out.str());
  }
} // namespace diptych::coupling
