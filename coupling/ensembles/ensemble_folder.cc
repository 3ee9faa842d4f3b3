// diptych: the folder of an ensemble
// SPDX-License-Identifier: LGPL-2.1-or-later
#include "coupling/ensembles/ensemble_folder.h"

#include <filesystem>

#include <nlohmann/json.hpp>

#include "coupling/scene/identity.h"
#include "coupling/scene/scene_file.h"
#include "coupling/store/file_names.h"
#include "coupling/store/folder_lock.h"
#include "coupling/store/provenance.h"
#include "coupling/store/result_folder.h"
#include "discrete/files/text_file.h"

namespace diptych::coupling
{
  namespace
  {
    using nlohmann::json;
    namespace fs = std::filesystem;

    constexpr double largest_error_of_the_total = 1e-12; // above it `diptych run` ends with exit code 1

    // Throws SceneError naming the first key that differs.
    void demand_same_scene(const Scene &scene)
    {
      const std::string          file       = scene.output.directory + "/ensemble.prm";
      const std::optional<Scene> earlier    = resolved_scene(file);
      const std::string          difference = earlier ? first_difference(member_identity(scene), member_identity(*earlier))
                                                      : "another version of the program wrote it";
      if (!difference.empty())
        throw SceneError("--resume: the scene differs from " + file + ": " + difference +
                         ". Give the same scene, or --overwrite.");
    }

    Scene member_scene(Scene scene, const int seed)
    {
      scene.sample.seed      = seed;
      scene.output.directory = member_folder(scene.output.directory, seed);
      return scene;
    }
  } // namespace

  std::string member_folder(const std::string &directory, const int seed)
  {
    return directory + "/seed_" + std::to_string(seed);
  }

  std::string member_log(const std::string &directory, const int seed)
  {
    return member_folder(directory, seed) + ".log";
  }

  bool is_ensemble_folder(const std::string &directory)
  {
    return is_resolved_scene(directory + "/ensemble.prm");
  }

  void open_ensemble_folder(const Scene &scene, FolderLock &lock, const std::vector<int> &seeds, const Opening &opening)
  {
    const std::string &directory = scene.output.directory;
    const bool         is_empty  = is_empty_folder(directory);
    require_usable(directory, opening);
    if (!is_empty && opening.overwrite)
      {
        InputFiles inputs = opening.inputs;
        for (const auto &input : input_files(scene))
          inputs.push_back(input);
        set_aside(lock, inputs);
      }
    else if (!is_empty)
      {
        demand_same_scene(scene);
        for (const int seed : seeds)
          if (fs::exists(scene_prm(member_folder(directory, seed))))
            demand_member(scene, seed);
      }
    discrete::write_text(directory + "/ensemble.prm", resolved_text(scene));
  }

  void demand_member(const Scene &scene, const int seed)
  {
    const Scene        member     = member_scene(scene, seed);
    const SceneChanges changes    = ResultFolder(member).changes();
    const std::string &difference = changes.sample.empty() ? changes.comparison : changes.sample;
    if (!difference.empty())
      throw SceneError("the results in '" + member.output.directory + "' are not of this ensemble: " + difference +
                       ". Move them elsewhere, or run the ensemble with --overwrite.");
  }

  bool is_finished_member(const Scene &scene, const int seed)
  {
    const Scene       member = member_scene(scene, seed);
    const std::string folder = member.output.directory;
    if (!ResultFolder(member).holds_finished_run())
      return false;
    const json comparison = json::parse(discrete::read_text(comparison_json(folder)), nullptr, /* exceptions */ false);
    try
      {
        if (!comparison.is_object() || comparison.value("seed", -1) != seed)
          return false;
        const auto is_exact = [](const json &stage) {
          return stage.value("/mapping/total_relative_error"_json_pointer, 1.) < largest_error_of_the_total;
        };
        const json stages = comparison.value("stages", json::array());
        return stages.is_array() && std::all_of(stages.begin(), stages.end(), is_exact);
      }
    catch (const json::exception &) // written by another version
      {
        return false;
      }
  }
} // namespace diptych::coupling
