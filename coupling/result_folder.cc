// diptych: the folder that a run writes to
// SPDX-License-Identifier: LGPL-2.1-or-later
#include "coupling/result_folder.h"

#include <filesystem>
#include <fstream>
#include <iostream>
#include <sstream>

#include <sys/wait.h>
#include <unistd.h>

#include "coupling/version.h"
#include "discrete/text_file.h"

namespace diptych::coupling
{
  namespace
  {
    const std::vector<std::string> panel_files = {"discrete.h5",
                                                  "discrete.xdmf",
                                                  "discrete.csv",
                                                  "continuum.h5",
                                                  "continuum.xdmf",
                                                  "continuum.csv",
                                                  "continuum.pvd",
                                                  "continuum",
                                                  "provenance.json",
                                                  "coarse",
                                                  "checkpoint.h5",
                                                  "study_step.csv",
                                                  "study_step.json",
                                                  "study_step.png",
                                                  "step_1",
                                                  "step_2",
                                                  "step_4",
                                                  "sample.msh",
                                                  "continuum_checkpoint.h5",
                                                  "material_point.csv"};
  }

  const std::vector<std::string> comparison_files = {"comparison.json", "comparison.csv", "comparison.h5",
                                                     "fields.vtu",      "grid.vtu",       "report.html"};

  void remove_results(const std::string &directory, const std::vector<std::string> &names)
  {
    for (const std::string &name : names)
      std::filesystem::remove_all(directory + "/" + name);
  }

  std::string sample_part(const std::string &echoed)
  {
    const std::size_t begin = echoed.find("subsection sample"), end = echoed.find("subsection continuum");
    return begin == std::string::npos || end == std::string::npos ? "" : echoed.substr(begin, end - begin);
  }

  // Comments change with the wording, and the time between checkpoints changes no result.
  std::string continuum_part(const std::string &echoed)
  {
    std::istringstream in(echoed);
    std::string        section, part;
    for (std::string line; std::getline(in, line);)
      {
        if (line.rfind("subsection ", 0) == 0)
          section = line;
        const bool is_key = line.rfind("  set ", 0) == 0, is_coarse = line.find("coarse_element_size") != std::string::npos;
        if (is_key && (is_coarse || (section == "subsection continuum" && line.find("checkpoint_minutes") == std::string::npos)))
          part += line + '\n';
      }
    return part;
  }

  std::string earlier_echo(const std::string &directory)
  {
    std::ifstream      file(directory + "/scene.prm");
    std::ostringstream text;
    text << file.rdbuf();
    return text.str();
  }

  void open_result_folder(const Scene &scene, const bool resume)
  {
    const std::string &directory = scene.output.directory;
    std::error_code    error;
    std::filesystem::create_directories(directory, error);
    if (error || access(directory.c_str(), W_OK) != 0)
      throw SceneError("output/directory = '" + directory + "' cannot be made or written to");
    const std::string earlier = earlier_echo(directory);
    // A run replaces files and folders by name: only where an earlier one of its own stands may it do so.
    const bool is_result_folder = earlier.find(echo_title) != std::string::npos;
    if (!is_result_folder && !std::filesystem::is_empty(directory))
      throw SceneError("output/directory = '" + directory +
                       "' holds other files and no result of diptych; name a new or an empty folder");
    const bool another = is_result_folder && sample_part(earlier) != sample_part(echo(scene));
    if (resume && another)
      throw SceneError("--resume: the sections sample, loading and discrete of the scene are not those of " + directory +
                       "/scene.prm, which was interrupted; resume with the same scene or start without --resume");
    // Results of another sample must not be compared with what this run will make.
    if (another)
      remove_results(directory, panel_files);
    discrete::write_text(directory + "/scene.prm", echo(scene));
  }

  Scene scene_of(const CommandLine &line)
  {
    Scene scene = read_scene(line.target, line.overrides, line.command == "run");
    if (!line.output.empty())
      scene.output.directory = line.output;
    scene.discrete.threads = line.threads;
    return scene;
  }

  void say(const CommandLine &line, const std::string &text)
  {
    if (!line.quiet)
      std::cout << text << std::endl;
  }

  std::string reached(const double strain)
  {
    std::ostringstream out;
    out.precision(4);
    out << 100 * strain << " % axial strain";
    return out.str();
  }

  std::string reached(const LoadingOptions &loading, const double progress)
  {
    if (loading.mode == "descent")
      return reached(progress);
    std::ostringstream out;
    out.precision(4);
    if (loading.mode == "time")
      out << "time " << progress;
    else
      out << 100 * progress << " % shear strain";
    return out.str();
  }

  void run_script(const std::string &script, const std::vector<std::string> &arguments)
  {
    const std::string   path  = std::string(report_folder) + "/" + script;
    std::vector<char *> words = {const_cast<char *>(python), const_cast<char *>(path.c_str())};
    std::string         text  = std::string(python) + " " + path;
    for (const std::string &argument : arguments)
      words.push_back(const_cast<char *>(argument.c_str())), text += " " + argument;
    words.push_back(nullptr);
    const pid_t child = fork();
    if (child == 0)
      {
        execv(python, words.data());
        _exit(127);
      }
    int status = 0;
    if (child < 0 || waitpid(child, &status, 0) < 0 || !WIFEXITED(status) || WEXITSTATUS(status) != 0)
      throw std::runtime_error("a picture could not be drawn: " + text);
  }
} // namespace diptych::coupling
