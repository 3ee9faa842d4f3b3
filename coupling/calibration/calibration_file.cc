// diptych: reads and checks calibration files
// SPDX-License-Identifier: LGPL-2.1-or-later
#include "coupling/calibration/calibration_file.h"

#include <algorithm>
#include <filesystem>

#include "coupling/calibration/coordinates.h"
#include "coupling/scene/identity.h"
#include "coupling/scene/keys.h"
#include "coupling/scene/scene_file.h"
#include "coupling/store/file_names.h"
#include "coupling/store/provenance.h"
#include "coupling/studies/study_part.h"

namespace diptych::coupling
{
  namespace
  {
    constexpr double      far             = 1e12;
    constexpr std::size_t most_parameters = 12; // the starts are spread over at most so many directions

    std::string folder_of(const std::string &file)
    {
      return std::filesystem::path(file).parent_path().string();
    }

    void read_scene_and_seeds(const Part &part, const std::string &file, CalibrationTarget &target)
    {
      part.at("scene"), part.at("seeds");
      target.scene = resolved(part.word("scene"), folder_of(file));
      if (!std::filesystem::is_regular_file(target.scene))
        part.refuse("scene", " = '" + target.scene + "': there is no such file");
      target.seeds = part.seeds("seeds");
    }

    // Keys of sample, loading and discrete without the seed.
    Identity sample_part_of(const Scene &scene)
    {
      Identity identity = sample_identity(scene);
      identity.erase("sample/seed");
      return identity;
    }

    // Samples must come from one scene and differ in their seed only. For imported samples the file is the seed.
    void demand_samples_of_one_scene(const Part &part, const CalibrationTarget &target)
    {
      const auto sample_of = [&](const std::size_t k) {
        Scene       scene    = *resolved_scene(scene_prm(target.results[k]));
        const bool  imported = scene.discrete.method.method == discrete::Method::imported;
        std::string mark     = imported ? scene.discrete.method.file : std::to_string(scene.sample.seed);
        if (imported)
          scene.discrete.method.file.clear(), scene.loading.pressure = 1;
        return std::pair(mark, sample_part_of(scene));
      };
      for (std::size_t k = 0; k < target.results.size(); ++k)
        for (std::size_t j = 0; j < k; ++j)
          {
            const auto [mark, scene]             = sample_of(k);
            const auto [other_mark, other_scene] = sample_of(j);
            if (mark == other_mark)
              part.refuse("results",
                          ": '" + target.results[k] + "' and '" + target.results[j] + "' are the same sample (" + mark + ")");
            if (const std::string difference = first_difference(scene, other_scene); !difference.empty())
              part.refuse("results", ": '" + target.results[k] + "' and '" + target.results[j] +
                                       "' come from different scenes: " + difference);
          }
    }

    // A file that changed since its run would be fitted as if it were measured.
    void demand_as_left(const Part &part, const std::string &folder)
    {
      try
        {
          check_files(folder, "discrete");
        }
      catch (const std::invalid_argument &error)
        {
          part.refuse(std::string("results: ") + error.what());
        }
    }

    // Reads finished result folders. The first one's scene is used for the continuum.
    void read_results(const Part &part, const std::string &file, CalibrationTarget &target)
    {
      if (part.has("scene") || part.has("seeds"))
        part.refuse("results", " replaces scene and seeds; give one or the other");
      for (const Part &one : part.list("results"))
        {
          const std::string          folder = resolved(value_text(one.json()), folder_of(file));
          const std::optional<Scene> scene  = resolved_scene(scene_prm(folder));
          if (!scene || !std::filesystem::exists(discrete_csv(folder)) || !std::filesystem::exists(discrete_h5(folder)))
            one.refuse("results: '" + folder + "' is not a result folder; scene.prm, discrete.csv and discrete.h5 are needed");
          demand_as_left(one, folder);
          target.results.push_back(folder);
          target.seeds.push_back(scene->sample.seed);
        }
      if (target.results.empty())
        part.refuse("results", " is empty; name at least one result folder");
      demand_samples_of_one_scene(part, target);
      target.scene = scene_prm(target.results.front());
    }

    // Keys of the continuum in a fragment.
    Settings before_of(const Part &part, const std::string &file)
    {
      const std::string fragment = resolved(part.word("before"), folder_of(file));
      if (!std::filesystem::is_regular_file(fragment))
        part.refuse("before", " = '" + fragment + "': there is no such file");
      const Settings settings = read_fragment(fragment);
      for (const Entry &entry : settings)
        if (entry.section != "continuum")
          part.refuse("before",
                      " = '" + fragment + "' sets " + entry.section + "/" + entry.key + ", which is not a key of the continuum");
      return settings;
    }

    CalibrationTarget target_of(const Part &part, const std::string &file)
    {
      part.allow({"name", "scene", "set", "seeds", "results", "use", "before"});
      part.at("name");
      CalibrationTarget target;
      target.name     = part.word("name");
      target.settings = part.settings("set");
      if (part.has("results"))
        read_results(part, file, target);
      else
        read_scene_and_seeds(part, file, target);
      if (part.has("before"))
        target.before = before_of(part, file);
      const std::string use = part.word("use", "fit");
      if (use != "fit" && use != "predict")
        part.refuse("use", " = '" + use + "' is not allowed; use fit or predict");
      target.is_fitted = use == "fit";
      return target;
    }

    constexpr const char *keys_of_the_search[] = {"mesh",         "element_size", "rectangle_width", "rectangle_height",
                                                  "initial_step", "max_step"};

    // The coordinate of a key if the file names none.
    Coordinate usual_coordinate(const std::string &key)
    {
      if (key == "friction_angle_residual")
        return Coordinate::drop_from;
      if (key == "dilatancy_angle_peak" || key == "friction_angle_start")
        return Coordinate::share_of;
      return key == "poisson_ratio" ? Coordinate::value : Coordinate::logarithm;
    }

    void check_numbers(const Part &part, const CalibrationParameter &p)
    {
      const bool   is_ratio = p.coordinate == Coordinate::share_of || p.coordinate == Coordinate::drop_from;
      const double low = is_ratio ? 0 : -far, high = is_ratio ? 1 : far;
      if (!(p.low < p.high))
        part.refuse("low", " = " + text_of(p.low) + " and high = " + text_of(p.high) + ": bounds must ascend");
      if (!(p.start >= p.low && p.start <= p.high))
        part.refuse("start",
                    " = " + text_of(p.start) + " lies outside its bounds [" + text_of(p.low) + ", " + text_of(p.high) + "]");
      if (!(p.low >= low && p.high <= high))
        part.refuse("low", " = " + text_of(p.low) + " and high = " + text_of(p.high) + ": shares and drops lie between 0 and 1");
      if (p.coordinate == Coordinate::logarithm && !(p.low > 0))
        part.refuse("low", " = " + text_of(p.low) + ": a logarithm needs bounds above 0");
      if (!is_ratio) // must lie in the range of the key
        for (const char *name : {"low", "high"})
          part.setting(name, "continuum/" + p.key, part.json()[name]);
    }

    // Targets that the parameter belongs to; at least one of them must be fitted.
    std::vector<std::string> own_targets_of(const Part &part, const std::vector<CalibrationTarget> &targets)
    {
      std::vector<std::string> names;
      bool                     is_fitted = false;
      for (const Part &one : part.list("targets"))
        {
          const std::string name  = value_text(one.json());
          const auto        found = std::find_if(targets.begin(), targets.end(),
                                                 [&](const CalibrationTarget &target) { return target.name == name; });
          if (found == targets.end())
            one.refuse("targets: there is no target '" + name + "'");
          names.push_back(name);
          is_fitted = is_fitted || found->is_fitted;
        }
      if (part.has("targets") && !is_fitted)
        part.refuse("targets", ": none of these targets is fitted");
      return names;
    }

    CalibrationParameter parameter_of(const Part &part, const std::vector<CalibrationTarget> &targets)
    {
      part.allow({"key", "coordinate", "of", "start", "low", "high", "targets"});
      for (const char *key : {"key", "start", "low", "high"})
        part.at(key);
      CalibrationParameter p;
      p.key        = part.word("key");
      p.targets    = own_targets_of(part, targets);
      p.coordinate = part.choice("coordinate", usual_coordinate(p.key));
      p.start = part.number("start", -far, far), p.low = part.number("low", -far, far), p.high = part.number("high", -far, far);
      const bool is_ratio = p.coordinate == Coordinate::share_of || p.coordinate == Coordinate::drop_from;
      if (!is_ratio && part.has("of"))
        part.refuse("of", " is only allowed with coordinate = share_of or drop_from");
      p.other = is_ratio ? part.word("of", "friction_angle_peak") : "";
      part.setting("key", "continuum/" + p.key, 0.3); // checks that the key exists
      for (const char *key : keys_of_the_search)
        if (p.key == key)
          part.refuse("key", " = " + p.key + " is set by the calibration itself and cannot be a parameter");
      check_numbers(part, p);
      return p;
    }

    NoiseOptions noise_options_of(const Part &root)
    {
      NoiseOptions o;
      if (!root.has("noise"))
        return o;
      const Part                                                         part = root.at("noise");
      const std::vector<std::pair<std::string, double *>>                set  = {{"correlation_strain", &o.correlation_strain},
                                                                                 {"stress_discrepancy", &o.stress_discrepancy},
                                                                                 {"early_stress_discrepancy", &o.early_stress_discrepancy},
                                                                                 {"early_strain", &o.early_strain},
                                                                                 {"volume_discrepancy", &o.volume_discrepancy},
                                                                                 {"width_discrepancy", &o.width_discrepancy}};
      const std::vector<std::pair<std::string, std::optional<double> *>> estimates = {{"stress_level", &o.stress_level},
                                                                                      {"stress_shape", &o.stress_shape},
                                                                                      {"volume_start", &o.volume_start},
                                                                                      {"volume_growth", &o.volume_growth},
                                                                                      {"ln_width", &o.ln_width}};
      std::vector<std::string>                                           keys;
      for (const auto &[key, value] : set)
        keys.push_back(key);
      for (const auto &[key, value] : estimates)
        keys.push_back(key);
      part.allow(keys);
      const auto is_length = [](const std::string &key) { return key == "correlation_strain" || key == "early_strain"; };
      for (const auto &[key, value] : set)
        if (part.has(key))
          *value = part.number(key, is_length(key) ? 1e-9 : 0, far);
      for (const auto &[key, value] : estimates)
        if (part.has(key))
          *value = part.number(key, 0, far);
      return o;
    }

    std::vector<ObservableKind> kinds_of(const Part &root)
    {
      std::vector<ObservableKind> kinds;
      for (const Part &part : root.list("quantities"))
        {
          const std::string word = value_text(part.json());
          const auto        kind = discrete::value_of<ObservableKind>(word);
          if (!kind)
            part.refuse("quantities: '" + word + "' is not allowed; use some of " + discrete::listed(names_of(ObservableKind())));
          if (std::find(kinds.begin(), kinds.end(), *kind) != kinds.end())
            part.refuse("quantities: '" + word + "' is given twice");
          kinds.push_back(*kind);
        }
      if (kinds.empty())
        root.refuse("quantities", " is missing or empty; use some of " + discrete::listed(names_of(ObservableKind())));
      return kinds;
    }

    std::vector<double> bins_of(const Part &root)
    {
      std::vector<double> bins;
      for (const Part &part : root.list("bins"))
        {
          if (!part.json().is_number() || !(part.json().get<double>() >= 0) || (!bins.empty() && !(part.json() > bins.back())))
            part.refuse("bins: " + part.json().dump() + " is not allowed; edges must ascend and begin at 0 or above");
          bins.push_back(part.json());
        }
      if (bins.size() < 2)
        root.refuse("bins", " needs at least two edges");
      return bins;
    }

    template <class List, class NameOf>
    void demand_distinct(const Part &root, const char *key, const List &list, const NameOf &name)
    {
      for (std::size_t k = 0; k < list.size(); ++k)
        for (std::size_t j = 0; j < k; ++j)
          if (name(list[j]) == name(list[k]))
            root.refuse(key, ": two entries have the name '" + name(list[k]) + "'");
    }

    void read_targets(const Part &root, Calibration &c)
    {
      for (const Part &part : root.list("targets"))
        c.targets.push_back(target_of(part, c.file));
      if (std::none_of(c.targets.begin(), c.targets.end(), [](const CalibrationTarget &t) { return t.is_fitted; }))
        root.refuse("targets", " is missing, or none of the targets is fitted");
      demand_distinct(root, "targets", c.targets, [](const CalibrationTarget &t) { return t.name; });
    }

    void read_parameters(const Part &root, Calibration &c)
    {
      for (const Part &part : root.list("parameters"))
        c.parameters.push_back(parameter_of(part, c.targets));
      if (c.parameters.size() > most_parameters)
        root.refuse("parameters", ": at most " + std::to_string(most_parameters) + " parameters are allowed");
      if (c.parameters.empty())
        root.refuse("parameters", " is missing or empty; name the keys to be fitted");
      for (const CalibrationTarget &target : c.targets) // each target uses a key once
        {
          std::vector<std::string> keys;
          for (const CalibrationParameter &p : c.parameters)
            if (p.belongs_to(target.name))
              keys.push_back(p.key);
          demand_distinct(root, "parameters", keys, [](const std::string &key) { return key; });
        }
      c.fixed = root.settings("set");
      for (const Entry &entry : c.fixed)
        {
          if (entry.section != "continuum")
            root.refuse("set", ": " + entry.section + "/" + entry.key +
                                 " is not a key of the continuum; set keys of the grains in the targets");
          for (const char *key : keys_of_the_search)
            if (entry.key == key)
              root.refuse("set", ": continuum/" + entry.key +
                                   " is set by the calibration itself; set it in a target, or use load_step and "
                                   "coarse_element_size");
          for (const CalibrationParameter &p : c.parameters)
            if (p.key == entry.key)
              root.refuse("set", ": continuum/" + entry.key + " is already one of the parameters");
        }
    }
  } // namespace

  Calibration read_calibration(const std::string &file)
  {
    std::istringstream in   = scene_input(file);
    const JsonText     text = read_json_text(file, in);
    const Part         root(text, text.root, "");
    root.allow({"title", "targets", "quantities", "bins", "set", "parameters", "noise", "starts", "start_jacobians", "load_step",
                "coarse_element_size", "check_samples", "seed"});
    const std::filesystem::path path = std::filesystem::absolute(file);
    Calibration                 c;
    c.file  = file;
    c.name  = path.stem() == "calibration" ? path.parent_path().filename().string() : path.stem().string();
    c.title = root.word("title", c.name);
    read_targets(root, c);
    c.kinds = kinds_of(root);
    if (c.kinds != std::vector{ObservableKind::ln_width})
      c.bins = bins_of(root);
    read_parameters(root, c);
    c.noise = noise_options_of(root);
    if (root.has("starts"))
      c.starts = root.whole("starts", 1, 20);
    if (root.has("start_jacobians"))
      c.start_jacobians = root.whole("start_jacobians", 1, 20);
    if (root.has("load_step"))
      c.load_step = root.number("load_step", 1e-9, 1);
    if (root.has("coarse_element_size"))
      c.coarse_element_size = root.number("coarse_element_size", 0.01, 1e3);
    if (root.has("check_samples"))
      c.check_samples = root.whole("check_samples", 0, 1000);
    if (root.has("seed"))
      c.seed = root.whole("seed", 0, 1000000);
    return c;
  }
} // namespace diptych::coupling
