// diptych: the points of a study, each on every sample
// SPDX-License-Identifier: LGPL-2.1-or-later
#include "coupling/studies/study_points.h"

#include <iterator>

#include "coupling/scene/identity.h"
#include "coupling/scene/scene_file.h"
#include "coupling/studies/run_name.h"
#include "coupling/studies/study_columns.h"

namespace diptych::coupling
{
  namespace
  {
    constexpr std::size_t most_runs = 100000;

    bool names_the_seed(const Settings &settings)
    {
      for (const Entry &entry : settings)
        if (entry.value.find(seed_word) != std::string::npos)
          return true;
      return false;
    }

    // The settings for one sample. The seed replaces {seed} in the values, or becomes sample/seed.
    Settings on_sample(Settings settings, const std::string &seed, const Study &study)
    {
      if (seed.empty())
        return settings;
      if (!names_the_seed(settings))
        settings.push_back({"sample", "seed", seed, study.file + ": seeds", ""});
      for (Entry &entry : settings)
        entry = with_seed(entry, seed);
      return settings;
    }

    StudyRun run_of(const Study &study, const Settings &settings)
    {
      StudyRun run;
      run.command = study.command;
      try
        {
          Scene scene         = read_changed_scene(study.scene, settings, study.command == StudyCommand::run);
          scene.output.report = false;
          run.name            = run_name(scene, study.command);
          run.scene           = std::move(scene);
        }
      catch (const SceneError &error)
        {
          run.refusal = error.what();
          std::string text;
          for (const Entry &entry : settings)
            text += entry.section + "/" + entry.key + " = " + entry.value + "\n";
          run.name = "refused_" + hexadecimal(digest_of(text));
        }
      return run;
    }

    Settings joined(Settings first, const Settings &second)
    {
      first.insert(first.end(), second.begin(), second.end());
      return first;
    }

    void add_runs(const Study &study, const Settings &settings, ScenePoint &point)
    {
      for (const Entry &entry : settings)
        point.settings.push_back(entry.section + "/" + entry.key + " = " + entry.value);
      const Settings all = joined(study.settings, settings);
      for (int k = 0; k < study.n_samples(); ++k)
        point.runs.push_back(run_of(study, on_sample(all, study.seeds.empty() ? "" : std::to_string(study.seeds[k]), study)));
    }

    std::size_t n_points(const Family &family)
    {
      std::size_t n = family.is_grid || family.axes.empty() ? 1 : family.axes.front().points.size();
      for (const Axis &axis : family.axes)
        n *= family.is_grid ? axis.points.size() : 1;
      return n;
    }

    // Settings and labels that a point shares with its reference.
    struct Shared
    {
      Settings                 settings;
      std::vector<std::string> labels; // "axis label"
    };

    Shared shared_with_reference(const Family &family, const ScenePoint &point)
    {
      Shared shared;
      for (std::size_t k = 0; k < family.axes.size(); ++k)
        if (const AxisPoint &on_axis = family.axes[k].points[point.places[k]]; family.axes[k].own_reference)
          {
            shared.settings = joined(shared.settings, on_axis.settings);
            shared.labels.push_back(family.axes[k].name + " " + on_axis.label);
          }
      return shared;
    }

    ScenePoint point_of(const Study &study, const int family, std::size_t place)
    {
      const Family &of = study.families[std::size_t(family)];
      ScenePoint    point;
      point.family = family;
      point.places.assign(of.axes.size(), place);
      for (std::size_t k = of.axes.size(); of.is_grid && k-- > 0; place /= of.axes[k].points.size())
        point.places[k] = place % of.axes[k].points.size();
      Settings settings = of.settings;
      for (std::size_t k = 0; k < of.axes.size(); ++k)
        {
          const AxisPoint &on_axis = of.axes[k].points[point.places[k]];
          point.labels.push_back(on_axis.label);
          settings = joined(settings, on_axis.settings);
        }
      add_runs(study, settings, point);
      return point;
    }

    // Index of the reference with these labels. Adds it if it is missing.
    std::size_t reference_with(const Study &study, const Shared &shared, std::vector<ScenePoint> &references)
    {
      for (std::size_t k = 0; k < references.size(); ++k)
        if (references[k].labels == shared.labels)
          return k;
      ScenePoint reference;
      reference.reference = references.size();
      reference.labels    = shared.labels;
      add_runs(study, joined(study.reference, shared.settings), reference);
      for (const StudyRun &run : reference.runs)
        if (!run.scene)
          throw SceneError(study.file + ": the reference is refused: " + run.refusal);
      references.push_back(std::move(reference));
      return references.size() - 1;
    }
  } // namespace

  std::vector<ScenePoint> points_of(const Study &study)
  {
    std::size_t n = 1;
    for (const Family &family : study.families)
      n += n_points(family);
    if (n * std::size_t(study.n_samples()) > most_runs)
      throw SceneError(study.file + ": " + std::to_string(n) + " points on " + std::to_string(study.n_samples()) +
                       " samples; at most " + std::to_string(most_runs) + " runs are allowed");
    std::vector<ScenePoint> references, points;
    for (std::size_t family = 0; family < study.families.size(); ++family)
      for (std::size_t place = 0; place < n_points(study.families[family]); ++place)
        {
          points.push_back(point_of(study, int(family), place));
          const Shared shared     = shared_with_reference(study.families[family], points.back());
          points.back().reference = reference_with(study, shared, references);
        }
    references.insert(references.end(), std::make_move_iterator(points.begin()), std::make_move_iterator(points.end()));
    return references;
  }
} // namespace diptych::coupling
