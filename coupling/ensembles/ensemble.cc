// diptych: statistics over the members of an ensemble: means, intervals, verdicts
// SPDX-License-Identifier: LGPL-2.1-or-later
#include "coupling/ensembles/ensemble.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <stdexcept>

#include <nlohmann/json.hpp>

#include "coupling/cells/principal_axes.h"
#include "coupling/numbers/record_file.h"

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

    // Description of a place of comparison.json; nullptr if the place is not listed.
    const NumberDescription *description_of(const std::string &place)
    {
      static const NumberSchema                                     schema   = comparison_schema();
      static const std::map<std::string, const NumberDescription *> by_place = [] {
        std::map<std::string, const NumberDescription *> result;
        for (const NumberDescription &number : schema)
          result[number.place] = &number;
        return result;
      }();
      const auto found = by_place.find(place);
      return found == by_place.end() ? nullptr : found->second;
    }

    bool is_averaged(const NumberDescription &number)
    {
      return number.kind == Kind::number || number.kind == Kind::line;
    }

    // Stages of two seeds may differ by rounding; six digits give them the same name.
    std::string short_text(const double value)
    {
      char text[32];
      std::snprintf(text, sizeof text, "%.6g", value);
      return text;
    }

    // Entries of a list with names get these in their own name: "probes": [{"name": "zone", ...}] is "probe zone".
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

    // Place of a value in comparison.json, and its name in a member.
    struct Place
    {
      std::string keys, name;

      Place at(const std::string &key) const { return {keys + "/" + key, name + " " + key}; }
    };

    void collect(const json &value, const Place &place, Member &member);

    void collect_list(const json &list, const Place &place, const std::string &key, Member &member)
    {
      const std::string keys = place.keys + "/" + key;
      if (key == "bands")
        {
          member.band_counts.emplace_back(place.name, int(list.size()));
          if (!list.empty())
            collect(list.front(), {keys, place.name + " band"}, member);
          return;
        }
      for (const json &entry : list)
        if (const std::string name = name_of(entry); !name.empty())
          collect(entry, {keys, place.name + " " + singular(key) + " " + name}, member);
    }

    void collect(const json &value, const Place &place, Member &member)
    {
      if (value.is_number())
        {
          const NumberDescription *number = description_of(place.keys);
          if (number != nullptr && is_averaged(*number))
            member.numbers.push_back({place.name, value.get<double>(), number});
        }
      else if (value.is_object() && value.contains("value"))
        collect(value["value"], place, member);
      else if (value.is_object())
        for (const auto &[key, entry] : value.items())
          {
            if (entry.is_array())
              collect_list(entry, place, key, member);
            else
              collect(entry, place.at(key), member);
          }
    }

    void collect_windows(const json &windows, const Place &of_list, Member &member)
    {
      for (const json &window : windows)
        collect(window,
                {of_list.keys, of_list.name + "window " + short_text(window.at("from")) + "-" + short_text(window.at("to"))},
                member);
    }

    // True for a number of one panel's strongest band.
    bool is_of_bands(const NumberDescription &number, const std::string &key)
    {
      return ends_with(number.place, "/bands/" + key);
    }

    // True for a difference between the panels' bands: continuum minus grains.
    bool is_difference_of_bands(const NumberDescription &number, const std::string &key)
    {
      return number.place == "stages/difference/" + key || number.place == "windows/difference/" + key;
    }

    // Names in the order of their first appearance, with one value per member.
    std::vector<Quantity> tabulated(const std::vector<Member> &members)
    {
      std::vector<Quantity>              quantities;
      std::map<std::string, std::size_t> place;
      for (std::size_t k = 0; k < members.size(); ++k)
        for (const MemberNumber &entry : members[k].numbers)
          {
            const auto [found, is_new] = place.emplace(entry.name, quantities.size());
            if (is_new)
              quantities.push_back({entry.name,
                                    entry.number->unit,
                                    entry.number->kind == Kind::line,
                                    {},
                                    std::vector<double>(members.size(), no_value)});
            quantities[found->second].values[k] = entry.value;
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
      std::string unit; // of the margin
    };

    std::vector<Question> questions(const std::vector<BandCount> &bands, const EquivalenceMargins &margins)
    {
      const std::string peak = "peak_stress_ratio", strength = "strength", volume = "final_volumetric_strain",
                        of_grains = " discrete";
      std::vector<Question> list  = {
         {peak, "discrete_summary " + peak, "continuum_summary " + peak, margins.peak_stress_ratio, Measure::relative, "-"},
         {strength, "discrete_summary " + strength, "continuum_summary " + strength, margins.peak_stress_ratio, Measure::relative,
          "-"},
         {volume, "discrete_summary " + volume, "continuum_summary " + volume, margins.volumetric_strain, Measure::absolute, "-"}};
      for (const BandCount &count : bands)
        if (count.name.rfind("window ", 0) == 0 && ends_with(count.name, of_grains))
          {
            const std::string window = count.name.substr(0, count.name.size() - of_grains.size());
            for (const auto &[key, margin, measure] : {std::tuple{" band angle_deg", margins.angle, Measure::line},
                                                       std::tuple{" band width_10_90_d", margins.thickness, Measure::relative}})
              list.push_back({window + key, window + of_grains + key, window + " continuum" + key, margin, measure,
                              measure == Measure::line ? "degrees" : "-"});
          }
      return list;
    }

    const Quantity *quantity_of(const std::vector<Quantity> &quantities, const std::string &name)
    {
      for (const Quantity &quantity : quantities)
        if (quantity.name == name)
          return &quantity;
      return nullptr;
    }

    std::vector<double> values_of(const Quantity *quantity, const std::size_t n)
    {
      return quantity != nullptr ? quantity->values : std::vector<double>(n, no_value);
    }

    PanelVerdict answer(const Question &question, const std::vector<Quantity> &quantities, const std::size_t n_members)
    {
      const bool      relative  = question.measure == Measure::relative;
      const Quantity *discrete  = quantity_of(quantities, question.discrete),
                     *continuum = quantity_of(quantities, question.continuum);
      PanelVerdict result;
      result.quantity  = question.quantity;
      result.unit      = relative               ? "-"
                         : discrete != nullptr  ? discrete->unit
                         : continuum != nullptr ? continuum->unit
                                                : question.unit;
      result.margin    = question.margin;
      result.relative  = relative;
      result.discrete  = values_of(discrete, n_members);
      result.continuum = values_of(continuum, n_members);
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
          collect(comparison.at(panel), {panel, panel}, member);
        collect_windows(comparison.at("windows"), {"windows", ""}, member);
        for (const json &stage : comparison.at("stages"))
          collect(stage, {"stages", "stage " + short_text(stage.at("progress"))}, member);
        if (const json coarse = comparison.value("continuum_coarse", json::object()); coarse.contains("windows"))
          {
            collect(coarse, {"continuum_coarse", "continuum_coarse"}, member);
            collect_windows(coarse["windows"], {"continuum_coarse/windows", "continuum_coarse "}, member);
          }
      }
    catch (const json::exception &error)
      {
        throw std::invalid_argument(std::string("comparison.json does not compare two panels: ") + plain_text(error));
      }
    return member;
  }

  bool is_mirror_symmetric(const Scene &scene)
  {
    bool driven = false;
    for_each_drive(scene.discrete.drives,
                   [&](int, int, const char *, const discrete::DriveOption &drive) { driven = driven || !drive.is_auto(); });
    return !driven && scene.loading.mode == discrete::LoadingMode::descent && scene.loading.horizontal_over_vertical == 0 &&
           scene.discrete.time.gravity_x == 0;
  }

  void fold(Member &member)
  {
    const auto                    band_of = [](const std::string &name) { return name.substr(0, name.rfind(' ')); };
    std::map<std::string, double> sign; // of the angle, by the place of the band
    for (const MemberNumber &entry : member.numbers)
      if (is_of_bands(*entry.number, "angle_deg"))
        sign[band_of(entry.name)] = entry.value < 0 ? -1 : 1;
    const auto was_between_images = [](const MemberNumber &entry) {
      return is_difference_of_bands(*entry.number, "angle_deg") || is_difference_of_bands(*entry.number, "offset_d");
    };
    auto &numbers = member.numbers;
    numbers.erase(std::remove_if(numbers.begin(), numbers.end(), was_between_images), numbers.end());
    for (MemberNumber &entry : numbers)
      if (is_of_bands(*entry.number, "angle_deg") || is_of_bands(*entry.number, "offset_d"))
        entry.value = std::abs(entry.value);
      else if (is_of_bands(*entry.number, "jump"))
        entry.value *= sign.emplace(band_of(entry.name), 1).first->second;
  }

  std::string text_of(const BandCount &count)
  {
    const int   n = count.members[0] + count.members[1] + count.members[2];
    std::string text;
    for (const auto &[words, members] :
         {std::pair{"one band", count.members[1]}, std::pair{"two bands", count.members[2]}, std::pair{"none", count.members[0]}})
      if (members > 0)
        text += (text.empty() ? "" : ", ") + std::string(words) + " in " + std::to_string(members) +
                (text.empty() ? " of " + std::to_string(n) : "");
    return text;
  }

  Ensemble evaluate(const std::vector<Member> &members, const EquivalenceMargins &margins)
  {
    Ensemble ensemble;
    for (const Member &member : members)
      ensemble.seeds.push_back(member.seed);
    ensemble.quantities = tabulated(members);
    for (Quantity &quantity : ensemble.quantities)
      quantity.statistics = quantity.is_line ? line_statistics(known(quantity.values)) : statistics(known(quantity.values));
    ensemble.bands = counted(members);
    for (const Question &question : questions(ensemble.bands, margins))
      ensemble.verdicts.push_back(answer(question, ensemble.quantities, members.size()));
    return ensemble;
  }
} // namespace diptych::coupling
