// diptych: the scene and the result folder that a command line names
// SPDX-License-Identifier: LGPL-2.1-or-later
#include <filesystem>

#include "coupling/program/command_line.h"
#include "coupling/scene/scene_file.h"

namespace diptych::coupling
{
  Opening opening_of(const CommandLine &line, const bool adds)
  {
    Opening opening{line.resume, line.overwrite, adds, line.command != Command::import_sample, line.text, {}};
    if (std::error_code none; std::filesystem::is_regular_file(line.target, none))
      opening.inputs.emplace_back("the scene", line.target);
    for (const std::string &file : line.set_files)
      opening.inputs.emplace_back("--set-file", file);
    return opening;
  }

  Scene scene_of(const CommandLine &line)
  {
    Scene scene = read_scene(line.target, line.overrides, line.command == Command::run);
    if (!line.output.empty())
      scene.output.directory = line.output;
    scene.discrete.threads = line.threads;
    for (const std::string &warning : line.prints_warnings ? scene.warnings : std::vector<std::string>())
      warn(warning);
    return scene;
  }
} // namespace diptych::coupling
