// diptych: the folder that a run writes to
// SPDX-License-Identifier: LGPL-2.1-or-later
#include "coupling/folders/result_folder.h"

#include <cerrno>
#include <cstring>
#include <filesystem>
#include <stdexcept>

#include <unistd.h>

#include "coupling/scene/identity.h"
#include "coupling/scene/scene_file.h"
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
      fs::remove_all(directory + "/" + name);
  }

  void make_folder(const std::string &directory)
  {
    std::error_code error;
    fs::create_directories(directory, error);
    if (error)
      throw std::runtime_error("the folder '" + directory + "' cannot be made: " + error.message());
    if (access(directory.c_str(), W_OK) != 0)
      throw std::runtime_error("the folder '" + directory + "' cannot be written to: " + std::strerror(errno));
  }

  void open_result_folder(const Scene &scene, const bool resume)
  {
    const std::string &directory = scene.output.directory;
    if (const std::string &file = scene.discrete.method.file;
        scene.discrete.method.method == discrete::Method::imported && fs::exists(directory) &&
        fs::weakly_canonical(fs::path(file).parent_path()) == fs::weakly_canonical(directory))
      throw SceneError("output/directory = '" + directory + "' is the folder of discrete/file = '" + file +
                       "', whose grains would be lost; name another one");
    make_folder(directory);
    // A run replaces files and folders by name: only where an earlier one of its own stands may it do so.
    const std::string echo_file        = directory + "/scene.prm";
    const bool        is_result_folder = is_echo(echo_file);
    if (!is_result_folder && !fs::is_empty(directory))
      throw SceneError("output/directory = '" + directory +
                       "' holds other files and no result of diptych; name a new or an empty folder");
    std::string difference;
    if (is_result_folder)
      {
        const std::optional<Scene> earlier = echoed_scene(echo_file);
        difference                         = earlier ? first_difference(sample_identity(scene), sample_identity(*earlier))
                                                     : "it was written by another version";
      }
    if (resume && !difference.empty())
      throw SceneError("--resume: the scene is not that of " + echo_file + ", which was interrupted: " + difference +
                       "; resume with the same scene or start without --resume");
    // Results of another sample must not be compared with what this run will make.
    if (!difference.empty())
      remove_results(directory, panel_files);
    discrete::write_text(echo_file, echo(scene));
  }

  std::string kept_in(const std::string &directory)
  {
    std::vector<std::string> names = {"scene.prm"};
    names.insert(names.end(), panel_files.begin(), panel_files.end());
    names.insert(names.end(), comparison_files.begin(), comparison_files.end());
    std::string     list;
    std::error_code unreadable;
    for (const std::string &name : names)
      if (fs::exists(directory + "/" + name, unreadable))
        list += (list.empty() ? "" : ", ") + name;
    return list.empty() ? "nothing was kept" : "kept in " + directory + ": " + list;
  }

  int keeping(const std::string &directory, const std::function<int()> &work)
  {
    try
      {
        return work();
      }
    catch (const std::logic_error &)
      {
        throw;
      }
    catch (const std::exception &error)
      {
        throw std::runtime_error(std::string(error.what()) + "; " + kept_in(directory));
      }
  }
} // namespace diptych::coupling
