// diptych: the folder that a run writes to
// SPDX-License-Identifier: LGPL-2.1-or-later
#include "coupling/folders/result_folder.h"

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <filesystem>
#include <stdexcept>

#include <unistd.h>

#include "coupling/folders/provenance.h"
#include "coupling/folders/written_echo.h"
#include "coupling/processes/stop_signal.h"
#include "coupling/scene/identity.h"
#include "coupling/scene/scene_file.h"
#include "discrete/files/out_of_memory.h"
#include "discrete/files/text_file.h"

namespace diptych::coupling
{
  namespace
  {
    namespace fs = std::filesystem;

    const std::vector<std::string> panel_files = {
      "discrete.h5",    "discrete.xdmf",           "discrete.csv",       "discrete",        "continuum.h5", "continuum.xdmf",
      "continuum.csv",  "continuum.pvd",           "continuum",          "provenance.json", "coarse",       "checkpoint.h5",
      "study_step.csv", "study_step.json",         "study_step.png",     "step_1",          "step_2",       "step_4",
      "sample.msh",     "continuum_checkpoint.h5", "material_point.csv", "import.json"};
  } // namespace

  const std::vector<std::string> comparison_files = {"comparison.json", "comparison.csv", "comparison.h5",
                                                     "fields.vtu",      "grid.vtu",       "report.html"};

  void remove_results(const std::string &directory, const std::vector<std::string> &names)
  {
    for (const std::string &name : names)
      {
        std::error_code error;
        fs::remove_all(directory + "/" + name, error);
        if (error)
          throw std::runtime_error(directory + "/" + name + ": cannot be removed: " + error.message());
      }
  }

  void remove_panels(const std::string &directory)
  {
    remove_results(directory, panel_files);
    std::vector<std::string> problems;
    std::error_code          none;
    for (const fs::directory_entry &entry : fs::directory_iterator(directory, none))
      if (const std::string name = entry.path().filename().string();
          name.rfind("problem_", 0) == 0 && entry.is_regular_file(none))
        problems.push_back(name);
    remove_results(directory, problems);
  }

  std::string name_inside(const std::string &file, const std::string &directory)
  {
    const auto as_named = [](const std::string &path) { return fs::absolute(path).lexically_normal(); };
    for (const fs::path &inside : {fs::weakly_canonical(file).lexically_relative(fs::weakly_canonical(directory)),
                                   as_named(file).lexically_relative(as_named(directory + "/."))})
      if (!inside.empty() && *inside.begin() != "..")
        return inside.begin()->string();
    return "";
  }

  void demand_own(const std::string &folder, const std::function<bool(const std::string &)> &is_own)
  {
    std::error_code error;
    for (const fs::directory_entry &entry : fs::directory_iterator(folder, error))
      if (std::string name = entry.path().filename().string(); !is_own(name) && name.rfind(".nfs", 0) != 0)
        throw SceneError("output/directory: " + entry.path().string() +
                         " is no file of a run, and would be removed with the folder that it is in; move it elsewhere");
    if (error && error != std::errc::no_such_file_or_directory && error != std::errc::not_a_directory)
      throw std::runtime_error(folder + ": cannot be looked into: " + error.message() + "; nothing was written");
    if (!error && access(folder.c_str(), W_OK | X_OK) != 0)
      throw std::runtime_error(folder + ": what is in it cannot be removed: " + std::strerror(errno) + "; nothing was written");
  }

  namespace
  {
    bool is_among(const std::string &name, const std::vector<std::string> &names)
    {
      return std::find(names.begin(), names.end(), name) != names.end();
    }

    bool is_result(const std::string &name)
    {
      return is_among(name.substr(0, name.rfind(".part")), panel_files);
    }

    // Whether a run into the folder removes or writes the file: by its own name, whatever leads there.
    bool is_replaced(const std::string &file, const std::string &directory)
    {
      const std::string name = name_inside(file, directory);
      return is_among(name, panel_files) || is_among(name, comparison_files) || name == "scene.prm" ||
             name.rfind("problem_", 0) == 0;
    }
  } // namespace

  void demand_own_folders(const std::string &directory)
  {
    const auto is_stage = [](const std::string &name) { return name.rfind("stage_", 0) == 0; };
    for (const char *name : {"/discrete", "/continuum", "/coarse/continuum"})
      demand_own(directory + name, is_stage);
    demand_own(directory + "/coarse", is_result);
    for (const char *name : {"/step_1", "/step_2", "/step_4"})
      if (fs::is_directory(directory + name))
        demand_own_run(directory + name);
  }

  void demand_own_run(const std::string &directory)
  {
    demand_own(directory, [](const std::string &name) {
      const std::string whole = name.substr(0, name.rfind(".part"));
      return is_result(name) || is_among(whole, comparison_files) || whole == "scene.prm" || name == folder_lock_name ||
             whole.rfind("problem_", 0) == 0;
    });
    demand_own_folders(directory);
  }

  namespace
  {
    // What an earlier run of the folder was of, as far as this one's is something else.
    struct EarlierScene
    {
      std::string sample, continuum, comparison; // the first difference; empty: none
    };

    EarlierScene earlier_scene(const Scene &scene, const std::string &echo_file)
    {
      const std::optional<Scene> earlier = echoed_scene(echo_file);
      if (!earlier)
        return {"it was written by another version", "", ""};
      EarlierScene difference{first_difference(sample_identity(scene), sample_identity(*earlier)),
                              first_difference(continuum_identity(scene), continuum_identity(*earlier)),
                              first_difference(member_identity(scene), member_identity(*earlier))};
      // Both name the same files, which are compared as they now are.
      for (const char *section : {"sample/", "loading/", "discrete/"})
        if (difference.sample.empty())
          difference.sample = changed_input(scene, echo_file, section);
      if (difference.continuum.empty())
        difference.continuum = changed_input(scene, echo_file, "continuum/");
      return difference;
    }

    // What stands there is of the scene that its echo told, which nobody knows any more.
    void demand_own_echo(const std::string &directory)
    {
      try
        {
          check_files(directory, "echo");
        }
      catch (const std::invalid_argument &error)
        {
          throw SceneError(std::string(error.what()) + "; name another --output, or put back what stood there");
        }
    }

    void demand_resumable(const std::string &directory, const EarlierScene &difference)
    {
      if (!difference.sample.empty())
        throw SceneError("--resume: the scene is not that of " + directory + "/scene.prm, which was interrupted: " +
                         difference.sample + "; resume with the same scene or start without --resume");
      for (const std::string &folder : {directory, directory + "/coarse"})
        if (const std::string file = folder + "/continuum_checkpoint.h5"; !difference.continuum.empty() && fs::exists(file))
          throw SceneError("--resume: " + file + " belongs to another scene: " + difference.continuum +
                           "; resume with the same scene or start without --resume");
    }

    // The echo of another scene would say of what is left that it was computed with that.
    void remove_results_of_another_scene(const std::string &directory, const EarlierScene &difference)
    {
      if (!difference.sample.empty())
        remove_panels(directory);
      else if (!difference.continuum.empty())
        {
          for (const char *part : {"continuum", "continuum_coarse"})
            forget_fact(directory, part);
          remove_results(directory, {"continuum.h5", "continuum.xdmf", "continuum.csv", "continuum.pvd", "continuum", "coarse",
                                     "sample.msh", "continuum_checkpoint.h5", "material_point.csv"});
        }
      if (!difference.sample.empty() || !difference.continuum.empty() || !difference.comparison.empty())
        remove_results(directory, comparison_files), forget_files(directory, "comparison");
    }
  } // namespace

  void open_result_folder(const Scene &scene, const bool resume, const std::function<void()> &check)
  {
    const std::string &directory = scene.output.directory;
    for (const auto &[key, file] : input_files(scene))
      if (is_replaced(file, directory))
        throw SceneError("output/directory = '" + directory + "': " + key + " = '" + file +
                         "' is one of the files that this run replaces there; name another folder");
    make_folder(directory);
    // A run replaces files and folders by name: only where an earlier one of its own stands may it do so.
    const std::string echo_file        = directory + "/scene.prm";
    const bool        is_result_folder = is_echo(echo_file);
    if (!is_result_folder && !is_empty_folder(directory))
      throw SceneError("output/directory = '" + directory +
                       "' holds other files and no result of diptych; name a new or an empty folder");
    EarlierScene difference;
    if (is_result_folder)
      demand_own_echo(directory), demand_own_folders(directory), difference = earlier_scene(scene, echo_file);
    if (resume)
      demand_resumable(directory, difference);
    if (difference.sample.empty())
      (void)recorded_scene(directory); // throws where this run could not add to what stands there
    if (check)
      check();
    remove_results_of_another_scene(directory, difference);
    write_echo(echo_file, scene);
  }

  std::string kept_in(const std::string &directory)
  {
    std::vector<std::string> names = {"scene.prm"};
    names.insert(names.end(), panel_files.begin(), panel_files.end());
    names.insert(names.end(), comparison_files.begin(), comparison_files.end());
    for (const char *name : {"ensemble.json", "ensemble.csv", "ensemble.h5", "study.json", "study.csv", "study.h5",
                             "calibration.json", "calibration.csv", "calibrated.prm", "plan.json", "planned.prm", "runs"})
      names.emplace_back(name);
    std::string     list;
    std::error_code unreadable;
    for (const std::string &name : names)
      if (fs::exists(directory + "/" + name, unreadable))
        list += (list.empty() ? "" : ", ") + name;
    for (const fs::directory_entry &entry : fs::directory_iterator(directory, unreadable))
      if (entry.is_directory(unreadable) && entry.path().filename().string().rfind("seed_", 0) == 0)
        list += (list.empty() ? "" : ", ") + entry.path().filename().string();
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
    catch (const FolderGone &)
      {
        throw; // what is in its place is not this run's
      }
    catch (const std::exception &error)
      {
        if (!discrete::is_out_of_memory(error) && dynamic_cast<const std::logic_error *>(&error) != nullptr)
          throw;
        const std::string what = discrete::text_of(error);
        throw std::runtime_error(what + (what.find("nothing was written") == std::string::npos ? "; " + kept_in(directory) : ""));
      }
  }

  int writing(const std::string &directory, const std::function<int()> &work)
  {
    const FolderLock lock(directory);
    return keeping(directory, work);
  }
} // namespace diptych::coupling
