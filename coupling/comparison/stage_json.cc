// diptych: what is compared at one instant, as JSON
// SPDX-License-Identifier: LGPL-2.1-or-later
#include "coupling/comparison/stage_json.h"

#include <cmath>

#include <nlohmann/json.hpp>

#include "coupling/cells/principal_axes.h"

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

    json interval_json(const Interval &i, const double unit = 1)
    {
      return {{"value", i.value / unit}, {"low", i.low / unit}, {"high", i.high / unit}};
    }

    json scaled_json(std::vector<double> values, const double unit)
    {
      for (double &x : values)
        x /= unit;
      return values;
    }

    json strips_json(const Strips &strips, const double d)
    {
      return {{"angle_deg", strips.angle_deg},
              {"edges_d", scaled_json(strips.edges, d)},
              {"mean", strips.mean},
              {"deviation", strips.deviation},
              {"count", strips.count}};
    }

    json increment_json(const PanelIncrement &panel, const double d)
    {
      return {{"bands", bands_json(panel.band, d)},
              {"band_verdict", panel.band.verdict},
              {"bic_of_0_1_2_bands", panel.band.bic},
              {"independent_samples", panel.band.n_effective},
              {"strips", strips_json(panel.strips, d)}};
    }

    json probe_json(const ProbeRecord &probe)
    {
      json polygon = json::array();
      for (const Eigen::Vector2d &x : probe.region.polygon)
        polygon.push_back(vector_json(x));
      return {{"name", probe.region.name},
              {"polygon", polygon},
              {"stress", tensor_json(probe.stress.stress)},
              {"s1", probe.stress.s1},
              {"s2", probe.stress.s2},
              {"direction_deg", probe.stress.direction_deg},
              {"t_over_s", probe.stress.t_over_s},
              {"count", probe.stress.count}};
    }

    json pressure_json(const GrainPressure &pressure)
    {
      json percentiles;
      for (std::size_t k = 0; k < percentile_levels.size(); ++k)
        percentiles[std::to_string(percentile_levels[k])] = pressure.percentiles[k];
      return {
        {"mean", pressure.mean}, {"deviation", pressure.deviation}, {"grains", pressure.grains}, {"percentiles", percentiles}};
    }

    json grain_probe_json(const ProbeRecord &probe)
    {
      json                  result = probe_json(probe);
      const ProbeIntervals &i      = probe.intervals;
      result.update({{"s1", interval_json(i.s1)},
                     {"s2", interval_json(i.s2)},
                     {"direction_deg", interval_json(i.direction_deg)},
                     {"t_over_s", interval_json(i.t_over_s)},
                     {"blocks", i.blocks},
                     {"fabric", tensor_json(probe.fabric.fabric)},
                     {"fabric_direction_deg", interval_json(i.fabric_direction_deg)},
                     {"fabric_direction_error_deg", probe.fabric.direction_error_deg},
                     {"fabric_to_stress_deg", interval_json(i.fabric_to_stress_deg)},
                     {"anisotropy", interval_json(i.anisotropy)},
                     {"anisotropy_error", probe.fabric.anisotropy_error},
                     {"normals_24", probe.fabric.normals_24},
                     {"contacts", probe.fabric.contacts},
                     {"grain_pressure", pressure_json(probe.pressure)}});
      return result;
    }

    json circle_json(const CircularProbe &probe)
    {
      if (!(probe.circle.radius > 0))
        return nullptr;
      json result = {{"centre", vector_json(probe.circle.centre)},
                     {"radius", probe.circle.radius},
                     {"stress", tensor_json(probe.stress)},
                     {"angles_deg", probe.angles_deg},
                     {"normal", probe.normal},
                     {"tangential", probe.tangential},
                     {"predicted_normal", probe.predicted_normal},
                     {"predicted_tangential", probe.predicted_tangential},
                     {"relative_l2", interval_json(probe.relative_l2)}};
      if (!probe.normal_error.empty())
        result.update({{"normal_error", probe.normal_error},
                       {"tangential_error", probe.tangential_error},
                       {"independent_blocks", probe.independent_blocks}});
      return result;
    }

    json dissipation_json(const std::optional<DissipationSplit> &split)
    {
      if (!split)
        return nullptr;
      return {{"inside", split->inside},
              {"outside", split->outside},
              {"share_inside", split->share_inside},
              {"area_share", split->area_share}};
    }

    json traction_json(const std::optional<BandTraction> &traction, const double d)
    {
      if (!traction)
        return nullptr;
      json result = {{"edges_d", scaled_json(traction->edges, d)},
                     {"normal", traction->normal},
                     {"shear", traction->shear},
                     {"variation_normal", traction->variation_normal},
                     {"variation_shear", traction->variation_shear}};
      if (!traction->normal_error.empty())
        result.update({{"normal_error", traction->normal_error},
                       {"shear_error", traction->shear_error},
                       {"independent_normal", traction->independent_normal},
                       {"independent_shear", traction->independent_shear}});
      return result;
    }

    json panel_json(const PanelRecord &panel, const PanelIncrement &increment, const double d)
    {
      json result = {
        {"volumetric_strain", panel.volumetric_strain},
        {"platen_resultants", {{"lower", vector_json(panel.lower_force)}, {"upper", vector_json(panel.upper_force)}}},
        {"dynamic_share", panel.dynamic_share},
        {"minor_direction_deg", panel.minor_direction_deg},
        {"probes", json::array()},
        {"circular_probe", circle_json(panel.circle)},
        {"dissipation", dissipation_json(panel.dissipation)},
        {"band_traction", traction_json(panel.traction, d)}};
      result.update(increment_json(increment, d));
      return result;
    }

    json chains_json(const std::optional<ForceChains> &chains)
    {
      if (!chains)
        return nullptr;
      const auto side = [](const ChainDistribution &distribution) -> json {
        return {{"grains", distribution.count},
                {"mean", distribution.mean},
                {"share_above_mean", distribution.share_above_mean},
                {"values", distribution.values}};
      };
      return {{"inside", side(chains->inside)}, {"outside", side(chains->outside)},
              {"quantiles", chain_quantiles},   {"largest_distance", interval_json(chains->largest_distance)},
              {"blocks", chains->blocks},       {"verdict", chains->verdict}};
    }

    json grains_json(const StageRecord &stage, const double d)
    {
      json result            = panel_json(stage.discrete, stage.increment.discrete, d);
      result["stress_ratio"] = interval_json(stage.discrete.stress_ratio);
      for (const ProbeRecord &probe : stage.discrete.probes)
        result["probes"].push_back(grain_probe_json(probe));
      result["acceleration_share"] = stage.discrete.acceleration_share;
      result["force_chains"]       = chains_json(stage.force_chains);
      result["probe_differences"]  = json::array();
      for (const ProbeDifference &difference : stage.probe_differences)
        result["probe_differences"].push_back({{"of", difference.first},
                                               {"and", difference.second},
                                               {"t_over_s", interval_json(difference.t_over_s)},
                                               {"anisotropy", interval_json(difference.anisotropy)},
                                               {"direction_deg", interval_json(difference.direction_deg)},
                                               {"verdict", difference.verdict}});
      return result;
    }

    json continuum_json(const StageRecord &stage, const double d)
    {
      json result            = panel_json(stage.continuum, stage.increment.continuum, d);
      result["stress_ratio"] = stage.continuum.stress_ratio.value;
      for (const ProbeRecord &probe : stage.continuum.probes)
        result["probes"].push_back(probe_json(probe));
      return result;
    }

    // b - a of independent numbers: the distances of the ends from the values add up in squares.
    Interval difference_of(const Interval &a, const Interval &b)
    {
      const double value = b.value - a.value;
      return {value, value - std::hypot(b.value - b.low, a.high - a.value),
              value + std::hypot(b.high - b.value, a.value - a.low)};
    }

    // Continuum minus grains, of the strongest band of each; angles as a turn of lines, anticlockwise.
    json band_difference(const Increment &increment, const double d)
    {
      const std::vector<Band> &grains = increment.discrete.band.bands, &nodes = increment.continuum.band.bands;
      const char *const        names[] = {"angle_deg", "half_width_d", "width_10_90_d", "offset_d", "jump", "dilation_deg"};
      json                     result;
      for (const char *name : names)
        result[name] = nullptr;
      if (grains.empty() || nodes.empty())
        return result;
      const BandIntervals &a = grains[0].interval, &b = nodes[0].interval;
      Interval             turn = difference_of(a.angle_deg, b.angle_deg);
      const double         line = line_turn(turn.value, 0) - turn.value; // whole half turns
      result["angle_deg"]       = interval_json({turn.value + line, turn.low + line, turn.high + line});
      result["half_width_d"]    = interval_json(difference_of(a.half_width, b.half_width), d);
      result["width_10_90_d"]   = interval_json(difference_of(a.width_10_90, b.width_10_90), d);
      result["offset_d"]        = interval_json(difference_of(a.offset, b.offset), d);
      result["jump"]            = interval_json(difference_of(a.jump, b.jump));
      result["dilation_deg"]    = interval_json(difference_of(a.dilation_deg, b.dilation_deg));
      return result;
    }

    json difference_json(const StageRecord &stage, const double d)
    {
      json stress = json::array();
      for (const StressDifference &at : stage.stress_differences)
        stress.push_back({{"label", at.label},
                          {"resolution_d", at.size / d},
                          {"cells", at.cells},
                          {"relative_l2", at.relative_l2},
                          {"direction_deg", at.direction_deg},
                          {"sampling_alone", at.sampling_alone},
                          {"lowest_scatter", at.lowest_scatter}});
      const Interval exact{stage.continuum.stress_ratio.value, stage.continuum.stress_ratio.value,
                           stage.continuum.stress_ratio.value}; // but for the mesh and the step
      json           result = {{"stress_ratio", interval_json(difference_of(stage.discrete.stress_ratio, exact))},
                               {"volumetric_strain", stage.continuum.volumetric_strain - stage.discrete.volumetric_strain},
                               {"stress_l2_relative", stage.stress_differences.front().relative_l2},
                               {"stress", stress},
                               {"stress_verdict", stage.stress_verdict}};
      result.update(band_difference(stage.increment, d));
      return result;
    }
  } // namespace

  json bands_json(const BandReport &report, const double d)
  {
    json bands = json::array();
    for (const Band &band : report.bands)
      {
        const BandIntervals &i = band.interval;
        bands.push_back({{"angle_deg", interval_json(i.angle_deg)},
                         {"half_width_d", interval_json(i.half_width, d)},
                         {"width_10_90_d", interval_json(i.width_10_90, d)},
                         {"offset_d", interval_json(i.offset, d)},
                         {"jump", interval_json(i.jump)},
                         {"dilation_deg", interval_json(i.dilation_deg)},
                         {"resamples", i.resamples},
                         {"lost_share", i.lost_share},
                         {"r_squared", band.r_squared},
                         {"r_squared_strips", band.r_squared_strips}});
      }
    return bands;
  }

  json stage_json(const StageRecord &stage, const double d, const std::string &averaging_method)
  {
    return {{"axial_strain", stage.axial_strain},
            {"discrete", grains_json(stage, d)},
            {"continuum", continuum_json(stage, d)},
            {"difference", difference_json(stage, d)},
            {"mapping",
             {{"method", averaging_method},
              {"total_relative_error", stage.mapping.total_relative_error},
              {"nodal_residual", stage.mapping.nodal_residual},
              {"outside_share", stage.mapping.outside_share},
              {"window_time", stage.mapping.window_time}}}};
  }

  json window_json(const Increment &window, const double d)
  {
    return {{"from", window.from},
            {"to", window.to},
            {"discrete", increment_json(window.discrete, d)},
            {"continuum", increment_json(window.continuum, d)},
            {"difference", band_difference(window, d)}};
  }

  json resolution_json(const ResolutionStudy &study)
  {
    const auto rows_json = [](const std::vector<ResolutionRow> &rows, const char *size_name) {
      json result = json::array();
      for (const ResolutionRow &row : rows)
        {
          json points = json::array();
          for (const PointStress &point : row.points)
            points.push_back({{"name", point.name}, {"s", point.s}, {"t_over_s", point.t_over_s}});
          result.push_back(
            {{size_name, row.width}, {"points", points}, {"scatter_s", row.scatter_s}, {"scatter_t", row.scatter_t}});
        }
      return result;
    };
    return {{"kernel", rows_json(study.kernel, "width_d")},
            {"cells", rows_json(study.cells, "size_d")},
            {"plateau_d", study.plateau ? json(*study.plateau) : json(nullptr)},
            {"verdict", study.verdict}};
  }
} // namespace diptych::coupling
