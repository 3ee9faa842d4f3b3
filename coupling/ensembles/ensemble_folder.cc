// diptych: the folder of an ensemble and its members, and what may be kept of it
// SPDX-License-Identifier: LGPL-2.1-or-later
#include "coupling/ensembles/ensemble_folder.h"

#include <filesystem>
#include <map>

#include <nlohmann/json.hpp>

#include "coupling/folders/folder_lock.h"
#include "coupling/folders/provenance.h"
#include "coupling/folders/result_folder.h"
#include "coupling/folders/written_echo.h"
#include "coupling/scene/identity.h"
#include "coupling/scene/scene_file.h"
#include "discrete/files/text_file.h"

namespace diptych::coupling
{
  namespace
  {
    using nlohmann::json;
    namespace fs = std::filesystem;

    constexpr double largest_error_of_the_total = 1e-12; // above it `diptych run` ends with exit code 1

    // Throws an error naming the first key with two values.
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

    // Locks the folders of existing members. Throws, with nothing changed, if another run writes to one of them. Only folders
    // with a result of diptych are locked; `diptych run` refuses all others.
    std::map<std::string, FolderLock> held_members(const std::string &directory, const std::vector<int> &seeds)
    {
      std::map<std::string, FolderLock> held;
      for (const int seed : seeds)
        if (const std::string folder = member_folder(directory, seed); is_echo(folder + "/scene.prm"))
          held.try_emplace(folder, folder);
      return held;
    }

    // Refuses in advance what the run of a member would refuse or remove, while the statistics still exist.
    void demand_own_members(const std::string &directory, const std::vector<int> &seeds)
    {
      for (const int seed : seeds)
        {
          const std::string folder = member_folder(directory, seed), log = member_log(directory, seed);
          std::error_code   none;
          if (fs::exists(log, none) && !fs::is_regular_file(log, none))
            throw SceneError("output/directory: " + log + " is not a file, but the log of seed " + std::to_string(seed) +
                             " is to be written there; move it elsewhere");
          if (!fs::exists(folder, none))
            continue;
          if (!fs::is_directory(folder, none) || (!is_echo(folder + "/scene.prm") && !is_empty_folder(folder)))
            throw SceneError("output/directory: " + folder +
                             " holds other files and no result of diptych, but the result of seed " + std::to_string(seed) +
                             " is to be written there; move it elsewhere");
          demand_own_folders(folder);
        }
    }

    // If this run is killed before the member runs again, a later one must not resume remains of another scene.
    void forget_member(const std::string &folder, const Scene &scene)
    {
      const std::optional<Scene> earlier = echoed_scene(folder + "/scene.prm");
      remove_results(folder, comparison_files);
      remove_results(folder, {"provenance.json", "checkpoint.h5", "continuum_checkpoint.h5", "coarse"});
      if (!earlier || member_identity(*earlier) != member_identity(scene) || !changed_input(scene, folder + "/scene.prm").empty())
        {
          remove_panels(folder);
          write_echo(folder + "/scene.prm", scene);
        }
    }

    std::string changed_member_input(Scene scene, const int seed)
    {
      scene.sample.seed = seed;
      return changed_input(scene, member_folder(scene.output.directory, seed) + "/scene.prm");
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
    (void)recorded_scene(directory); // throws if this run cannot add to the folder
    demand_own_members(directory, seeds);
    for (const int seed : resume ? seeds : std::vector<int>())
      if (is_echo(member_folder(directory, seed) + "/scene.prm"))
        demand_member(scene, seed);
    const auto members = resume ? std::map<std::string, FolderLock>() : held_members(directory, seeds);
    // If this run is killed, the statistics of an earlier one must not stay.
    forget_files(directory, "ensemble");
    remove_results(directory, {"ensemble.json", "ensemble.csv", "ensemble.h5", "report.html"});
    for (const int seed : seeds)
      if (const std::string folder = member_folder(directory, seed); members.count(folder) > 0)
        {
          Scene member            = scene;
          member.sample.seed      = seed;
          member.output.directory = folder;
          forget_member(folder, member);
        }
    if (!resume)
      for (const int seed : seeds)
        remove_results(directory, {fs::path(member_log(directory, seed)).filename().string()});
    discrete::write_text(directory + "/ensemble.prm", echo(scene));
  }

  void demand_member(const Scene &scene, const int seed)
  {
    const std::string          file    = member_folder(scene.output.directory, seed) + "/scene.prm";
    const std::optional<Scene> earlier = echoed_scene(file);
    if (!earlier)
      throw SceneError(file + ": was written by another version, or is not the scene of a run");
    std::string difference = first_difference(member_identity(scene), member_identity(*earlier));
    if (difference.empty())
      difference = changed_member_input(scene, seed);
    if (earlier->sample.seed != seed)
      difference = "sample/seed = " + std::to_string(earlier->sample.seed);
    if (!difference.empty())
      throw SceneError(file + ": is not of this ensemble: " + difference + "; " +
                       (difference.rfind("comparison/", 0) == 0
                          ? "diptych compare " + member_folder(scene.output.directory, seed) + " --set with the value here, or "
                          : "") +
                       "without --resume the seeds are run again");
  }

  bool is_finished_member(const Scene &scene, const int seed)
  {
    const std::string          folder  = member_folder(scene.output.directory, seed);
    const std::optional<Scene> earlier = echoed_scene(folder + "/scene.prm");
    if (!earlier || member_identity(*earlier) != member_identity(scene) || !changed_member_input(scene, seed).empty())
      return false;
    if (scene.output.report && !fs::exists(folder + "/report.html"))
      return false;
    if (!doubt_about_files(folder).empty()) // killed just before its end, or its record was removed
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
    catch (const json::exception &) // written by another version
      {
        return false;
      }
  }
} // namespace diptych::coupling
