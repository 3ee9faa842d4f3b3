// diptych: the words of a command line
// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "coupling/processes/run_options.h"
#include "coupling/program/exit_code.h"
#include "coupling/scene/scene.h"
#include "coupling/store/result_folder.h"
#include "discrete/problem_files/fclib.h"
#include "discrete/solvers/solver.h"

namespace diptych::coupling
{
  enum class Command
  {
    run,
    discrete,
    continuum,
    material_point,
    check_law,
    solve,
    compare,
    new_scene,
    explain,
    completion
  };

  struct SolveOptions
  {
    discrete::SolverOptions              options = discrete::stored_solver_options();
    std::optional<discrete::ProblemForm> form; // none: the better form in the file
  };

  // Options of a run with grains or continuum.
  struct SceneOptions
  {
    std::vector<std::string> overrides;           // --set section/key=value, after the keys of --set-file
    std::vector<std::string> set_files;           // --set-file
    bool                     checks_only = false; // run: --check
  };

  struct CommandLine : RunOptions, SceneOptions
  {
    Command      command = Command::explain;
    std::string  target;              // scene or problem file, result folder, section or shell
    std::string  output;              // --output
    std::string  word;                // explain results WORD
    bool         prints_json = false; // explain: --json
    SolveOptions solve;
    bool         prints_warnings = true; // true on the first of several processes
    std::string  path;                   // material-point: --path; empty: that of the scene
  };

  // The parsed command line, from the words after the program's name. If they are wrong or only ask for help, the version or a
  // completion script, the answer is already printed, and `exit_code` is set.
  struct ParsedLine
  {
    std::optional<int> exit_code;
    CommandLine        line;
  };
  ParsedLine parse_command_line(const std::vector<std::string> &words);

  std::string name_of(Command command);

  // Throws SceneError for a word that cannot stand in a message or a file.
  void require_text(const std::vector<std::string> &words);

  // Puts the keys of --set-file before those of --set.
  void take_set_files(CommandLine &line);

  // Options of the command line for a folder that holds results.
  Opening opening_of(const CommandLine &line, bool adds = false);

  // The scene of a command line, with its output folder. Its warnings go to standard error.
  Scene scene_of(const CommandLine &line);
  Scene with_options(const CommandLine &line, Scene scene); // the same for a scene that is already read
} // namespace diptych::coupling
