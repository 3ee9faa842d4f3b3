// diptych: the folder of an ensemble: what is in it, what of it may stay
// SPDX-License-Identifier: LGPL-2.1-or-later
#include "coupling/ensembles/ensemble_folder.h"

#include <filesystem>
#include <map>

#include <nlohmann/json.hpp>

#include "coupling/folders/folder_lock.h"
#include "coupling/folders/provenance.h"
#include "coupling/folders/result_folder.h"
#include "coupling/scene/identity.h"
#include "coupling/scene/scene_file.h"
#include "discrete/files/text_file.h"

namespace diptych::coupling
{
  namespace
  {
    using nlohmann::json;
    namespace fs = std::filesystem;

    constexpr double largest_error_of_the_total = 1e-12; // beyond it `diptych run` ends with exit code 1

    // Names the first key with two values.
    void demand_same_scene(const Scene &scene)
    {
      const std::string          file       = scene.output.directory + "/ensemble.prm";
      const std::optional<Scene> earlier    = echoed_scene(file);
      const std::string          difference = earlier ? first_difference(member_identity(scene), member_identity(*earlier))
                                                      : "it was written by another version";
      if (!difference.empty())
        throw SceneError("--resume: the scene is not that of " + file + ": " + difference +
                         "; resume with the same scene or start without --resume");
    }

    // Folders of members that stand there, held: throws, with nothing changed, where another run writes to one of them. Only
    // those that hold a result of diptych: `diptych run` refuses any other, too.
    std::map<std::string, FolderLock> held_members(const std::string &directory, const std::vector<int> &seeds)
    {
      std::map<std::string, FolderLock> held;
      for (const int seed : seeds)
        if (const std::string folder = member_folder(directory, seed); is_echo(folder + "/scene.prm"))
          held.try_emplace(folder, folder);
      return held;
    }

    void forget_member(const std::string &folder)
    {
      remove_results(folder, comparison_files);
      remove_results(folder, {"provenance.json", "checkpoint.h5", "continuum_checkpoint.h5", "coarse"});
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
    return is_echo(directory + "/ensemble.prm");
  }

  void open_ensemble_folder(const Scene &scene, const std::vector<int> &seeds, const bool resume)
  {
    const std::string &directory = scene.output.directory;
    make_folder(directory);
    const bool is_ensemble = is_ensemble_folder(directory);
    if (!is_ensemble && !is_empty_folder(directory))
      throw SceneError("output/directory = '" + directory +
                       "' holds other files and no ensemble of diptych; name a new or an empty folder");
    if (resume && is_ensemble)
      demand_same_scene(scene);
    (void)recorded_scene(directory); // throws where this run could not add to what stands there
    const auto members = resume ? std::map<std::string, FolderLock>() : held_members(directory, seeds);
    // Killed before its end, this run must not leave the statistics of an earlier one.
    remove_results(directory, {"ensemble.json", "ensemble.csv", "ensemble.h5", "report.html"});
    for (const auto &[folder, lock] : members)
      forget_member(folder);
    if (!resume)
      for (const int seed : seeds)
        fs::remove(member_log(directory, seed));
    discrete::write_text(directory + "/ensemble.prm", echo(scene));
  }

  bool is_finished_member(const Scene &scene, const int seed)
  {
    const std::string          folder  = member_folder(scene.output.directory, seed);
    const std::optional<Scene> earlier = echoed_scene(folder + "/scene.prm");
    if (!earlier || member_identity(*earlier) != member_identity(scene))
      return false;
    if (scene.output.report && !fs::exists(folder + "/report.html"))
      return false;
    const json comparison = json::parse(discrete::read_text(folder + "/comparison.json"), nullptr, /* exceptions */ false);
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
    catch (const json::exception &) // of another type than this version writes: not its own
      {
        return false;
      }
  }
} // namespace diptych::coupling
