// diptych: the folder of a study and of its runs
// SPDX-License-Identifier: LGPL-2.1-or-later
#include "coupling/studies/study_folder.h"

#include <algorithm>
#include <filesystem>
#include <fstream>

#include <nlohmann/json.hpp>

#include "coupling/scene/scene_file.h"
#include "coupling/store/file_names.h"
#include "coupling/store/provenance.h"
#include "coupling/store/result_folder.h"
#include "coupling/studies/run_name.h"
#include "coupling/version.h"
#include "discrete/files/text_file.h"

namespace diptych::coupling
{
  namespace
  {
    using nlohmann::json;
    namespace fs = std::filesystem;

    constexpr int exit_code_of_a_refusal     = 2;
    constexpr int last_exit_code_of_a_result = 3; // higher codes: the system failed, or a signal came

    std::string path_of(const std::string &directory, const StudyRun &run, const std::string &ending)
    {
      return directory + "/runs/" + run.name + ending;
    }

    double load_of_the_machine()
    {
      std::ifstream file("/proc/loadavg");
      double        load = NAN;
      file >> load;
      return load;
    }
  } // namespace

  std::string run_folder(const std::string &directory, const StudyRun &run)
  {
    return path_of(directory, run, "");
  }

  std::string run_scene(const std::string &directory, const StudyRun &run)
  {
    return path_of(directory, run, ".prm");
  }

  std::string run_log(const std::string &directory, const StudyRun &run)
  {
    return path_of(directory, run, ".log");
  }

  bool is_calibration_folder(const std::string &directory)
  {
    return fs::exists(directory + "/" + folder_of_a_calibration.input);
  }

  bool is_study_folder(const std::string &directory)
  {
    return fs::exists(directory + "/" + folder_of_a_study.input);
  }

  void open_runs_folder(FolderLock        &lock,
                        const RunsFolder  &kind,
                        const std::string &file,
                        const Opening     &opening,
                        const InputFiles  &inputs)
  {
    const std::string &directory = lock.folder();
    require_usable(directory, opening);
    const std::string text = discrete::read_text(file);
    if (opening.overwrite && !is_empty_folder(directory))
      set_aside(lock, inputs);
    if (!is_empty_folder(directory) && !fs::exists(directory + "/" + kind.input))
      throw SceneError("the folder '" + directory + "' holds other results and no " + kind.noun + ". Name another folder.");
    discrete::write_text(directory + "/" + kind.input, text);
    make_folder(directory + "/runs");
  }

  void write_end(const std::string &directory, const StudyRun &run, const int exit_code, const int at_once)
  {
    const json end = {
      {"exit_code", exit_code}, {"revision", git_revision}, {"load", load_of_the_machine()}, {"at_once", at_once}};
    discrete::write_text(path_of(directory, run, ".json"), end.dump() + "\n");
  }

  namespace
  {
    // A user may have run another scene in this folder, or copied another run's here. Both resolved scenes name the same files,
    // which may have moved since.
    bool is_of_its_scene(const std::string &directory, const StudyRun &run, const json &end)
    {
      const std::string file = scene_prm(run_folder(directory, run));
      if (std::error_code none; !fs::exists(file, none)) // refused before it wrote
        return !end.is_object() || end.value("exit_code", json()) == exit_code_of_a_refusal;
      const std::optional<Scene> found = resolved_scene(file), asked = resolved_scene(run_scene(directory, run));
      return found && asked && run_name(*found, run.command) == run_name(*asked, run.command);
    }
  } // namespace

  std::optional<RunEnd> found_end(const std::string &directory, const StudyRun &run)
  {
    const json end = json::parse(discrete::read_text(path_of(directory, run, ".json")), nullptr, /* exceptions */ false);
    RunEnd     result;
    if (!is_of_its_scene(directory, run, end))
      return std::nullopt;
    try
      {
        check_files(run_folder(directory, run));
        check_files(run_folder(directory, run), "comparison");
        result = {end.at("exit_code"), end.at("revision"), end.at("load").is_number() ? double(end["load"]) : NAN,
                  end.value("at_once", 1)};
      }
    catch (const std::exception &) // damaged or of another version: run it again
      {
        return std::nullopt;
      }
    if (result.exit_code > last_exit_code_of_a_result || result.revision != git_revision)
      return std::nullopt;
    return result;
  }

  bool prepare_run(const std::string &directory, const StudyRun &run)
  {
    const std::string end_file  = path_of(directory, run, ".json");
    const json        earlier   = json::parse(discrete::read_text(end_file), nullptr, /* exceptions */ false);
    const bool        was_begun = earlier.is_object() && !earlier.contains("exit_code") &&
                           earlier.value("begun", json()) == git_revision;
    if (!was_begun)
      remove_results(directory + "/runs", {run.name});
    remove_results(directory + "/runs", {run.name + ".log"});
    discrete::write_text(run_scene(directory, run), resolved_text(*run.scene));
    discrete::write_text(end_file, json{{"begun", git_revision}}.dump() + "\n");
    return fs::exists(run_folder(directory, run));
  }

  void prepare_run_anew(const std::string &directory, const StudyRun &run)
  {
    remove_results(directory + "/runs", {run.name + ".json"}); // as if it had never started
    (void)prepare_run(directory, run);
  }
} // namespace diptych::coupling
