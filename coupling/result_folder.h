// diptych: the folder that a run writes to
// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <string>
#include <vector>

#include "coupling/commands.h"
#include "coupling/scene.h"

namespace diptych::coupling
{
  // Files derived from the panels' results.
  extern const std::vector<std::string> comparison_files;

  // What was derived from other results of the folder must not outlive them.
  void remove_results(const std::string &directory, const std::vector<std::string> &names);

  // The sections sample, loading and discrete of an echoed scene: what decides which sample both panels show.
  std::string sample_part(const std::string &echoed);

  // Every key that decides what the continuum panel shows of that sample.
  std::string continuum_part(const std::string &echoed);

  // scene.prm of a folder; empty where there is none.
  std::string earlier_echo(const std::string &directory);

  // Makes the folder and writes the echo, once the whole scene has been found good. Results of another sample are removed.
  // Throws SceneError where the folder cannot be made, holds foreign content, or (resume) belongs to another scene.
  void open_result_folder(const Scene &scene, bool resume);

  // The scene of a command line, with its output folder.
  Scene scene_of(const CommandLine &line);

  void        say(const CommandLine &line, const std::string &text);   // unless --quiet
  std::string reached(double strain);                                  // "2.5 % axial strain"
  std::string reached(const LoadingOptions &loading, double progress); // "2.5 % shear strain", "time 3"

  // Runs a Python script of the program as a child of its own, no shell between. Throws std::runtime_error where it fails.
  void run_script(const std::string &script, const std::vector<std::string> &arguments);
} // namespace diptych::coupling
