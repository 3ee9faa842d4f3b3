// diptych: the comparison as files
// SPDX-License-Identifier: LGPL-2.1-or-later
#include "coupling/comparison/comparison_output.h"

#include <cmath>
#include <sstream>

#include <nlohmann/json.hpp>

#include "coupling/comparison/stage_json.h"
#include "coupling/comparison/summary_json.h"
#include "discrete/text_file.h"

namespace diptych::coupling
{
  namespace
  {
    using nlohmann::json;

    // One line a known number of a JSON value: `line` names where it belongs; an interval stands in one line with its ends.
    void write_lines(std::ostream &out, const json &value, const std::string &line, const std::string &quantity)
    {
      const auto known = [](const json &v) { return v.is_number() && std::isfinite(v.get<double>()); };
      const auto text  = [&](const json &v) { return known(v) ? v.dump() : std::string(); };
      if (value.is_object() && value.contains("value") && value.contains("low"))
        out << line << quantity << ',' << text(value["value"]) << ',' << text(value["low"]) << ',' << text(value["high"]) << '\n';
      else if (known(value))
        out << line << quantity << ',' << text(value) << ",,\n";
      else if (value.is_structured())
        for (const auto &[key, part] : value.items())
          {
            const bool  list = value.is_array();
            std::string name = list && part.is_object() && part.contains("name") ? part["name"].get<std::string>() : key;
            if (list && name == key)
              name = std::to_string(std::stoi(key) + 1);
            write_lines(out, part, line, quantity.empty() ? name : quantity + "/" + name);
          }
    }

    std::string comparison_csv(const json &comparison)
    {
      std::ostringstream out;
      out << "axial_strain_from,axial_strain_to,panel,quantity,value,low,high\n";
      const auto write_increments = [&out](const json &increments, const std::string &prefix) {
        for (const json &increment : increments)
          {
            const json &from = increment.contains("from") ? increment["from"] : json(),
                       &to   = increment.contains("to") ? increment["to"] : increment["axial_strain"];
            for (const auto &[panel, part] : increment.items())
              if (part.is_structured())
                write_lines(out, part, from.dump() + ',' + to.dump() + ',' + prefix + panel + ',', "");
          }
      };
      write_increments(comparison["stages"], "");
      write_increments(comparison["windows"], "");
      write_increments(comparison["continuum_coarse"]["windows"], "coarse_");
      for (const char *part : {"discrete_summary", "continuum_summary", "resolution_study", "theory", "cost"})
        write_lines(out, comparison[part], std::string(",,") + part + ',', "");
      return out.str();
    }
  } // namespace

  void write_comparison(const std::string &directory, const Scene &scene, const Comparison &c, const json &provenance)
  {
    const double d    = scene.sample.mean_diameter;
    json         root = {{"format", 1},
                         {"scene", scene.name},
                         {"seed", scene.sample.seed},
                         {"units",
                          {{"length", "mean diameter d where the name ends in _d, else the scene's"},
                           {"stress", "the scene's pressure unit, compression positive"},
                           {"time", "the scene's"}}},
                         {"mean_diameter", d},
                         {"pressure", scene.loading.pressure},
                         {"stages", json::array()},
                         {"windows", json::array()}};
    for (const StageRecord &stage : c.stages)
      root["stages"].push_back(stage_json(stage, d, scene.comparison.averaging.method));
    for (const Increment &window : c.windows)
      root["windows"].push_back(window_json(window, d));
    json &coarse = root["continuum_coarse"] = {
      {"element_size_d", c.coarse.element_size}, {"peak_stress_ratio", c.coarse.peak.value}, {"windows", json::array()}};
    for (const Increment &window : c.coarse.windows)
      coarse["windows"].push_back({{"from", window.from}, {"to", window.to}, {"bands", bands_json(window.continuum.band, d)}});
    root["discrete_summary"]  = discrete_summary(scene, c, provenance);
    root["continuum_summary"] = continuum_summary(scene, c, provenance);
    root["cost"]              = cost_json(provenance);
    root["resolution_study"]  = resolution_json(c.resolution);
    root["theory"]            = nullptr;
    if (c.theory)
      root["theory"] = {
        {"coulomb_deg", c.theory->coulomb_deg}, {"roscoe_deg", c.theory->roscoe_deg}, {"arthur_deg", c.theory->arthur_deg}};
    discrete::write_text(directory + "/comparison.json", root.dump(1) + "\n");
    discrete::write_text(directory + "/comparison.csv", comparison_csv(root));
  }
} // namespace diptych::coupling
