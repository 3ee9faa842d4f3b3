// diptych: the echo of a scene beside its results, with what was in the files that the scene names
// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <string>

#include "coupling/scene/scene.h"

namespace diptych::coupling
{
  // The echo of the scene, and a sum over the bytes of every file that it reads, as a comment:
  // "# sample/radius_table held 0123456789abcdef". Of a file that is gone what an echo in this place told. Throws
  // std::runtime_error where it cannot be written.
  void write_echo(const std::string &file, const Scene &scene);

  // Of a scene that differs in what the comparison does alone: of what was in the files the earlier echo's word stays.
  void change_echo(const std::string &file, const Scene &scene);

  // An echo names the folder that its run wrote to: a run of a copy of it, or of that folder, would replace what stands there.
  // Throws SceneError where `file` is an echo, read as `scene`, and lies in another folder than it names, which is there
  // (or would be resumed) and is not where scenes of its name go anyway.
  void refuse_folder_of_an_echo(const std::string &file, const Scene &scene, bool resume);

  // "sample/radius_table: 'mine.csv' is not what it was": the first of the files that the scene reads whose bytes are others than
  // the echo tells, by the beginning of its key. Empty where none is; a file that is gone, or of which nothing is told, may be.
  std::string changed_input(const Scene &scene, const std::string &echo_file, const std::string &key = "");
} // namespace diptych::coupling
