// diptych: the comparison as files
// SPDX-License-Identifier: LGPL-2.1-or-later
#include "coupling/comparison_output.h"

#include <cmath>
#include <sstream>

#include <nlohmann/json.hpp>

#include "discrete/text_file.h"
#include "discrete/hdf5_file.h"

namespace diptych::coupling
{
  namespace
  {
    using nlohmann::json;

    json vector_json(const Eigen::Vector2d &v)
    {
      return {v.x(), v.y()};
    }

    json tensor_json(const Eigen::Matrix2d &m)
    {
      return {{m(0, 0), m(0, 1)}, {m(1, 0), m(1, 1)}};
    }

    json bands_json(const BandReport &report, const double d)
    {
      json bands = json::array();
      for (const Band &band : report.bands)
        bands.push_back({{"angle_deg", band.angle_deg},
                         {"half_width_d", band.half_width / d},
                         {"width_10_90_d", band.width_10_90 / d},
                         {"offset_d", band.offset / d},
                         {"jump", band.jump},
                         {"dilation_deg", band.dilation_deg},
                         {"r_squared", band.r_squared},
                         {"r_squared_strips", band.r_squared_strips}});
      return bands;
    }

    json strips_json(const Strips &strips, const double d)
    {
      std::vector<double> edges = strips.edges;
      for (double &x : edges)
        x /= d;
      return {{"angle_deg", strips.angle_deg},
              {"edges_d", edges},
              {"mean", strips.mean},
              {"deviation", strips.deviation},
              {"count", strips.count}};
    }

    json increment_json(const PanelIncrement &panel, const double d)
    {
      return {
        {"bands", bands_json(panel.band, d)}, {"band_verdict", panel.band.verdict}, {"strips", strips_json(panel.strips, d)}};
    }

    json probe_json(const ProbeRecord &probe, const bool grains)
    {
      json polygon = json::array();
      for (const Eigen::Vector2d &x : probe.region.polygon)
        polygon.push_back(vector_json(x));
      json result = {{"name", probe.region.name},
                     {"polygon", polygon},
                     {"stress", tensor_json(probe.stress.stress)},
                     {"s1", probe.stress.s1},
                     {"s2", probe.stress.s2},
                     {"direction_deg", probe.stress.direction_deg},
                     {"t_over_s", probe.stress.t_over_s},
                     {"count", probe.stress.count}};
      if (grains)
        result.update({{"fabric", tensor_json(probe.fabric.fabric)},
                       {"fabric_direction_deg", probe.fabric.direction_deg},
                       {"fabric_direction_error_deg", probe.fabric.direction_error_deg},
                       {"anisotropy", probe.fabric.anisotropy},
                       {"anisotropy_error", probe.fabric.anisotropy_error},
                       {"normals_24", probe.fabric.normals_24},
                       {"contacts", probe.fabric.contacts}});
      return result;
    }

    json panel_json(const PanelRecord &panel, const PanelIncrement &increment, const bool grains, const double d)
    {
      json result = {
        {"stress_ratio", panel.stress_ratio},
        {"volumetric_strain", panel.volumetric_strain},
        {"platen_resultants", {{"lower", vector_json(panel.lower_force)}, {"upper", vector_json(panel.upper_force)}}},
        {"dynamic_share", panel.dynamic_share},
        {"probes", json::array()}};
      result.update(increment_json(increment, d));
      for (const ProbeRecord &probe : panel.probes)
        result["probes"].push_back(probe_json(probe, grains));
      return result;
    }

    // Angle between two lines, in [0, 90].
    double line_angle(const double a, const double b)
    {
      const double turn = std::fmod(std::abs(a - b), 180.);
      return std::min(turn, 180 - turn);
    }

    json band_difference(const Increment &increment, const double d)
    {
      const std::vector<Band> &a = increment.discrete.band.bands, &b = increment.continuum.band.bands;
      if (a.empty() || b.empty())
        return {{"angle_deg", nullptr}, {"width_10_90_d", nullptr}, {"offset_d", nullptr}};
      return {{"angle_deg", line_angle(a[0].angle_deg, b[0].angle_deg)},
              {"width_10_90_d", (b[0].width_10_90 - a[0].width_10_90) / d},
              {"offset_d", (b[0].offset - a[0].offset) / d}};
    }

    json stage_json(const StageRecord &stage, const double d)
    {
      json difference = {{"stress_ratio", stage.continuum.stress_ratio - stage.discrete.stress_ratio},
                         {"volumetric_strain", stage.continuum.volumetric_strain - stage.discrete.volumetric_strain},
                         {"stress_l2_relative", stage.stress_difference}};
      difference.update(band_difference(stage.increment, d));
      return {{"axial_strain", stage.axial_strain},
              {"discrete", panel_json(stage.discrete, stage.increment.discrete, true, d)},
              {"continuum", panel_json(stage.continuum, stage.increment.continuum, false, d)},
              {"difference", difference},
              {"mapping",
               {{"method", "segments"},
                {"total_relative_error", stage.total_relative_error},
                {"nodal_residual", stage.nodal_residual},
                {"outside_share", stage.outside_share}}}};
    }

    double largest(const std::vector<double> &values)
    {
      double result = 0;
      for (const double value : values)
        result = std::max(result, std::abs(value));
      return result;
    }

    // |lower + upper vertical resultant| / their mean, from 0.2 % strain on: share of steps below 1 %, and the mean signed
    // difference.
    json platen_balance(const HistoryTable &history)
    {
      const std::vector<double> &strain = column(history, "axial_strain"), &lower = column(history, "lower_fy"),
                                &upper = column(history, "upper_fy");
      double below = 0, sum = 0, count = 0;
      for (std::size_t k = 0; k < strain.size(); ++k)
        if (strain[k] > 0.002)
          {
            const double difference = (lower[k] + upper[k]) / (0.5 * (lower[k] - upper[k]));
            below += std::abs(difference) < 0.01, sum += difference, ++count;
          }
      if (count == 0)
        return {{"platen_difference_share_below_1_percent", nullptr}, {"platen_difference_mean", nullptr}};
      return {{"platen_difference_share_below_1_percent", below / count}, {"platen_difference_mean", sum / count}};
    }

    double sum_of(const std::vector<double> &values)
    {
      double sum = 0;
      for (const double value : values)
        sum += value;
      return sum;
    }

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
      summary.update(platen_balance(h));
      summary.update(provenance.value("discrete", json::object()));
      return summary;
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
      summary.update(provenance.value("continuum", json::object()));
      return summary;
    }

    std::string text_prefix(const double from, const double to, const std::string &panel)
    {
      std::ostringstream out;
      out.precision(10);
      out << from << ',' << to << ',' << panel << ',';
      return out.str();
    }

    json cost(const json &provenance)
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
  } // namespace

  void write_comparison_json(const std::string &directory, const Scene &scene, const Comparison &c, const json &provenance)
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
      root["stages"].push_back(stage_json(stage, d));
    for (const Increment &window : c.windows)
      root["windows"].push_back({{"from", window.from},
                                 {"to", window.to},
                                 {"discrete", increment_json(window.discrete, d)},
                                 {"continuum", increment_json(window.continuum, d)},
                                 {"difference", band_difference(window, d)}});
    json &coarse = root["continuum_coarse"] = {
      {"element_size_d", c.coarse.element_size}, {"peak_stress_ratio", c.coarse.peak.value}, {"windows", json::array()}};
    for (const Increment &window : c.coarse.windows)
      coarse["windows"].push_back({{"from", window.from}, {"to", window.to}, {"bands", bands_json(window.continuum.band, d)}});
    root["discrete_summary"]  = discrete_summary(scene, c, provenance);
    root["continuum_summary"] = continuum_summary(scene, c, provenance);
    root["cost"]              = cost(provenance);
    discrete::write_text(directory + "/comparison.json", root.dump(1) + "\n");
  }

  void write_comparison_csv(const std::string &directory, const Comparison &c)
  {
    std::ostringstream out;
    out.precision(10);
    out << "axial_strain_from,axial_strain_to,panel,quantity,value\n";
    const auto bands = [&](const Increment &increment) {
      for (const auto &[name, panel] : {std::pair{"discrete", &increment.discrete}, std::pair{"continuum", &increment.continuum}})
        for (std::size_t k = 0; k < panel->band.bands.size(); ++k)
          {
            const Band       &band = panel->band.bands[k];
            const double      d    = increment.frame.mean_diameter;
            const std::string line = text_prefix(increment.from, increment.to, name) + "band_" + std::to_string(k + 1) + "_";
            out << line << "angle_deg," << band.angle_deg << '\n'
                << line << "half_width_d," << band.half_width / d << '\n'
                << line << "width_10_90_d," << band.width_10_90 / d << '\n'
                << line << "offset_d," << band.offset / d << '\n'
                << line << "jump," << band.jump << '\n'
                << line << "dilation_deg," << band.dilation_deg << '\n'
                << line << "r_squared," << band.r_squared << '\n';
          }
    };
    for (const StageRecord &stage : c.stages)
      {
        for (const auto &[name, panel] : {std::pair{"discrete", &stage.discrete}, std::pair{"continuum", &stage.continuum}})
          {
            const std::string line = text_prefix(stage.increment.from, stage.axial_strain, name);
            out << line << "stress_ratio," << panel->stress_ratio << '\n'
                << line << "volumetric_strain," << panel->volumetric_strain << '\n'
                << line << "upper_platen_fy," << panel->upper_force.y() << '\n'
                << line << "lower_platen_fy," << panel->lower_force.y() << '\n';
          }
        const std::string line = text_prefix(stage.increment.from, stage.axial_strain, "difference");
        out << line << "stress_l2_relative," << stage.stress_difference << '\n';
        bands(stage.increment);
      }
    for (const Increment &window : c.windows)
      bands(window);
    discrete::write_text(directory + "/comparison.csv", out.str());
  }
} // namespace diptych::coupling
