// diptych: what the realisations of an ensemble have in common: means, intervals, verdicts
// SPDX-License-Identifier: LGPL-2.1-or-later
#include "coupling/ensembles/ensemble.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <set>
#include <stdexcept>

#include <nlohmann/json.hpp>

#include "coupling/cells/principal_axes.h"

namespace diptych::coupling
{
  namespace
  {
    using nlohmann::json;

    constexpr double no_value = std::numeric_limits<double>::quiet_NaN();

    bool ends_with(const std::string &text, const std::string &end)
    {
      return text.size() >= end.size() && text.compare(text.size() - end.size(), end.size(), end) == 0;
    }

    // What stands for a place, repeats a list, is an interval's end, or changes from run to run of the same seed.
    bool is_left_out(const std::string &key)
    {
      static const std::set<std::string> keys = {
        "axial_strain", "from", "to", "strips", "low", "high", "resamples", "ns_per_update", "solver_share_of_cpu"};
      return keys.count(key) > 0 || ends_with(key, "_cpu_s") || ends_with(key, "_wall_s") || ends_with(key, "_seconds");
    }

    // Stages of two seeds may differ by rounding: six digits name them alike.
    std::string short_text(const double value)
    {
      char text[32];
      std::snprintf(text, sizeof text, "%.6g", value);
      return text;
    }

    // A list whose entries have names is no list: "probes": [{"name": "zone", ...}] is "probe zone".
    std::string name_of(const json &entry)
    {
      for (const char *key : {"name", "label"})
        if (entry.is_object() && entry.contains(key) && entry[key].is_string())
          return entry[key];
      if (entry.is_object() && entry.contains("of") && entry.contains("and"))
        return entry["of"].get<std::string>() + "-" + entry["and"].get<std::string>();
      return "";
    }

    std::string singular(const std::string &key)
    {
      static const std::map<std::string, std::string> names = {{"probes", "probe"}, {"probe_differences", "probe_difference"}};
      const auto                                      found = names.find(key);
      return found == names.end() ? key : found->second;
    }

    void collect(const json &value, const std::string &place, Member &member);

    void collect_list(const json &list, const std::string &place, const std::string &key, Member &member)
    {
      if (key == "bands")
        {
          member.band_counts.emplace_back(place, int(list.size()));
          if (!list.empty())
            collect(list.front(), place + " band", member);
          return;
        }
      for (const json &entry : list)
        if (const std::string name = name_of(entry); !name.empty())
          collect(entry, place + " " + singular(key) + " " + name, member);
    }

    void collect(const json &value, const std::string &place, Member &member)
    {
      if (value.is_number())
        member.numbers.emplace_back(place, value.get<double>());
      else if (value.is_object() && value.contains("value"))
        collect(value["value"], place, member);
      else if (value.is_object())
        for (const auto &[key, entry] : value.items())
          {
            if (entry.is_array())
              collect_list(entry, place, key, member);
            else if (!is_left_out(key))
              collect(entry, place + " " + key, member);
          }
    }

    void collect_windows(const json &windows, const std::string &prefix, Member &member)
    {
      for (const json &window : windows)
        collect(window, prefix + "window " + short_text(window.at("from")) + "-" + short_text(window.at("to")), member);
    }

    bool is_of_bands(const std::string &name)
    {
      return name.find(" band ") != std::string::npos;
    }

    bool is_difference(const std::string &name)
    {
      return name.find(" difference ") != std::string::npos;
    }

    // The angle between the panels' bands has no sign and is no line.
    bool is_line(const std::string &name)
    {
      return !is_difference(name) &&
             (ends_with(name, "angle_deg") || ends_with(name, "direction_deg") || ends_with(name, "fabric_to_stress_deg"));
    }

    std::string unit_of(const std::string &name)
    {
      // inside and outside are dissipations [energy / area].
      static const std::map<std::string, std::string> units = {{"s1", "pressure"},
                                                               {"s2", "pressure"},
                                                               {"inside", "pressure"},
                                                               {"outside", "pressure"},
                                                               {"initial_height", "length"},
                                                               {"radius", "length"},
                                                               {"step", "time"},
                                                               {"step_length", "time"},
                                                               {"window_time", "time"},
                                                               {"platen_speed", "length/time"}};
      const std::string                               key   = name.substr(name.rfind(' ') + 1);
      if (ends_with(key, "_deg"))
        return "degrees";
      if (ends_with(key, "_d"))
        return "mean diameters";
      if (name.find(" grain_pressure ") != std::string::npos && key != "grains")
        return "pressure";
      const auto found = units.find(key);
      return found == units.end() ? "-" : found->second;
    }

    // Names in the order of their first appearance, with one value a member.
    std::vector<Quantity> tabulated(const std::vector<Member> &members)
    {
      std::vector<Quantity>              quantities;
      std::map<std::string, std::size_t> place;
      for (std::size_t k = 0; k < members.size(); ++k)
        for (const auto &[name, value] : members[k].numbers)
          {
            const auto [found, is_new] = place.emplace(name, quantities.size());
            if (is_new)
              quantities.push_back({name, unit_of(name), {}, std::vector<double>(members.size(), no_value)});
            quantities[found->second].values[k] = value;
          }
      return quantities;
    }

    std::vector<double> known(const std::vector<double> &values)
    {
      std::vector<double> result;
      std::copy_if(values.begin(), values.end(), std::back_inserter(result), [](const double v) { return std::isfinite(v); });
      return result;
    }

    std::vector<BandCount> counted(const std::vector<Member> &members)
    {
      std::vector<BandCount> counts;
      for (const Member &member : members)
        for (const auto &[name, count] : member.band_counts)
          {
            const auto is_it = [&name = name](const BandCount &c) { return c.name == name; };
            auto       found = std::find_if(counts.begin(), counts.end(), is_it);
            if (found == counts.end())
              found = counts.insert(counts.end(), {name});
            ++found->members[std::min(count, 2)];
          }
      return counts;
    }

    enum class Measure
    {
      absolute,
      relative,
      line
    };

    struct Question
    {
      std::string quantity, discrete, continuum; // names of the panels' quantities
      double      margin;
      Measure     measure;
    };

    std::vector<Question> questions(const std::vector<BandCount> &bands, const EquivalenceMargins &margins)
    {
      const std::string     peak = "peak_stress_ratio", volume = "final_volumetric_strain", of_grains = " discrete";
      std::vector<Question> list = {
        {peak, "discrete_summary " + peak, "continuum_summary " + peak, margins.peak_stress_ratio, Measure::relative},
        {volume, "discrete_summary " + volume, "continuum_summary " + volume, margins.volumetric_strain, Measure::absolute}};
      for (const BandCount &count : bands)
        if (count.name.rfind("window ", 0) == 0 && ends_with(count.name, of_grains))
          {
            const std::string window = count.name.substr(0, count.name.size() - of_grains.size());
            for (const auto &[key, margin, measure] : {std::tuple{" band angle_deg", margins.angle, Measure::line},
                                                       std::tuple{" band width_10_90_d", margins.thickness, Measure::relative}})
              list.push_back({window + key, window + of_grains + key, window + " continuum" + key, margin, measure});
          }
      return list;
    }

    std::vector<double> values_of(const std::vector<Quantity> &quantities, const std::string &name, const std::size_t n)
    {
      for (const Quantity &quantity : quantities)
        if (quantity.name == name)
          return quantity.values;
      return std::vector<double>(n, no_value);
    }

    PanelVerdict answer(const Question &question, const std::vector<Quantity> &quantities, const std::size_t n_members)
    {
      const bool   relative = question.measure == Measure::relative;
      PanelVerdict result;
      result.quantity  = question.quantity;
      result.unit      = relative ? "-" : unit_of(question.quantity);
      result.margin    = question.margin;
      result.relative  = relative;
      result.discrete  = values_of(quantities, question.discrete, n_members);
      result.continuum = values_of(quantities, question.continuum, n_members);
      std::vector<double> first, second, difference, turn;
      for (std::size_t k = 0; k < n_members; ++k)
        if (const double a = result.discrete[k], b = result.continuum[k]; std::isfinite(a) && std::isfinite(b))
          first.push_back(a), second.push_back(b), difference.push_back(b - a), turn.push_back(line_turn(b, a));
      if (relative)
        result.equivalence = compare_relative(first, second, question.margin);
      else if (question.measure == Measure::line)
        result.equivalence = compare_turns(turn, question.margin);
      else
        result.equivalence = compare_differences(difference, question.margin);
      return result;
    }
  } // namespace

  Member member_of(const json &comparison)
  {
    Member member;
    try
      {
        member.seed = comparison.at("seed");
        for (const char *panel : {"discrete_summary", "continuum_summary"})
          collect(comparison.at(panel), panel, member);
        collect_windows(comparison.at("windows"), "", member);
        for (const json &stage : comparison.at("stages"))
          collect(stage, "stage " + short_text(stage.at("axial_strain")), member);
        if (const json coarse = comparison.value("continuum_coarse", json::object()); coarse.contains("windows"))
          {
            collect(coarse, "continuum_coarse", member);
            collect_windows(coarse["windows"], "continuum_coarse ", member);
          }
      }
    catch (const json::exception &error)
      {
        throw std::runtime_error(std::string("no comparison of two panels: ") + error.what());
      }
    return member;
  }

  bool is_mirror_symmetric(const Scene &scene)
  {
    const discrete::WallDriveOptions &drives = scene.discrete.drives;
    for (const std::string &drive : {drives.lower_x, drives.lower_y, drives.upper_x, drives.upper_y, drives.left_x, drives.left_y,
                                     drives.right_x, drives.right_y})
      if (drive != "auto")
        return false;
    return scene.loading.mode == "descent" && scene.loading.horizontal_over_vertical == 0 && scene.discrete.time.gravity_x == 0;
  }

  void fold(Member &member)
  {
    std::map<std::string, double> sign; // of the angle, by the band's place
    for (const auto &[name, value] : member.numbers)
      if (is_of_bands(name) && ends_with(name, " angle_deg"))
        sign[name.substr(0, name.rfind(' '))] = value < 0 ? -1 : 1;
    const auto was_between_images = [](const auto &number) {
      return is_difference(number.first) && (ends_with(number.first, " angle_deg") || ends_with(number.first, " offset_d"));
    };
    auto &numbers = member.numbers;
    numbers.erase(std::remove_if(numbers.begin(), numbers.end(), was_between_images), numbers.end());
    for (auto &[name, value] : numbers)
      if (is_of_bands(name) && (ends_with(name, " angle_deg") || ends_with(name, " offset_d")))
        value = std::abs(value);
      else if (is_of_bands(name) && ends_with(name, " jump"))
        value *= sign.emplace(name.substr(0, name.rfind(' ')), 1).first->second;
  }

  Ensemble evaluate(const std::vector<Member> &members, const EquivalenceMargins &margins)
  {
    Ensemble ensemble;
    for (const Member &member : members)
      ensemble.seeds.push_back(member.seed);
    ensemble.quantities = tabulated(members);
    for (Quantity &quantity : ensemble.quantities)
      quantity.statistics = is_line(quantity.name) ? line_statistics(known(quantity.values)) : statistics(known(quantity.values));
    ensemble.bands = counted(members);
    for (const Question &question : questions(ensemble.bands, margins))
      ensemble.verdicts.push_back(answer(question, ensemble.quantities, members.size()));
    return ensemble;
  }
} // namespace diptych::coupling
