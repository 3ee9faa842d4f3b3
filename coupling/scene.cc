// diptych: the scene, every parameter of one comparison
// SPDX-License-Identifier: LGPL-2.1-or-later
#include "coupling/scene.h"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <map>
#include <regex>
#include <sstream>

#include <deal.II/base/parameter_handler.h>

#include <nlohmann/json.hpp>

#include "coupling/scene_visitors.h"
#include "discrete/nearest_name.h"

namespace diptych::coupling
{
  namespace
  {
    // The sections of a scene file. A new section is added here and nowhere else.
    template <class Function> void for_each_section(Scene &scene, Function &&function)
    {
      function("sample", scene.sample);
      function("loading", scene.loading);
      function("discrete", scene.discrete);
      function("continuum", scene.continuum);
      function("comparison", scene.comparison);
      function("output", scene.output);
    }

    void declare(dealii::ParameterHandler &prm)
    {
      Scene defaults;
      for_each_section(defaults, [&](const char *section, auto &options) {
        prm.enter_subsection(section);
        visit_parameters(options, DeclareVisitor{prm});
        prm.leave_subsection();
      });
    }

    void fetch(dealii::ParameterHandler &prm, Scene &scene)
    {
      for_each_section(scene, [&](const char *section, auto &options) {
        prm.enter_subsection(section);
        visit_parameters(options, FetchVisitor{prm});
        prm.leave_subsection();
      });
    }

    std::vector<KeyDescription> describe(const std::string &wanted_section)
    {
      std::vector<KeyDescription> keys;
      Scene                       defaults;
      for_each_section(defaults, [&](const char *section, auto &options) {
        if (wanted_section.empty() || wanted_section == section)
          visit_parameters(options, DescribeVisitor{section, keys});
      });
      return keys;
    }

    std::vector<std::string> section_names()
    {
      std::vector<std::string> names;
      Scene                    scene;
      for_each_section(scene, [&](const char *section, auto &) { names.push_back(section); });
      return names;
    }

    // One assignment with the place it was made at.
    struct Entry
    {
      std::string section, key, value, place;
    };

    void check_and_set(dealii::ParameterHandler &prm, const Entry &entry)
    {
      const std::vector<std::string> sections = section_names();
      if (std::find(sections.begin(), sections.end(), entry.section) == sections.end())
        throw SceneError(entry.place + ": unknown section '" + entry.section + "'; the nearest is '" +
                         discrete::nearest_name(entry.section, sections) + "'");
      const std::vector<KeyDescription> keys = describe(entry.section);
      std::vector<std::string>          names;
      for (const KeyDescription &key : keys)
        names.push_back(key.name);
      const auto found = std::find(names.begin(), names.end(), entry.key);
      if (found == names.end())
        throw SceneError(entry.place + ": unknown key '" + entry.section + "/" + entry.key + "'; the nearest is '" +
                         entry.section + "/" + discrete::nearest_name(entry.key, names) + "'");
      const KeyDescription &key = keys[found - names.begin()];
      prm.enter_subsection(entry.section);
      try
        {
          prm.set(entry.key, entry.value);
        }
      catch (const dealii::ExceptionBase &)
        {
          throw SceneError(entry.place + ": " + entry.section + "/" + entry.key + " = '" + entry.value +
                           "' is not allowed: " + key.allowed + " [" + key.unit + "] is");
        }
      prm.leave_subsection();
    }

    std::string trimmed(const std::string &text)
    {
      const auto first = text.find_first_not_of(" \t\r\n");
      return first == std::string::npos ? "" : text.substr(first, text.find_last_not_of(" \t\r\n") - first + 1);
    }

    // The lines of a .prm file as deal.II's ParameterHandler defines them: subsection / set / end, '#' comments and '\'
    // continuation. Read here, because an error must name the line together with the nearest key.
    std::vector<Entry> entries_of_prm(const std::string &file, std::istream &in)
    {
      std::vector<Entry> entries;
      std::string        section, raw;
      int                number = 0;
      while (std::getline(in, raw))
        {
          const std::string place = file + ", line " + std::to_string(++number);
          std::string       line  = trimmed(raw.substr(0, raw.find('#')));
          while (!line.empty() && line.back() == '\\' && std::getline(in, raw))
            line = trimmed(line.substr(0, line.size() - 1)) + " " + trimmed(raw.substr(0, raw.find('#'))), ++number;
          std::smatch match;
          if (line.empty())
            continue;
          if (std::regex_match(line, match, std::regex("subsection\\s+(.+)", std::regex::icase)))
            {
              if (!section.empty())
                throw SceneError(place + ": subsection '" + match[1].str() + "' inside '" + section + "'; 'end' is missing");
              section = match[1];
            }
          else if (std::regex_match(line, std::regex("end", std::regex::icase)))
            {
              if (section.empty())
                throw SceneError(place + ": 'end' without a subsection");
              section.clear();
            }
          else if (std::regex_match(line, match, std::regex("set\\s+([^=]+?)\\s*=\\s*(.*)", std::regex::icase)))
            entries.push_back({section, match[1], match[2], place});
          else
            throw SceneError(place + ": '" + line + "' is neither 'subsection NAME', 'set KEY = VALUE' nor 'end'");
        }
      if (!section.empty())
        throw SceneError(file + ", line " + std::to_string(number) + ": subsection '" + section + "' has no 'end'");
      return entries;
    }

    // {"section": {"key": value}}; the value may also stand as {"value": ...}, deal.II's long form. Lines are found again by
    // the key's text, because the parser keeps none.
    std::vector<Entry> entries_of_json(const std::string &file, std::istream &in)
    {
      std::ostringstream buffer;
      buffer << in.rdbuf();
      const std::string text = buffer.str();
      nlohmann::json    root;
      try
        {
          root = nlohmann::json::parse(text, nullptr, true, /* comments */ true);
        }
      catch (const nlohmann::json::parse_error &error)
        {
          const auto line = 1 + std::count(text.begin(), text.begin() + std::min(text.size(), std::size_t(error.byte)), '\n');
          throw SceneError(file + ", line " + std::to_string(line) + ": no JSON: " + error.what());
        }
      if (!root.is_object())
        throw SceneError(file + ", line 1: a scene is an object of sections");

      const auto line_of = [&](const std::string &name, const std::size_t from) {
        const std::size_t at = std::min(text.find('"' + name + '"', from), text.size());
        return std::pair<std::size_t, std::string>(at, file + ", line " +
                                                         std::to_string(1 + std::count(text.begin(), text.begin() + at, '\n')));
      };
      const auto value_text = [](const nlohmann::json &value) {
        const auto plain = [](const nlohmann::json &v) { return v.is_string() ? v.get<std::string>() : v.dump(); };
        if (!value.is_array())
          return plain(value);
        std::string list;
        for (const nlohmann::json &item : value)
          list += (list.empty() ? "" : ", ") + plain(item);
        return list;
      };
      std::vector<Entry> entries;
      for (const auto &[section, content] : root.items())
        {
          const auto [at, section_place] = line_of(section, 0);
          if (!content.is_object())
            throw SceneError(section_place + ": '" + section + "' must be a section: an object of keys");
          for (const auto &[key, value] : content.items())
            {
              const bool long_form = value.is_object() && value.contains("value");
              if (value.is_object() && !long_form)
                throw SceneError(line_of(key, at).second + ": '" + section + "/" + key + "' must be a value, not a section");
              entries.push_back({section, key, value_text(long_form ? value["value"] : value), line_of(key, at).second});
            }
        }
      return entries;
    }

    // `last`: the end in the unit of the stages.
    void check_windows(const std::string &file, const Scene &scene, const double last)
    {
      const bool   time     = scene.loading.mode == "time";
      const double interval = time ? scene.loading.stage_time : scene.loading.stage_strain;
      for (const double edge : scene.comparison.window_edges)
        {
          const double k = edge / interval;
          if (std::abs(k - std::round(k)) > 1e-6 || edge > last * (1 + 1e-9))
            throw SceneError(file + ": comparison/window_edges holds " + std::to_string(edge) +
                             ", which is no stage: stages are multiples of loading/" + (time ? "stage_time" : "stage_strain") +
                             " = " + std::to_string(interval) + " up to loading/" + (time ? "duration" : "axial_strain") + " = " +
                             std::to_string(last));
        }
    }

    void check_stages(const std::string &file, const Scene &scene, const bool compares)
    {
      const LoadingOptions &loading = scene.loading;
      const bool            time    = loading.mode == "time";
      const double          last    = time ? loading.duration : loading.axial_strain;
      const double          count   = last / (time ? loading.stage_time : loading.stage_strain);
      if (time && (std::abs(count - std::round(count)) > 1e-6 || count < 0.5))
        throw SceneError(file + ": loading/duration = " + std::to_string(loading.duration) +
                         " is not a whole number of loading/stage_time = " + std::to_string(loading.stage_time));
      if (!time && (std::abs(count - std::round(count)) > 1e-6 || count < 0.5))
        throw SceneError(file + ": loading/axial_strain = " + std::to_string(loading.axial_strain) +
                         " is not a whole number of loading/stage_strain = " + std::to_string(loading.stage_strain));
      const std::vector<double> &edges = scene.comparison.window_edges;
      if (edges.size() < 2 || std::adjacent_find(edges.begin(), edges.end(), std::greater_equal<double>()) != edges.end())
        throw SceneError(file + ": comparison/window_edges must be at least two ascending axial strains");
      if (compares)
        check_windows(file, scene, last);
    }

    // "; FILE, line 12: continuum/cohesion = '3'" for every key of the section that a message speaks of, as it was set last.
    std::string places_of(const std::string &message, const std::string &section, const std::vector<Entry> &entries)
    {
      std::map<std::string, Entry> last;
      for (const Entry &entry : entries)
        if (entry.section == section)
          last[entry.key] = entry;
      std::string text;
      for (const auto &[key, entry] : last)
        if (std::regex_search(message, std::regex("\\b" + key + "\\b")))
          text += "; " + entry.place + ": " + section + "/" + key + " = '" + entry.value + "'";
      return text;
    }

    Scene checked(Scene scene, const std::string &file, const std::vector<Entry> &entries, const bool compares)
    {
      if (const double coarse = scene.comparison.coarse_element_size; coarse > 0 && coarse < 0.1)
        throw SceneError(file + ": comparison/coarse_element_size = " + text_of(coarse) + ": 0 or a number from 0.1 on");
      check_stages(file, scene, compares);
      try
        {
          check_probe_options(scene.comparison.probes);
        }
      catch (const std::invalid_argument &error)
        {
          throw SceneError(file + ": section comparison: " + error.what() + places_of(error.what(), "comparison", entries));
        }
      try
        {
          discrete::validate(scene.sample, discrete_loading(scene.loading), scene.discrete);
          discrete::check_sample_file(scene.sample,
                                      discrete::preparation_setting(discrete_loading(scene.loading), scene.discrete));
        }
      catch (const std::invalid_argument &error)
        {
          throw SceneError(file + ": " + error.what());
        }
      try
        {
          continuum::validate(scene.continuum);
        }
      catch (const std::invalid_argument &error)
        {
          throw SceneError(file + ": section continuum: " + error.what() + places_of(error.what(), "continuum", entries));
        }
      return scene;
    }

    // results/moreau_1997 for .../moreau_1997/scene.prm, results/mine for mine.prm.
    std::string scene_name(const std::string &file)
    {
      const std::filesystem::path path = std::filesystem::absolute(file);
      return path.stem() == "scene" ? path.parent_path().filename().string() : path.stem().string();
    }
  } // namespace

  Scene read_scene(const std::string &file, const std::vector<std::string> &overrides, const bool compares)
  {
    std::ifstream in(file);
    if (!in || std::filesystem::is_directory(file))
      throw SceneError(file + ": cannot be read");

    dealii::ParameterHandler prm;
    declare(prm);
    const bool         json    = std::filesystem::path(file).extension() == ".json";
    std::vector<Entry> entries = json ? entries_of_json(file, in) : entries_of_prm(file, in);
    for (const std::string &text : overrides)
      {
        std::smatch match;
        if (!std::regex_match(text, match, std::regex("([^/=]+)/([^/=]+)=(.*)")))
          throw SceneError("--set " + text + ": not of the form section/key=value");
        entries.push_back({match[1], match[2], match[3], "--set " + text});
      }
    for (const Entry &entry : entries)
      check_and_set(prm, entry);
    Scene scene;
    fetch(prm, scene);
    scene.name = scene_name(file);
    if (scene.output.directory.empty())
      scene.output.directory = "results/" + scene.name;
    return checked(scene, file, entries, compares);
  }

  std::string echo(const Scene &scene)
  {
    std::ostringstream out;
    out << "# " << scene.name << ": " << echo_title << '\n';
    Scene copy = scene;
    for_each_section(copy, [&](const char *section, auto &options) {
      std::vector<KeyDescription> keys;
      visit_parameters(options, DescribeVisitor{section, keys});
      out << "\nsubsection " << section << '\n';
      for (const KeyDescription &key : keys)
        out << "  # " << key.meaning << " [" << key.unit << "]; " << key.allowed << "\n  set " << key.name << " = " << key.value
            << '\n';
      out << "end\n";
    });
    return out.str();
  }

  std::string explain(const std::string &section)
  {
    const std::vector<std::string> sections = section_names();
    if (!section.empty() && std::find(sections.begin(), sections.end(), section) == sections.end())
      throw SceneError("unknown section '" + section + "'; the nearest is '" + discrete::nearest_name(section, sections) + "'");
    std::ostringstream out;
    std::string        current;
    for (const KeyDescription &key : describe(section))
      {
        if (key.section != current)
          out << (current.empty() ? "" : "\n") << key.section << '\n';
        current = key.section;
        out << "  " << key.name << " = " << (key.value.empty() ? "(empty)" : key.value) << "  [" << key.unit << "]  "
            << key.allowed << "\n      " << key.meaning << '\n';
      }
    return out.str();
  }

  std::vector<double> stages(const LoadingOptions &loading)
  {
    const bool   time     = loading.mode == "time";
    const double end      = time ? loading.duration : loading.axial_strain,
                 interval = time ? loading.stage_time : loading.stage_strain;
    std::vector<double> values;
    const int           count = int(std::lround(end / interval));
    for (int k = 1; k <= count; ++k)
      values.push_back(k * interval);
    return values;
  }

  discrete::Loading discrete_loading(const LoadingOptions &loading)
  {
    using discrete::LoadingMode;
    const std::map<std::string, LoadingMode> modes = {{"descent", LoadingMode::descent},
                                                      {"shear", LoadingMode::shear},
                                                      {"plane_shear", LoadingMode::plane_shear},
                                                      {"time", LoadingMode::time}};
    return {loading.pressure,    loading.inertial_number, loading.horizontal_over_vertical,
            stages(loading),     loading.affine_start,    modes.at(loading.mode),
            loading.strain_rate, loading.normal_pressure};
  }

  double averaging_width(const Scene &scene)
  {
    return scene.loading.mode == "time" ? scene.loading.stage_time : scene.comparison.averaging_strain;
  }
} // namespace diptych::coupling
