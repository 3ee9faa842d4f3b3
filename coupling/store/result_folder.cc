// diptych: the folder that a run writes to
// SPDX-License-Identifier: LGPL-2.1-or-later
#include "coupling/store/result_folder.h"

#include <algorithm>
#include <filesystem>
#include <iostream>
#include <stdexcept>

#include "coupling/processes/stop_signal.h"
#include "coupling/scene/identity.h"
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
                                                       "fields.pvd",      "fields",         "summary.csv"};

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
      const auto  hash = [](const Identity &identity) { return hexadecimal(digest_of(text_of(identity))); };
      SceneHashes hashes;
      hashes.sample     = hash(sample_identity(scene));
      hashes.continuum  = hash(continuum_identity(scene));
      hashes.comparison = hash(member_identity(scene));
      if (scene.continuum.law == continuum::LawKind::library)
        hashes.law_library = hash({{"law_library", continuum_identity(scene).at("continuum/law_library")}});
      return hashes;
    }

    // The first key whose value differs between the scene and scene.prm. If all agree, one of the scene's files has changed.
    std::string reason(const Scene &scene, const std::string &directory, Identity (*identity)(const Scene &))
    {
      const std::optional<Scene> earlier = resolved_scene(scene_prm(directory));
      if (!earlier)
        return "scene.prm is missing, or another version of the program wrote it";
      const std::string difference = first_difference(identity(scene), identity(*earlier));
      return difference.empty() ? "an input file has changed since" : difference;
    }

    // Name of a next folder once it is complete, and once all is moved from it.
    std::string complete_folder(const std::string &directory)
    {
      return directory + "/next_complete";
    }

    std::string moved_folder(const std::string &directory)
    {
      return directory + "/next_moved";
    }

    bool has_continuum(const std::string &directory)
    {
      return fs::exists(continuum_h5(directory));
    }
  } // namespace

  bool is_ensemble_folder(const std::string &directory)
  {
    return fs::exists(directory + "/ensemble.prm");
  }

  bool is_study_folder(const std::string &directory)
  {
    return fs::exists(directory + "/study_input.json");
  }

  bool is_calibration_folder(const std::string &directory)
  {
    return fs::exists(directory + "/calibration_input.json");
  }

  bool is_result_folder(const std::string &directory)
  {
    for (const char *name : {"provenance.json", "ensemble.prm", "study_input.json", "calibration_input.json", "plan_input.prm",
                             "plan_input.json", "element_input.prm", "element_input.json", "import.json"})
      if (fs::is_regular_file(fs::path(directory) / name))
        return true;
    return false;
  }

  void require_usable(const std::string &directory, const Opening &opening)
  {
    if (!fs::exists(directory) || is_empty_folder(directory))
      return;
    if (!is_result_folder(directory))
      throw SceneError("the folder '" + directory + "' holds other files and no results (no provenance.json). Name a new or an " +
                       "empty folder.");
    if (!opening.resume && !opening.overwrite)
      throw SceneError("the folder '" + directory + "' holds results. Add " +
                       (opening.can_resume ? "--resume to continue them, " : "") + "--overwrite to rename them to " +
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
      changes.sample = before.sample.empty() ? "its provenance.json records no run" : reason(scene, folder, sample_identity);
    if (now.continuum != before.continuum)
      changes.continuum = reason(scene, folder, continuum_identity);
    if (now.comparison != before.comparison)
      changes.comparison = reason(scene, folder, member_identity);
    return changes;
  }

  void ResultFolder::write_scene(const std::string &folder, const std::string &command, SceneHashes hashes) const
  {
    const std::string text = resolved_text(scene);
    hashes.text            = hexadecimal(digest_of(text));
    record_scene(folder, {scene.name, {scene.sample.seed}, command}, hashes);
    discrete::write_text(scene_prm(folder), text);
  }

  SceneChanges ResultFolder::open(FolderLock                                      &lock,
                                  const Opening                                   &opening,
                                  const std::function<void(const SceneChanges &)> &check) const
  {
    const bool is_empty      = is_empty_folder(directory);
    Opening    usable        = opening;
    usable.resume            = opening.resume || opening.adds;
    const bool keeps_results = !is_empty && !opening.overwrite && is_result_folder(directory);
    // require_usable() advises --resume, which another sample does not allow.
    const SceneChanges before = keeps_results ? this->changes() : SceneChanges();
    if (keeps_results && read_run_facts(directory).hashes.sample.empty())
      throw SceneError("'" + directory + "' holds results, but not of a single run. Use --output with another folder, or " +
                       "--overwrite.");
    if (!before.sample.empty())
      throw SceneError("'" + directory + "' holds results of another sample. Different is " + before.sample +
                       ". Use --output with another folder, or --overwrite.");
    if (!usable.resume && !before.continuum.empty())
      throw SceneError("'" + directory + "' holds results with another continuum. Different is " + before.continuum +
                       ". Add --resume to replace the continuum, --overwrite, or --output with another folder.");
    require_usable(directory, usable);
    SceneChanges changes;
    if (keeps_results)
      {
        finish_move(directory);
        changes = this->changes();
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
    // scene.prm describes a finished continuum or comparison until a new one replaces it.
    if (is_empty || opening.overwrite || (!changes.continuum.empty() && !has_continuum(directory)))
      write_scene(directory, opening.command, hashes_of(scene));
    return changes;
  }

  bool ResultFolder::holds_finished_grains() const
  {
    if (!fs::exists(directory + "/provenance.json") || !changes().sample.empty() || !read_run_facts(directory).discrete.finished)
      return false;
    check_files(directory, "discrete");
    return true;
  }

  bool ResultFolder::holds_finished_run() const
  {
    if (!holds_finished_grains())
      return false;
    const RunFacts     facts   = read_run_facts(directory);
    const SceneChanges changes = this->changes();
    if (!changes.continuum.empty() || !changes.comparison.empty() || !facts.continuum.finished ||
        facts.comparison_files.table.empty() || (scene.output.report && !fs::exists(report_html(directory))))
      return false;
    check_files(directory);
    check_files(directory, "comparison");
    return true;
  }

  std::string next_continuum(const std::string &directory)
  {
    return directory + "/next";
  }

  std::string next_comparison(const std::string &directory)
  {
    return directory + "/next_comparison";
  }

  bool ResultFolder::open_next_continuum(const std::string &command) const
  {
    const std::string next = next_continuum(directory);
    if (fs::exists(next + "/provenance.json") && changes_in(next).continuum.empty())
      return true;
    remove_results(directory, {"next"});
    make_folder(next);
    write_scene(next, command, hashes_of(scene));
    return false;
  }

  void ResultFolder::open_next_comparison(const std::string &command) const
  {
    remove_results(directory, {"next_comparison"});
    make_folder(next_comparison(directory));
    SceneHashes hashes = read_run_facts(directory).hashes; // those of the computed panels stay
    hashes.comparison  = hashes_of(scene).comparison;
    write_scene(next_comparison(directory), command, hashes);
  }

  void take(const std::string &directory, const std::string &next)
  {
    remove_results(directory, {"next_moved"});
    fs::rename(next, complete_folder(directory));
    finish_move(directory);
  }

  void finish_move(const std::string &directory)
  {
    const std::string next = complete_folder(directory);
    if (!fs::exists(next))
      return;
    const RunFacts facts = read_run_facts(next);
    if (facts.comparison_files.table.empty())
      remove_results(directory, comparison_files);
    if (!has_report(facts))
      remove_results(directory, {"report.html"});
    remove_results(directory, {"movie.gif"}); // of the earlier panels; `report --movie` draws it
    if (facts.continuum_coarse.n_cells == 0)
      remove_results(directory, {"coarse"});
    if (facts.continuum.finished)
      remove_results(directory, {"continuum_checkpoint.h5"});
    for (const fs::directory_entry &entry :
         std::vector<fs::directory_entry>(fs::directory_iterator(next), fs::directory_iterator()))
      if (const std::string name = entry.path().filename().string(); name != "provenance.json")
        {
          remove_results(directory, {name});
          fs::rename(entry.path(), directory + "/" + name);
        }
    copy_record(next, directory);
    fs::rename(next, moved_folder(directory)); // until then, a killed process does all of this again
    remove_results(directory, {"next_moved"});
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
