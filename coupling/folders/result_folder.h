// diptych: the folder that a run writes to
// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "coupling/folders/folder_lock.h"
#include "coupling/scene/scene.h"
#include "coupling/scene/scene_error.h"

namespace diptych::coupling
{
  // Files derived from the panels' results.
  extern const std::vector<std::string> comparison_files;

  // What was derived from other results of the folder must not outlive them.
  void remove_results(const std::string &directory, const std::vector<std::string> &names);

  void remove_panels(const std::string &directory); // all that both write

  // The first part of the path of a file below a folder, by whatever links either is named; empty where it lies elsewhere.
  std::string name_inside(const std::string &file, const std::string &directory);

  // Folders go whole when a run replaces them: throws SceneError naming what somebody else put there, which would go with them,
  // std::runtime_error where nothing can be removed from them.
  // A folder that is not there holds nothing. Of demand_own_folders() those in a result folder; of demand_own_run() the whole of
  // it.
  void demand_own(const std::string &folder, const std::function<bool(const std::string &)> &is_own);
  void demand_own_folders(const std::string &directory);
  void demand_own_run(const std::string &directory);

  // Makes the folder and writes the echo, once the whole scene has been found good. Results of another sample are removed, of
  // another continuum that panel's, of another comparison what was compared: the echo tells of what stands there.
  // Throws SceneError where the folder holds foreign content, an echo that was changed since, a file that the scene reads and
  // this run would replace, or (resume) belongs to another scene, std::runtime_error where it cannot be made. The caller holds
  // its lock. `check`, if given, is called once the folder is found to be this scene's and before anything in it is changed: it
  // may throw.
  void open_result_folder(const Scene &scene, bool resume, const std::function<void()> &check = {});

  // "kept in results/mine: scene.prm, discrete.csv, discrete.h5, checkpoint.h5"
  std::string kept_in(const std::string &directory);

  // Runs `work` for a folder. An error that is neither wrong input nor a broken invariant (a full disk, a library that throws) is
  // passed on as std::runtime_error with what the folder keeps.
  int keeping(const std::string &directory, const std::function<int()> &work);

  // The same with the folder locked meanwhile. On one process.
  int writing(const std::string &directory, const std::function<int()> &work);
} // namespace diptych::coupling
