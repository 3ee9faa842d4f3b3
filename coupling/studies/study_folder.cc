// diptych: the folder of a study: what is in it, what of it may stay
// SPDX-License-Identifier: LGPL-2.1-or-later
#include "coupling/studies/study_folder.h"

#include <filesystem>
#include <fstream>

#include <nlohmann/json.hpp>

#include "coupling/folders/provenance.h"
#include "coupling/folders/result_folder.h"
#include "coupling/scene/scene_file.h"
#include "coupling/version.h"
#include "discrete/files/text_file.h"

namespace diptych::coupling
{
  namespace
  {
    using nlohmann::json;
    namespace fs = std::filesystem;

    constexpr int last_exit_code_of_a_result = 3; // beyond it the system failed, or a signal came

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

  void open_runs_folder(const std::string &directory, const RunsFolder &kind, const std::string &file, const bool resume)
  {
    make_folder(directory);
    if (!fs::exists(directory + "/" + kind.input) && !is_empty_folder(directory))
      throw SceneError("--output " + directory + ": holds other files and no " + kind.noun +
                       " of diptych; name a new or an empty folder");
    // Killed before its end, this one must not leave the tables of an earlier one.
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

  std::optional<RunEnd> found_end(const std::string &directory, const StudyRun &run)
  {
    const json end = json::parse(discrete::read_text(path_of(directory, run, ".json")), nullptr, /* exceptions */ false);
    RunEnd     result;
    try
      {
        check_files(run_folder(directory, run)), check_files(run_folder(directory, run), "comparison");
        if (!doubt_about_files(run_folder(directory, run)).empty()) // its record was removed
          return std::nullopt;
        result = {end.at("exit_code"), end.at("revision"), end.at("load").is_number() ? double(end["load"]) : NAN,
                  end.value("at_once", 1)};
      }
    catch (const std::exception &) // damaged, or of another version: it is run again
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
      fs::remove_all(run_folder(directory, run));
    fs::remove(run_log(directory, run));
    discrete::write_text(run_scene(directory, run), echo(*run.scene));
    discrete::write_text(end_file, json{{"begun", git_revision}}.dump() + "\n");
    return fs::exists(run_folder(directory, run));
  }
} // namespace diptych::coupling
