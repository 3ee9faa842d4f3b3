// diptych: checks of a scene: contradictions are errors, doubtful values are warnings
// SPDX-License-Identifier: LGPL-2.1-or-later
#include "coupling/scene/scene_check.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <optional>
#include <set>
#include <stdexcept>

#include "continuum/require.h"
#include "coupling/processes/stop_signal.h"
#include "coupling/scene/derived_keys.h"
#include "coupling/scene/keys.h"
#include "coupling/scene/scene_error.h"
#include "discrete/files/wrong_keys.h"
#include "discrete/samples/placed_grains.h"

namespace diptych::coupling
{
  namespace
  {
    using discrete::LoadingMode;
    using discrete::WrongKeys;

    std::string stage_key(const Scene &scene)
    {
      return scene.loading.mode == LoadingMode::time ? "loading/stage_time" : "loading/stage_strain";
    }

    std::string end_key(const Scene &scene)
    {
      return scene.loading.mode == LoadingMode::time ? "loading/duration" : "loading/axial_strain";
    }

    void check_windows_of_list(const Scene &scene)
    {
      const std::vector<double> &stages = scene.loading.stages;
      for (const double edge : scene.comparison.window_edges)
        if (edge != 0 &&
            std::none_of(stages.begin(), stages.end(), [&](const double s) { return std::abs(s - edge) <= 1e-9 * s; }))
          throw WrongKeys({"comparison/window_edges", "loading/stages"},
                          "comparison/window_edges holds " + text_of(edge) +
                            ", which is not one of loading/stages = " + text_of(stages));
    }

    // `last`: the end in the unit of the stages.
    void check_windows(const Scene &scene, const double last)
    {
      if (!scene.loading.stages.empty())
        return check_windows_of_list(scene);
      const bool        time  = scene.loading.mode == LoadingMode::time;
      const std::string stage = stage_key(scene), end = end_key(scene);
      const double      interval = time ? scene.loading.stage_time : scene.loading.stage_strain;
      for (const double edge : scene.comparison.window_edges)
        {
          const double k = edge / interval;
          if (std::abs(k - std::round(k)) > 1e-6 || edge > last * (1 + 1e-9))
            throw WrongKeys({"comparison/window_edges", stage, end}, "comparison/window_edges holds " + text_of(edge) +
                                                                       ", which is not a stage: stages are multiples of " +
                                                                       stage + " = " + text_of(interval) + " up to " + end +
                                                                       " = " + text_of(last));
        }
    }

    void check_stages(const Scene &scene, const bool compares)
    {
      if (const double strain = scene.loading.axial_strain; scene.loading.mode == LoadingMode::descent && strain >= 1)
        throw WrongKeys({"loading/axial_strain"},
                        "loading/axial_strain = " + text_of(strain) +
                          " moves the upper platen to the lower one: give a number below 1; 3 % is 0.03");
      const LoadingOptions &loading  = scene.loading;
      const bool            time     = loading.mode == LoadingMode::time;
      const double          last     = time ? loading.duration : loading.axial_strain;
      const double          interval = time ? loading.stage_time : loading.stage_strain, count = last / interval;
      const std::string     stage = stage_key(scene), end = end_key(scene);
      if (const std::vector<double> &list = loading.stages; !list.empty())
        {
          if (std::adjacent_find(list.begin(), list.end(), std::greater_equal<double>()) != list.end())
            throw WrongKeys({"loading/stages"}, "loading/stages = " + text_of(list) + " do not ascend");
          if (std::abs(list.back() - last) > 1e-9 * last)
            throw WrongKeys({"loading/stages", end},
                            "loading/stages end at " + text_of(list.back()) + ", but " + end + " = " + text_of(last));
        }
      else if (std::abs(count - std::round(count)) > 1e-6 || count < 0.5)
        throw WrongKeys({end, stage},
                        end + " = " + text_of(last) + " is not a whole number of " + stage + " = " + text_of(interval));
      constexpr double most_stages = 1e5;
      if (loading.stages.empty() && count > most_stages * (1 + 1e-9))
        throw WrongKeys({end, stage}, end + " = " + text_of(last) + " over " + stage + " = " + text_of(interval) + " are " +
                                        text_of(count) + " stages; at most 100000");
      const std::vector<double> &edges = scene.comparison.window_edges;
      if (edges.size() < 2 || std::adjacent_find(edges.begin(), edges.end(), std::greater_equal<double>()) != edges.end())
        throw WrongKeys({"comparison/window_edges"}, "comparison/window_edges = " + text_of(edges) +
                                                       ": give at least two ascending " + (time ? "times" : "strains"));
      if (compares)
        check_windows(scene, last);
    }

    std::map<std::string, std::string> values_of(const Scene &scene)
    {
      std::map<std::string, std::string> values;
      for (const KeyDescription &key : keys_of(scene))
        values[key.full_name()] = key.value;
      return values;
    }

    // The second run shows what larger elements do to the band.
    std::optional<std::string> doubtful_coarse_mesh(const Scene &scene)
    {
      const double coarse = scene.comparison.coarse_element_size, fine = scene.continuum.element_size;
      if (coarse == 0 || coarse > fine || scene.continuum.mesh.kind == continuum::MeshOption::Kind::file)
        return std::nullopt;
      return "comparison/coarse_element_size = " + text_of(coarse) +
             " is not larger than continuum/element_size = " + text_of(fine) +
             ": the coarse run is not coarser than the first; give a larger size, or 0 to leave it out";
    }

    // Platens should be rough in both panels, or smooth in both.
    std::optional<std::string> doubtful_platens(const Scene &scene)
    {
      const auto  &contacts = scene.discrete.law;
      const double platens = contacts.platen_friction, grains = contacts.friction;
      const auto   kind = scene.continuum.platens;
      if (scene.discrete.method.method == discrete::Method::imported || scene.sample.rough_platens)
        return std::nullopt;
      if (kind == continuum::Platens::rough && platens < grains)
        return "the platens are rough in the continuum (continuum/platens = rough), but grains slide along them: "
               "discrete/platen_friction = " +
               text_of(platens) + " is below discrete/friction = " + text_of(grains);
      if (kind == continuum::Platens::smooth && platens > 0.1)
        return "the platens are smooth in the continuum (continuum/platens = smooth), but hold the grains: "
               "discrete/platen_friction = " +
               text_of(platens);
      return std::nullopt;
    }

    std::optional<std::string> doubtful_speed(const Scene &scene)
    {
      const double I = inertial_number(scene);
      if (scene.loading.mode != LoadingMode::descent || scene.discrete.method.method == discrete::Method::imported ||
          I <= largest_quasi_static)
        return std::nullopt;
      return "the inertial number " + text_of(I) + " is above " + text_of(largest_quasi_static) +
             ": the loading is not quasi-static, and strength and dilation of the grains grow with the speed";
    }

    std::optional<std::string> doubtful_strain(const Scene &scene)
    {
      const double strain = scene.loading.axial_strain;
      if (scene.loading.mode != LoadingMode::descent || strain <= 0.3)
        return std::nullopt;
      return "loading/axial_strain = " + text_of(strain) + " is " + text_of(100 * strain) + " % of the height; 3 % is 0.03";
    }

    // The last assignment of each key, in the order of the keys.
    std::vector<Entry> assignments_of(const std::vector<std::string> &keys, const std::vector<Entry> &entries)
    {
      std::vector<Entry> found;
      for (const std::string &key : keys)
        if (const auto last = std::find_if(entries.rbegin(), entries.rend(), [&](const Entry &e) { return e.name() == key; });
            last != entries.rend())
          found.push_back(*last);
      return found;
    }

    // "; FILE, line 12: continuum/cohesion = '3'" for each assignment.
    std::string places_of(const std::vector<Entry> &assignments)
    {
      std::string text;
      for (const Entry &entry : assignments)
        text += "; " + text_of(entry.place) + ": " + entry.name() + " = '" + entry.value + "'";
      return text;
    }

    // A scene file whose keys are checked. `section`: the messages name the keys without it; empty: with their section.
    struct Checked
    {
      const std::string        &file;
      const std::vector<Entry> &entries;
      std::string               section;
    };

    // The error begins with one place: the assignment of the first key that is set. Those of the other keys follow.
    [[noreturn]] void refuse(const Checked &checked, const std::vector<std::string> &keys, const std::string &text)
    {
      std::vector<Entry> about = assignments_of(keys, checked.entries);
      std::string        lead  = checked.file + ": " + (checked.section.empty() ? "" : "section " + checked.section + ": ");
      Refusal            refusal;
      refusal.key = keys.front();
      if (!about.empty())
        {
          const Entry first = about.front();
          lead = text_of(first.place) + ": " + (checked.section.empty() ? "" : first.name() + " = '" + first.value + "': ");
          if (first.name() == refusal.key)
            refusal = {first.place, first.name(), first.value};
          about.erase(about.begin());
        }
      SceneError whole(lead + text + places_of(about));
      whole.refusal = refusal;
      throw whole;
    }

    // Runs `check`. Its errors name the places where the keys are set. Errors in other files name these files.
    template <class Check> void with_places(const Checked &checked, Check &&check)
    {
      try
        {
          check();
        }
      catch (const WrongKeys &error)
        {
          refuse(checked, error.keys, error.what());
        }
      catch (const continuum::WrongKeys &error)
        {
          std::vector<std::string> keys = error.keys;
          for (std::string &key : keys)
            key.insert(0, "continuum/");
          refuse(checked, keys, error.what());
        }
      catch (const std::invalid_argument &error)
        {
          throw SceneError(error.what());
        }
    }

    using Unused = discrete::UnusedKey; // section and name of both

    std::vector<Unused> unused_keys(const LoadingOptions &o)
    {
      std::vector<Unused> keys;
      const auto          unless = [&](const bool read, const std::string &because, const std::vector<const char *> &names) {
        for (const char *name : names)
          if (!read)
            keys.push_back({std::string("loading/") + name, because});
      };
      const std::string mode = "loading/mode = " + text_of(o.mode);
      const bool        time = o.mode == LoadingMode::time;
      unless(time, mode, {"duration", "stage_time"});
      unless(!time, mode, {"axial_strain", "stage_strain", "inertial_number", "strain_rate", "affine_start"});
      unless(o.mode == LoadingMode::path, mode, {"path"});
      unless(o.mode == LoadingMode::descent, mode, {"horizontal_over_vertical"});
      unless(o.mode == LoadingMode::plane_shear, mode, {"normal_pressure"});
      const std::string stages = "loading/stages are given";
      unless(o.stages.empty(), stages, {"stage_strain", "stage_time"});
      unless(time || !(o.strain_rate > 0), "loading/strain_rate = " + text_of(o.strain_rate), {"inertial_number"});
      return keys;
    }

    std::vector<Unused> unused_keys(const ComparisonOptions &o)
    {
      std::vector<Unused>   keys;
      const AveragingMethod method  = o.averaging.method;
      const std::string     because = "comparison/averaging = " + text_of(method);
      if (method != AveragingMethod::kernel)
        keys.push_back({"comparison/averaging_kernel", because});
      if (method != AveragingMethod::kernel && method != AveragingMethod::projection)
        keys.push_back({"comparison/averaging_width", because});
      for (const char *name : {"zone_length", "aspect", "minimum_side"})
        if (!o.probes.probe_rectangles.empty())
          keys.push_back({std::string("comparison/") + name, "comparison/probe_rectangles are given"});
      return keys;
    }

    // Keys without effect for frames of another code, because the discrete panel computes nothing. The frictions choose
    // defaults of the continuum.
    void add_unread_of_imported(const Scene &scene, std::vector<Unused> &keys)
    {
      if (scene.discrete.method.method != discrete::Method::imported)
        return;
      const std::set<std::string> read = {
        "sample/mean_diameter", "sample/density",           "sample/seed",          "discrete/method",
        "discrete/file",        "discrete/lateral",         "discrete/side_motion", "loading/pressure",
        "loading/mode",         "loading/strain_rate",      "loading/stages",       "loading/axial_strain",
        "discrete/friction",    "discrete/rolling_friction"};
      for (const KeyDescription &key : keys_of(scene))
        if ((key.section == "sample" || key.section == "discrete" || key.section == "loading") &&
            read.count(key.full_name()) == 0)
          keys.push_back({key.full_name(), "discrete/method = imported"});
    }

    std::vector<Unused> unused_keys(const Scene &scene)
    {
      std::vector<Unused> keys = unused_keys(scene.loading);
      for (const Unused &unused : discrete::unused_keys(scene.sample, scene.discrete))
        keys.push_back(unused);
      for (const auto &[key, because] : continuum::unused_keys(scene.continuum))
        keys.push_back({"continuum/" + key, "continuum/" + because});
      for (const Unused &unused : unused_keys(scene.comparison))
        keys.push_back(unused);
      add_unread_of_imported(scene, keys);
      if (scene.loading.mode == LoadingMode::time)
        keys.push_back({"comparison/averaging_strain", "loading/mode = time: means are over the whole stage"});
      return keys;
    }
  } // namespace

  void complete_law(Scene &scene, const std::string &file, const std::vector<Entry> &entries)
  {
    with_places({file, entries, "continuum"}, [&] { continuum::complete(scene.continuum); });
  }

  void check_comparison(const Scene &scene, const std::string &file, const std::vector<Entry> &entries, const bool compares)
  {
    with_places({file, entries, ""}, [&] {
      if (const double coarse = scene.comparison.coarse_element_size; coarse > 0 && coarse < 0.1)
        throw WrongKeys({"comparison/coarse_element_size"},
                        "comparison/coarse_element_size = " + text_of(coarse) + ": 0 or a number from 0.1 on");
      check_stages(scene, compares);
    });
    with_places({file, entries, "comparison"}, [&] { check_probe_options(scene.comparison.probes); });
  }

  void check_scene(const Scene &scene, const std::string &file, const std::vector<Entry> &entries, const bool compares)
  {
    check_comparison(scene, file, entries, compares);
    with_places({file, entries, ""}, [&] {
      const discrete::Loading loading = discrete_loading(scene.loading);
      discrete::validate(scene.sample, loading, scene.discrete);
      discrete::check_sample_file(scene.sample, discrete::preparation_setting(loading, scene.discrete),
                                  [&] { leave_if_stopped("reading " + scene.sample.file); });
    });
    with_places({file, entries, "continuum"}, [&] { continuum::validate(scene.continuum); });
  }

  std::vector<std::string> warnings_of(const Scene &scene, const std::vector<Entry> &entries, const bool compares)
  {
    const auto values = values_of(scene), defaults = values_of(Scene());
    const auto is_default = [&](const std::string &key) {
      const auto standard = defaults.find(key); // parameters of a library have none
      return is_derived(key) || (standard != defaults.end() && values.at(key) == standard->second);
    };
    std::map<std::string, Entry> last;
    for (const Entry &entry : entries)
      last[entry.name()] = entry;
    std::vector<std::string> warnings;
    for (const auto &[key, because] : unused_keys(scene))
      if (const auto set = last.find(key); set != last.end() && !(set->second.of_resolved && is_default(key)))
        {
          warnings.push_back(text_of(set->second.place) + ": " + key + " = '" + values.at(key) + "' is not used: " + because);
          last.erase(set); // one reason is enough
        }
    for (const auto &[name, text] : continuum::doubtful_values(scene.continuum))
      {
        const auto set = last.find("continuum/" + name);
        warnings.push_back((set == last.end() ? "" : text_of(set->second.place) + ": ") + "continuum/" + name + text);
      }
    if (const auto text = doubtful_speed(scene))
      warnings.push_back(*text + places_of(assignments_of({"loading/inertial_number", "loading/strain_rate"}, entries)));
    if (const auto text = doubtful_strain(scene))
      warnings.push_back(*text + places_of(assignments_of({"loading/axial_strain"}, entries)));
    if (!compares)
      return warnings;
    if (const auto text = doubtful_platens(scene))
      warnings.push_back(*text + places_of(assignments_of({"discrete/platen_friction", "continuum/platens"}, entries)));
    if (const auto text = doubtful_coarse_mesh(scene))
      warnings.push_back(*text +
                         places_of(assignments_of({"comparison/coarse_element_size", "continuum/element_size"}, entries)));
    return warnings;
  }
} // namespace diptych::coupling
