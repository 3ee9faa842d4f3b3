// diptych: counts, extremes and costs of a whole run, as JSON
// SPDX-License-Identifier: LGPL-2.1-or-later
#include "coupling/comparison/summary_json.h"

#include <cmath>

#include <nlohmann/json.hpp>

#include "coupling/comparison/platen_balance.h"

namespace diptych::coupling
{
  using nlohmann::json;

  namespace
  {
    double largest(const std::vector<double> &values)
    {
      double result = 0;
      for (const double value : values)
        result = std::max(result, std::abs(value));
      return result;
    }

    json balance_json(const HistoryTable &history)
    {
      const PlatenBalance balance = platen_balance(history);
      return {{"platen_difference_share_below_1_percent", balance.share_below_1_percent},
              {"platen_difference_mean", balance.mean.value},
              {"platen_difference_mean_interval", {{"low", balance.mean.low}, {"high", balance.mean.high}}},
              {"platen_difference_largest", balance.largest}};
    }

    double sum_of(const std::vector<double> &values)
    {
      double sum = 0;
      for (const double value : values)
        sum += value;
      return sum;
    }

    // The initial stress is isotropic: which principal stress lies between the others has no meaning there.
    std::vector<double> loaded(const HistoryTable &history, const std::string &name)
    {
      const std::vector<double> &values = column(history, name);
      return {values.begin() + (column(history, "axial_strain").front() == 0 ? 1 : 0), values.end()};
    }

    // The law, and what sets the thickness of its band: a length of its own, or (null) the mesh.
    json law_json(const Scene &scene)
    {
      const bool cosserat = scene.continuum.law.rfind("cosserat", 0) == 0;
      return {{"law", scene.continuum.law},
              {"internal_length_d",
               cosserat ? json(scene.continuum.material.internal_length / scene.sample.mean_diameter) : json(nullptr)}};
    }
  } // namespace

  json discrete_summary(const Scene &scene, const Comparison &c, const json &provenance)
  {
    const HistoryTable       &h       = c.discrete_history;
    const auto                mean    = [&](const char *name) { return sum_of(column(h, name)) / column(h, name).size(); };
    const discrete::Snapshot &last    = c.grains.back();
    const Peak                peak    = peak_of_running_mean(h, "stress_ratio", averaging_width(scene));
    const double              bodies  = double(last.position.size());
    json                      summary = {{"grains", last.position.size()},
                                         {"steps", column(h, "step").size()},
                                         {"sweeps", sum_of(column(h, "sweeps"))},
                                         {"step_length", last.step},
                                         {"max_penetration_d", largest(column(h, "max_penetration"))},
                                         {"mean_inertial_number", mean("inertial_number")},
                                         {"energy_residual", largest(column(h, "energy_residual"))},
                                         {"momentum_residual", largest(column(h, "momentum_residual"))},
                                         {"residual", largest(column(h, "residual"))},
                                         {"residual_factor", nullptr},
                                         {"peak_stress_ratio", peak.value},
                                         {"strain_at_peak", peak.axial_strain},
                                         {"final_volumetric_strain", column(h, "volumetric_strain").back()},
                                         {"spin_term_share", largest(column(h, "spin_term_share"))},
                                         {"kinetic_energy_ratio_median", median(column(h, "kinetic_energy_ratio"))},
                                         {"kinetic_energy_ratio_largest", largest(column(h, "kinetic_energy_ratio"))},
                                         {"contacts", column(h, "contacts").back()},
                                         {"coordination_number", 2 * column(h, "contacts").back() / bodies},
                                         {"rattlers", column(h, "rattlers").back()}};
    summary.update(balance_json(h));
    summary.update(provenance.value("discrete", json::object()));
    return summary;
  }

  json continuum_summary(const Scene &scene, const Comparison &c, const json &provenance)
  {
    const HistoryTable &h       = c.continuum_history;
    const Peak          peak    = peak_of_running_mean(h, "stress_ratio", averaging_width(scene));
    json                summary = {{"element_size_d", scene.continuum.element_size},
                                   {"newton_iterations", column(h, "newton_iterations").back()},
                                   {"cut_backs", column(h, "cut_backs").back()},
                                   {"peak_stress_ratio", peak.value},
                                   {"strain_at_peak", peak.axial_strain},
                                   {"final_volumetric_strain", column(h, "volumetric_strain").back()},
                                   {"share_zz_not_intermediate", largest(loaded(h, "share_zz_not_intermediate"))},
                                   {"viscous_share", largest(column(h, "viscous_share"))},
                                   {"max_equivalent_plastic_strain", column(h, "max_equivalent_plastic_strain").back()}};
    summary.update(law_json(scene));
    summary["parameters_from"] = scene.comparison.parameters_from;
    summary.update(provenance.value("continuum", json::object()));
    return summary;
  }

  json cost_json(const json &provenance)
  {
    json result = {
      {"discrete_cpu_s", nullptr}, {"continuum_cpu_s", nullptr}, {"comparison_cpu_s", nullptr}, {"preparation_cpu_s", nullptr}};
    double memory = 0;
    for (const json &phase : provenance.value("phases", json::array()))
      {
        const std::string name = phase["name"];
        if (result.contains(name + "_cpu_s"))
          result[name + "_cpu_s"] = phase["cpu_s"];
        memory = std::max(memory, phase["peak_memory_mb"].get<double>());
      }
    result["peak_memory_mb"] = memory;
    return result;
  }
} // namespace diptych::coupling
