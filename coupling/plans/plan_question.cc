// diptych: reads the question of a plan from the command line
// SPDX-License-Identifier: LGPL-2.1-or-later
#include "coupling/plans/plan_question.h"

#include <algorithm>
#include <cstdlib>
#include <sstream>

#include "coupling/scene/keys.h"
#include "coupling/scene/scene_file.h"

namespace diptych::coupling
{
  namespace
  {
    constexpr double early_strain = 0.003; // below it the strength depends on how the loading started

    const std::string discrete_panel_name = "discrete", continuum_panel_name = "continuum";

    // One name of --for, for one panel.
    struct Wanted
    {
      std::string name, panel;
    };

    StudyQuantity relative_quantity(const Wanted &wanted, const Reduction reduction, const std::string &column)
    {
      StudyQuantity q;
      q.name      = wanted.panel + "." + wanted.name;
      q.source    = wanted.panel == discrete_panel_name ? Source::discrete : Source::continuum;
      q.reduction = reduction;
      q.column    = column;
      return q;
    }

    // "window 0.02-0.03 discrete band width_10_90_d"
    StudyQuantity band_number(const Wanted &wanted, const Scene &scene, const std::string &key)
    {
      const std::vector<double> &edges = scene.comparison.window_edges;
      const std::string window = "window " + text_of(edges[edges.size() - 2]) + "-" + text_of(edges.back()) + " " + wanted.panel +
                                 " band ";
      StudyQuantity q = relative_quantity(wanted, Reduction::number, window + key);
      q.source        = Source::comparison;
      q.is_line       = key == "angle_deg";
      return q;
    }

    const std::vector<std::string> &short_names()
    {
      static const std::vector<std::string> names = {"peak_stress_ratio", "strength", "final_volumetric_strain", "width_10_90",
                                                     "angle"};
      return names;
    }

    std::string listed_names()
    {
      std::string list;
      for (const std::string &name : short_names())
        list += (list.empty() ? "" : ", ") + name;
      return list;
    }

    PlanQuantity quantity_of(const Wanted &wanted, const Scene &scene)
    {
      if (wanted.name == "peak_stress_ratio")
        {
          StudyQuantity q = relative_quantity(wanted, Reduction::peak, "stress_ratio");
          q.to            = averaging_width(scene);
          return {q, StepError::strength};
        }
      if (wanted.name == "strength")
        {
          StudyQuantity q   = relative_quantity(wanted, Reduction::strength, "");
          const double  end = stages(scene.loading).back();
          q.from = end > 2 * early_strain ? early_strain : end / 2, q.to = end;
          return {q, StepError::strength};
        }
      if (wanted.name == "final_volumetric_strain")
        return {relative_quantity(wanted, Reduction::last, "volumetric_strain"), StepError::dilation};
      return {band_number(wanted, scene, wanted.name == "angle" ? "angle_deg" : "width_10_90_d"), StepError::unknown};
    }

    // The panels that a scene describes.
    struct Panels
    {
      bool grains = false, continuum = false;
    };

    // Panels with keys in the scene file; a resolved scene sets all keys.
    Panels panels_of(const std::string &file, const Scene &scene)
    {
      const bool shares_sample = scene.continuum.mesh.kind == continuum::MeshOption::Kind::outline;
      if (is_resolved_scene(file))
        return {shares_sample, true};
      Panels panels;
      for (const std::string &section : sections_set_in(file))
        {
          panels.grains    = panels.grains || section == "sample" || section == "discrete";
          panels.continuum = panels.continuum || section == "continuum";
        }
      panels.grains = panels.grains || !panels.continuum;
      return panels;
    }

    std::vector<std::string> words_of(const std::string &list)
    {
      std::vector<std::string> words;
      std::istringstream       in(list.empty() ? "peak_stress_ratio,strength" : list);
      for (std::string word; std::getline(in, word, ',');)
        {
          word.erase(0, word.find_first_not_of(' '));
          word.erase(word.find_last_not_of(' ') + 1);
          words.push_back(word);
        }
      return words;
    }

    bool begins_with(const std::string &text, const std::string &begin)
    {
      return text.compare(0, begin.size(), begin) == 0;
    }

    // Removes the prefix "discrete." or "continuum."; without one, both panels are meant.
    Panels taken_prefix(std::string &word)
    {
      for (const std::string &panel : {discrete_panel_name, continuum_panel_name})
        if (begins_with(word, panel + "."))
          {
            word.erase(0, panel.size() + 1);
            return {panel == discrete_panel_name, panel == continuum_panel_name};
          }
      return {true, true};
    }

    void add(PlanQuestion &question, const Wanted &wanted, const Scene &scene)
    {
      const PlanQuantity quantity = quantity_of(wanted, scene);
      question.needs_comparison   = question.needs_comparison || quantity.quantity.source == Source::comparison;
      (wanted.panel == discrete_panel_name ? question.grains : question.continuum).push_back(quantity);
    }

    // Adds a number of comparison.json for the panel in its name.
    bool add_number(PlanQuestion &question, const std::string &name)
    {
      const bool of_grains    = name.find(" discrete ") != std::string::npos || begins_with(name, "discrete_summary "),
                 of_continuum = name.find(" continuum ") != std::string::npos || begins_with(name, "continuum_summary ");
      if (of_grains == of_continuum)
        return false;
      PlanQuantity number;
      number.quantity.name      = name;
      number.quantity.source    = Source::comparison;
      number.quantity.reduction = Reduction::number;
      number.quantity.column    = name;
      number.quantity.is_line   = name.find("angle") != std::string::npos;
      number.step_error         = StepError::unknown;
      question.needs_comparison = true;
      (of_grains ? question.grains : question.continuum).push_back(number);
      return true;
    }

    void check(const PlanQuestion &question, const Scene &scene)
    {
      if (scene.loading.mode == discrete::LoadingMode::time)
        throw SceneError(question.scene + ": loading/mode = time; plans support loadings along a strain only");
      if (!question.grains.empty() && scene.discrete.method.method != discrete::Method::nscd)
        throw SceneError(question.scene + ": discrete/method = " + text_of(scene.discrete.method.method) +
                         "; plans support nscd only (cost of springs: benchmarks/penalty, benchmarks/rigid_limit)");
      if (question.needs_comparison && scene.continuum.mesh.kind != continuum::MeshOption::Kind::outline)
        throw SceneError(question.scene + ": continuum/mesh = " + text_of(scene.continuum.mesh) +
                         "; --for asks for a number of the comparison, which needs both panels on one sample (mesh = outline)");
    }
  } // namespace

  double read_accuracy(const std::string &text)
  {
    char        *rest  = nullptr;
    const double value = std::strtod(text.c_str(), &rest);
    std::string  unit  = rest;
    unit.erase(0, unit.find_first_not_of(' '));
    const double accuracy = unit == "%" ? value / 100 : value;
    if (rest == text.c_str() || !(unit.empty() || unit == "%") || !(accuracy >= 0.001 && accuracy <= 0.5))
      throw SceneError("--accuracy '" + text + "' is not allowed; use a number from 0.001 to 0.5, or from 0.1 % to 50 %");
    return accuracy;
  }

  PlanQuestion read_question(const PlanWords &words)
  {
    PlanQuestion question;
    question.scene    = words.scene;
    question.accuracy = read_accuracy(words.accuracy);
    for (const std::string &text : words.overrides)
      question.changes.push_back(entry_of_override(text));
    const Scene  scene  = read_changed_scene(question.scene, question.changes, false);
    const Panels panels = panels_of(question.scene, scene);
    for (std::string word : words_of(words.wanted))
      {
        const std::string whole  = word;
        const Panels      wanted = taken_prefix(word);
        if (std::find(short_names().begin(), short_names().end(), word) == short_names().end())
          {
            if (!add_number(question, whole))
              throw SceneError("--for '" + whole + "' is unknown; use " + listed_names() +
                               ", with the prefix discrete. or continuum. for one panel, or a number of comparison.json with "
                               "its name in ensemble.csv");
            continue;
          }
        const bool names_one = wanted.grains != wanted.continuum;
        if (names_one && ((wanted.grains && !panels.grains) || (wanted.continuum && !panels.continuum)))
          throw SceneError("--for '" + whole + "': " + question.scene + " sets no key of " +
                           (wanted.grains ? "sample or discrete" : "continuum"));
        if (wanted.grains && (panels.grains || names_one))
          add(question, {word, discrete_panel_name}, scene);
        if (wanted.continuum && (panels.continuum || names_one))
          add(question, {word, continuum_panel_name}, scene);
      }
    check(question, scene);
    return question;
  }

  Entry planned(const std::string &section, const std::string &key, const std::string &value)
  {
    return {section, key, value, "plan", ""};
  }

  Entry planned(const std::string &section, const std::string &key, const double value)
  {
    return planned(section, key, text_of(value));
  }
} // namespace diptych::coupling
