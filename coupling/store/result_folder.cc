// diptych: the folder that a run writes to
// SPDX-License-Identifier: LGPL-2.1-or-later
#include "coupling/store/result_folder.h"

#include <algorithm>
#include <filesystem>
#include <iostream>
#include <stdexcept>

#include "coupling/processes/stop_signal.h"
#include "coupling/scene/scene_file.h"
#include "coupling/store/file_names.h"
#include "coupling/store/provenance.h"
#include "discrete/files/out_of_memory.h"
#include "discrete/files/text_file.h"

namespace diptych::coupling
{
  namespace
  {
    namespace fs = std::filesystem;

    const std::vector<std::string> comparison_files = {"comparison.json", "comparison.csv", "comparison.h5",
                                                       "fields.vtu",      "grid.vtu",       "report.html"};

    // Absolute, without a slash at its end.
    fs::path plain_path(const std::string &directory)
    {
      const fs::path path = fs::absolute(directory).lexically_normal();
      return path.has_filename() ? path : path.parent_path();
    }

    bool lies_in(const std::string &file, const fs::path &directory)
    {
      const fs::path inside = fs::weakly_canonical(file).lexically_relative(fs::weakly_canonical(directory));
      return !inside.empty() && *inside.begin() != "..";
    }

    SceneHashes hashes_of(const Scene &scene)
    {
      const auto hash = [](const Identity &identity) { return hexadecimal(digest_of(text_of(identity))); };
      return {hash(sample_identity(scene)), hash(continuum_identity(scene)), hash(member_identity(scene))};
    }

    // The first key whose value differs between the scene and scene.prm; where none does, one of the scene's files has changed.
    std::string reason(const Scene &scene, const std::string &directory, Identity (*identity)(const Scene &))
    {
      const std::optional<Scene> earlier = resolved_scene(scene_prm(directory));
      if (!earlier)
        return "scene.prm is missing, or another version of the program wrote it";
      const std::string difference = first_difference(identity(scene), identity(*earlier));
      return difference.empty() ? "an input file has changed since" : difference;
    }

    // Where the next continuum stands once all its parts are complete.
    std::string whole_next_folder(const std::string &directory)
    {
      return directory + "/next_whole";
    }

    bool has_continuum(const std::string &directory)
    {
      return fs::exists(continuum_h5(directory));
    }
  } // namespace

  bool is_result_folder(const std::string &directory)
  {
    for (const char *name :
         {"provenance.json", "ensemble.prm", "study_input.json", "calibration_input.json", "plan_input", "import.json"})
      if (fs::is_regular_file(fs::path(directory) / name))
        return true;
    return false;
  }

  void require_usable(const std::string &directory, const Opening &opening)
  {
    if (!fs::exists(directory) || is_empty_folder(directory))
      return;
    if (!is_result_folder(directory))
      throw SceneError("the folder '" + directory + "' holds other files and no results. Name a new or an empty folder.");
    if (!opening.resume && !opening.overwrite)
      throw SceneError("the folder '" + directory + "' holds results. Add " +
                       (opening.can_resume ? "--resume to go on from them, " : "") + "--overwrite to rename them to " +
                       plain_path(directory).filename().string() + ".1, or --output with another folder.");
  }

  void set_aside(FolderLock &lock, const InputFiles &inputs)
  {
    const fs::path path = plain_path(lock.folder()), aside = path.string() + ".1";
    for (const auto &[what, file] : inputs)
      if (lies_in(file, path) || lies_in(file, aside))
        throw SceneError("--overwrite: " + what + " '" + file + "' lies in the folder that would be renamed. Name another " +
                         "folder with --output.");
    for (const fs::directory_entry &entry : fs::recursive_directory_iterator(path))
      if (entry.is_directory())
        require_unlocked(entry.path().string());
    if (fs::equivalent(path, fs::current_path()))
      throw SceneError("--overwrite: '" + lock.folder() + "' is the working directory. Start from another one.");
    require_unlocked(aside.string());
    if (fs::exists(aside) && !is_result_folder(aside.string()))
      throw SceneError("--overwrite: '" + aside.string() + "' exists and holds no results. Move it elsewhere.");
    const bool replaces = fs::remove_all(aside) > 0;
    lock.set_aside(aside.string());
    std::cerr << "renamed " << path.string() << " to " << aside.string() << (replaces ? ", in the place of an older one" : "")
              << std::endl;
  }

  SceneChanges ResultFolder::changes_in(const std::string &folder) const
  {
    const SceneHashes now = hashes_of(scene), before = read_run_facts(folder).hashes;
    SceneChanges      changes;
    if (now.sample != before.sample)
      changes.sample = reason(scene, folder, sample_identity);
    if (now.continuum != before.continuum)
      changes.continuum = reason(scene, folder, continuum_identity);
    if (now.comparison != before.comparison)
      changes.comparison = reason(scene, folder, member_identity);
    return changes;
  }

  void ResultFolder::write_scene(const std::string &folder, const std::string &command) const
  {
    record_scene(folder, {scene.name, {scene.sample.seed}, command}, hashes_of(scene));
    discrete::write_text(scene_prm(folder), resolved_text(scene));
  }

  void ResultFolder::record_compared(const std::string &command) const
  {
    SceneHashes hashes = read_run_facts(directory).hashes;
    hashes.comparison  = hashes_of(scene).comparison;
    record_scene(directory, {scene.name, {scene.sample.seed}, command}, hashes);
  }

  SceneChanges ResultFolder::open(FolderLock                                      &lock,
                                  const Opening                                   &opening,
                                  const std::function<void(const SceneChanges &)> &check) const
  {
    const bool is_empty = is_empty_folder(directory);
    Opening    usable   = opening;
    usable.resume       = opening.resume || opening.adds;
    require_usable(directory, usable);
    SceneChanges changes;
    if (!is_empty && !opening.overwrite)
      {
        finish_replacement(directory);
        changes = this->changes();
        if (!changes.sample.empty())
          throw SceneError("the results in '" + directory + "' are of another sample: " + changes.sample +
                           ". Run the same scene, or add --overwrite, or --output with another folder.");
      }
    if (check)
      check(changes);
    if (!is_empty && opening.overwrite)
      {
        InputFiles inputs = opening.inputs;
        for (const auto &input : input_files(scene))
          inputs.push_back(input);
        set_aside(lock, inputs);
      }
    // The scene of a finished continuum or comparison stays beside it until a new one takes its place.
    if (is_empty || opening.overwrite || (!changes.continuum.empty() && !has_continuum(directory)))
      write_scene(directory, opening.command);
    return changes;
  }

  bool ResultFolder::holds_finished_run() const
  {
    if (!fs::exists(directory + "/provenance.json"))
      return false;
    const RunFacts     facts   = read_run_facts(directory);
    const SceneChanges changes = this->changes();
    if (!changes.sample.empty() || !changes.continuum.empty() || !changes.comparison.empty() || !facts.discrete.finished ||
        !facts.continuum.finished || facts.comparison_files.table.empty() ||
        (scene.output.report && !fs::exists(report_html(directory))))
      return false;
    check_files(directory);
    check_files(directory, "comparison");
    return true;
  }

  std::string next_folder(const std::string &directory)
  {
    return directory + "/next";
  }

  bool ResultFolder::open_next_continuum(const std::string &command) const
  {
    const std::string next = next_folder(directory);
    if (fs::exists(next + "/provenance.json") && changes_in(next).continuum.empty())
      return true;
    remove_results(directory, {"next"});
    make_folder(next);
    write_scene(next, command);
    return false;
  }

  void finish_replacement(const std::string &directory)
  {
    const std::string next = whole_next_folder(directory);
    if (!fs::exists(next))
      return;
    remove_results(directory, comparison_files);
    for (const char *name :
         {"continuum.csv", "continuum.h5", "continuum.xdmf", "continuum.pvd", "continuum", "coarse", "sample.msh", "scene.prm"})
      if (fs::exists(next + "/" + name))
        {
          remove_results(directory, {name});
          fs::rename(next + "/" + name, directory + "/" + name);
        }
    remove_results(directory, {"continuum_checkpoint.h5"});
    if (read_run_facts(next).continuum_coarse.cells == 0)
      remove_results(directory, {"coarse"});
    take_continuum_facts(directory, next);
    fs::remove_all(next);
  }

  void replace_continuum(const std::string &directory)
  {
    fs::rename(next_folder(directory), whole_next_folder(directory));
    finish_replacement(directory);
  }

  std::string next_comparison(const std::string &directory)
  {
    return directory + "/next_comparison";
  }

  void take_next_comparison(const std::string &directory)
  {
    const std::string next = next_comparison(directory);
    forget_files(directory, "comparison");
    remove_results(directory, {"report.html"}); // shows the earlier comparison, and may not be drawn again
    for (const fs::directory_entry &entry : fs::directory_iterator(next))
      fs::rename(entry.path(), directory + "/" + entry.path().filename().string());
    remove_results(directory, {"next_comparison"});
  }

  void remove_results(const std::string &directory, const std::vector<std::string> &names)
  {
    for (const std::string &name : names)
      {
        std::error_code error;
        fs::remove_all(directory + "/" + name, error);
        if (error)
          throw std::runtime_error(directory + "/" + name + " cannot be removed: " + error.message());
      }
  }

  std::string kept_in(const std::string &directory)
  {
    std::vector<std::string> names;
    std::error_code          unreadable;
    for (const fs::directory_entry &entry : fs::directory_iterator(directory, unreadable))
      if (const std::string name = entry.path().filename().string(); name.front() != '.' && entry.path().extension() != ".part")
        names.push_back(name);
    std::sort(names.begin(), names.end());
    std::string list;
    for (const std::string &name : names)
      list += (list.empty() ? "" : ", ") + name;
    return list.empty() ? "nothing was kept" : "kept in " + directory + ": " + list;
  }

  int keeping(const std::string &directory, const std::function<int()> &work)
  {
    try
      {
        return work();
      }
    catch (const StoppedOnRequest &stopped)
      {
        throw StoppedOnRequest(std::string(stopped.what()) + "; " + kept_in(directory));
      }
    catch (const std::exception &error)
      {
        if (!discrete::is_out_of_memory(error) && dynamic_cast<const std::logic_error *>(&error) != nullptr)
          throw;
        throw std::runtime_error(discrete::text_of(error) + "; " + kept_in(directory));
      }
  }

  int writing(const std::string &directory, const std::function<int(FolderLock &)> &work)
  {
    FolderLock lock(directory);
    return keeping(directory, [&] { return work(lock); });
  }
} // namespace diptych::coupling
