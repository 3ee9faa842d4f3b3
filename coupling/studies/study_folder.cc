// diptych: the folder of a study, its runs and what may be kept of them
// SPDX-License-Identifier: LGPL-2.1-or-later
#include "coupling/studies/study_folder.h"

#include <algorithm>
#include <filesystem>
#include <fstream>

#include <nlohmann/json.hpp>

#include "coupling/folders/provenance.h"
#include "coupling/folders/result_folder.h"
#include "coupling/scene/scene_file.h"
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

  namespace
  {
    constexpr std::size_t digits_of_a_name = 16;

    // NAME is a folder; NAME.prm, NAME.log and NAME.json are files.
    bool is_of_a_run(const fs::path &path)
    {
      const std::string file = path.filename().string(), name = file.substr(0, file.find('.'));
      const std::string whole  = file.substr(0, file.rfind(".part"));
      const std::string ending = whole.substr(std::min(name.size(), whole.size()));
      std::error_code   none;
      return name.size() == digits_of_a_name && name.find_first_not_of("0123456789abcdef") == std::string::npos &&
             (ending.empty() ? fs::is_directory(path, none)
                             : (ending == ".prm" || ending == ".log" || ending == ".json") && fs::is_regular_file(path, none));
    }

    bool is_table(const RunsFolder &kind, const std::string &name)
    {
      return std::find(kind.tables.begin(), kind.tables.end(), name) != kind.tables.end();
    }

    void demand_own_runs(const std::string &directory, const RunsFolder &kind)
    {
      const std::string runs = directory + "/runs";
      demand_own(runs, [&](const std::string &name) { return is_of_a_run(runs + "/" + name); });
      std::error_code none;
      for (const fs::directory_entry &entry : fs::directory_iterator(runs, none))
        if (entry.is_directory(none))
          demand_own_run(entry.path().string()), demand_not_written_to(entry.path().string());
      if (is_table(kind, "meshes"))
        demand_own(directory + "/meshes", [](const std::string &name) {
          return name.rfind("path_", 0) == 0 && fs::path(name.substr(0, name.rfind(".part"))).extension() == ".msh";
        });
    }
  } // namespace

  void refuse_inputs_inside(const std::string &directory, const RunsFolder &kind, const InputFiles &inputs)
  {
    for (const auto &[what, file] : inputs)
      if (const std::string name = name_inside(file, directory); name == "runs" || is_table(kind, name))
        throw SceneError("--output " + directory + ": " + what + " '" + file + "' is among what this " + kind.noun +
                         " replaces there; name another folder");
  }

  void open_runs_folder(const std::string &directory, const RunsFolder &kind, const std::string &file, const bool resume)
  {
    make_folder(directory);
    if (!fs::exists(directory + "/" + kind.input) && !is_empty_folder(directory))
      throw SceneError("--output " + directory + ": holds other files but no " + kind.noun +
                       " of diptych; name a new or an empty folder");
    demand_own_runs(directory, kind);
    // If this run is killed, the tables of an earlier one must not stay.
    remove_results(directory, kind.tables);
    if (!resume)
      remove_results(directory, {"runs"});
    discrete::write_text(directory + "/" + kind.input, discrete::read_text(file));
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
      const std::string file = run_folder(directory, run) + "/scene.prm";
      if (std::error_code none; !fs::exists(file, none)) // refused before it wrote a scene
        return !end.is_object() || end.value("exit_code", json()) == exit_code_of_a_refusal;
      const std::optional<Scene> found = echoed_scene(file), asked = echoed_scene(run_scene(directory, run));
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
        check_files(run_folder(directory, run)), check_files(run_folder(directory, run), "comparison");
        if (!doubt_about_files(run_folder(directory, run)).empty()) // its record was removed
          return std::nullopt;
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
    discrete::write_text(run_scene(directory, run), echo(*run.scene));
    discrete::write_text(end_file, json{{"begun", git_revision}}.dump() + "\n");
    return fs::exists(run_folder(directory, run));
  }

  void prepare_run_anew(const std::string &directory, const StudyRun &run)
  {
    remove_results(directory + "/runs", {run.name + ".json"}); // as if it had never started
    (void)prepare_run(directory, run);
  }
} // namespace diptych::coupling
