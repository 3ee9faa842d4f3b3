// diptych: the folder that a run writes to
// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <functional>
#include <string>
#include <utility>
#include <vector>

#include "coupling/scene/scene.h"
#include "coupling/scene/scene_error.h"
#include "coupling/store/facts.h"
#include "coupling/store/folder_lock.h"

namespace diptych::coupling
{
  // Files that a command reads, each with a description: {"the scene", "mine.prm"}.
  using InputFiles = std::vector<std::pair<std::string, std::string>>;

  // How a command treats earlier results in its folder.
  struct Opening
  {
    bool        resume     = false; // --resume: continues them
    bool        overwrite  = false; // --overwrite: renames their folder to DIRECTORY.1
    bool        adds       = false; // computes one part and keeps the sample, as `diptych continuum` does
    bool        can_resume = true;  // the command has --resume
    std::string command;            // for provenance.json
    InputFiles  inputs;             // files that the command line names
  };

  // The first key of each kind by which the scene differs from the scene of the folder; empty if they agree.
  struct SceneChanges
  {
    std::string sample, continuum, comparison;
  };

  // Results of campaigns, which consist of many runs.
  bool is_ensemble_folder(const std::string &directory);
  bool is_study_folder(const std::string &directory);
  bool is_calibration_folder(const std::string &directory);

  // Results of any command: a run, an import, an ensemble, a study, a plan, a calibration or an element.
  bool is_result_folder(const std::string &directory);

  // Throws SceneError if the folder holds results and neither --resume nor --overwrite is given, or if it holds other files.
  void require_usable(const std::string &directory, const Opening &opening);

  // Renames the folder to DIRECTORY.1 and deletes an earlier DIRECTORY.1. Throws SceneError if this would move one of the
  // `inputs` or the working directory, or if DIRECTORY.1 holds no results. Throws std::runtime_error if another run writes to a
  // folder in it.
  void set_aside(FolderLock &lock, const InputFiles &inputs);

  // The folder output/directory of a scene. The scene must outlive it.
  class ResultFolder
  {
  public:
    explicit ResultFolder(const Scene &scene)
        : scene(scene),
          directory(scene.output.directory)
    {}

    // Differences between this scene and the scene of the results in the folder.
    SceneChanges changes() const { return changes_in(directory); }

    // Prepares the folder of a run. First it refuses results of another sample, and unusable folders as require_usable() does.
    // Then it calls `check`, which may throw before anything has changed. At last it sets old results aside, and writes scene.prm
    // and provenance.json. Throws SceneError, and std::runtime_error if the folder cannot be written to.
    SceneChanges open(FolderLock                                      &lock,
                      const Opening                                   &opening,
                      const std::function<void(const SceneChanges &)> &check = {}) const;

    // True if the folder holds the finished grains, or all results of the scene, computed from this scene and its present input
    // files. Both throw std::invalid_argument with the name of a result file that was changed later.
    bool holds_finished_grains() const;
    bool holds_finished_run() const;

    // Prepares next_continuum(). Returns true if it holds an interrupted run of the same scene that can continue.
    bool open_next_continuum(const std::string &command) const;

    // Prepares next_comparison(), empty but for scene.prm and provenance.json.
    void open_next_comparison(const std::string &command) const;

  private:
    SceneChanges changes_in(const std::string &folder) const;

    // Writes the resolved scene to FOLDER/scene.prm, and to provenance.json its hashes.
    void write_scene(const std::string &folder, const std::string &command, SceneHashes hashes) const;

    const Scene       &scene;
    const std::string &directory;
  };

  // Folders in which new results are computed beside earlier ones: DIRECTORY/next for a continuum with its comparison,
  // DIRECTORY/next_comparison for a comparison alone. Each has a separate scene.prm and provenance.json.
  std::string next_continuum(const std::string &directory);
  std::string next_comparison(const std::string &directory);

  // Moves all results from one of these folders, whose record is complete, to their place. Removes a comparison or a report that
  // they outdate.
  void take(const std::string &directory, const std::string &next);

  // Completes a move that a killed run has left half done. Does nothing if there is none.
  void finish_move(const std::string &directory);

  // Removes the named files and folders, which a run has written.
  void remove_results(const std::string &directory, const std::vector<std::string> &names);

  // "kept in results/mine: checkpoint.h5, discrete.csv, discrete.h5, scene.prm"
  std::string kept_in(const std::string &directory);

  // Runs `work`. A system failure (a full disk, a library that throws) is passed on as std::runtime_error with the list of the
  // kept files. Wrong input and broken invariants pass unchanged.
  int keeping(const std::string &directory, const std::function<int()> &work);

  // As keeping(), with the folder locked, on one process.
  int writing(const std::string &directory, const std::function<int(FolderLock &)> &work);
} // namespace diptych::coupling
