// diptych: the scene and the result folder that a command line names
// SPDX-License-Identifier: LGPL-2.1-or-later
#include <filesystem>
#include <stdexcept>
#include <utility>

#include "coupling/program/command_line.h"
#include "coupling/scene/scene_file.h"

namespace diptych::coupling
{
  Opening opening_of(const CommandLine &line, const bool adds)
  {
    Opening opening;
    opening.resume    = line.resume;
    opening.overwrite = line.overwrite;
    opening.adds      = adds;
    opening.command   = line.text;
    if (std::error_code none; std::filesystem::is_regular_file(line.target, none))
      opening.inputs.emplace_back("the scene", line.target);
    for (const std::string &file : line.set_files)
      opening.inputs.emplace_back("--set-file", file);
    return opening;
  }

  std::string name_of(const Command command)
  {
    constexpr std::pair<Command, const char *> names[] = {{Command::run, "run"},
                                                          {Command::discrete, "discrete"},
                                                          {Command::continuum, "continuum"},
                                                          {Command::material_point, "material-point"},
                                                          {Command::check_law, "check-law"},
                                                          {Command::solve, "solve"},
                                                          {Command::compare, "compare"},
                                                          {Command::new_scene, "new"},
                                                          {Command::explain, "explain"},
                                                          {Command::completion, "completion"}};
    for (const auto &[known, name] : names)
      if (known == command)
        return name;
    throw std::logic_error("a command without a name");
  }

  void take_set_files(CommandLine &line)
  {
    std::vector<std::string> overrides;
    for (const std::string &file : line.set_files)
      {
        if (std::error_code none; !std::filesystem::is_regular_file(file, none))
          throw SceneError("--set-file " + file + ": there is no such file");
        for (const Entry &entry : read_fragment(file))
          overrides.push_back(entry.section + "/" + entry.key + "=" + entry.value);
      }
    line.overrides.insert(line.overrides.begin(), overrides.begin(), overrides.end());
  }

  Scene scene_of(const CommandLine &line)
  {
    return with_options(line, read_scene(line.target, line.overrides, line.command == Command::run));
  }

  Scene with_options(const CommandLine &line, Scene scene)
  {
    if (!line.output.empty())
      scene.output.directory = line.output;
    scene.discrete.threads = line.threads;
    for (const std::string &warning : line.prints_warnings ? scene.warnings : std::vector<std::string>())
      warn(warning);
    return scene;
  }
} // namespace diptych::coupling
