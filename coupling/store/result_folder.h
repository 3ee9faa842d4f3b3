// diptych: the folder that a run writes to
// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <functional>
#include <string>
#include <utility>
#include <vector>

#include "coupling/scene/scene.h"
#include "coupling/scene/scene_error.h"
#include "coupling/store/folder_lock.h"

namespace diptych::coupling
{
  // Files that a command reads, each with what it is: "the scene" -> "mine.prm".
  using InputFiles = std::vector<std::pair<std::string, std::string>>;

  // What a command does about results that stand in its folder.
  struct Opening
  {
    bool        resume     = false; // --resume: goes on from them
    bool        overwrite  = false; // --overwrite: renames their folder to DIRECTORY.1
    bool        adds       = false; // computes a part beside a sample that stays, as `diptych continuum` does
    bool        can_resume = true;  // the command has --resume
    std::string command;            // for provenance.json
    InputFiles  inputs;             // files that the command line names
  };

  // The keys by which the scene differs from the one of the folder, the first of each kind; empty: none.
  struct SceneChanges
  {
    std::string sample, continuum, comparison;
  };

  // Results of any command: of a run, an import, an ensemble, a study, a plan or a calibration.
  bool is_result_folder(const std::string &directory);

  // Throws SceneError where the folder holds results and the command may neither go on nor overwrite, or where it holds other
  // files. `what` names in the message what the command would write.
  void require_usable(const std::string &directory, const Opening &opening);

  // Renames the results in the folder to DIRECTORY.1; an earlier DIRECTORY.1 is replaced. Throws SceneError where it would move
  // one of the `inputs` or the working directory, or where DIRECTORY.1 holds no results; std::runtime_error
  // where another run writes to a folder in it.
  void set_aside(FolderLock &lock, const InputFiles &inputs);

  // The folder output/directory of a scene. The scene must outlive it.
  class ResultFolder
  {
  public:
    explicit ResultFolder(const Scene &scene)
        : scene(scene),
          directory(scene.output.directory)
    {}

    // Between the scene and the one whose results stand in the folder.
    SceneChanges changes() const { return changes_in(directory); }

    // Prepares the folder of a run: refuses it as require_usable() does, compares the scenes, calls `check`, which may throw
    // before anything has changed, sets old results aside, and writes scene.prm and provenance.json. Throws SceneError, also
    // where results of another sample stand there, and std::runtime_error where it cannot be written to.
    SceneChanges open(FolderLock                                      &lock,
                      const Opening                                   &opening,
                      const std::function<void(const SceneChanges &)> &check = {}) const;

    // Records in provenance.json that the comparison is now of this scene. The hashes of the panels stay those that were run.
    void record_compared(const std::string &command) const;

    // Everything that the scene asks for is in the folder, computed from this scene and these inputs.
    // Throws std::invalid_argument naming a file that was changed since.
    bool holds_finished_run() const;

    // Prepares next_folder(). True: it holds an interrupted run of the same scene, which can go on.
    bool open_next_continuum(const std::string &command) const;

  private:
    SceneChanges changes_in(const std::string &folder) const;

    // The resolved scene as FOLDER/scene.prm and its hashes in provenance.json.
    void write_scene(const std::string &folder, const std::string &command) const;

    const Scene       &scene;
    const std::string &directory;
  };

  // A continuum that replaces another one is computed in DIRECTORY/next, with its own scene.prm and provenance.json.
  std::string next_folder(const std::string &directory);

  // Moves the complete continuum from there to its place and removes the comparison with the old one.
  void replace_continuum(const std::string &directory);

  // The same from where a killed run has left it; does nothing where there is nothing to finish.
  void finish_replacement(const std::string &directory);

  // A comparison is written to DIRECTORY/next_comparison, with the scene that it is of, and then moved to its place.
  std::string next_comparison(const std::string &directory);
  void        take_next_comparison(const std::string &directory);

  // Removes files and folders that a run has written.
  void remove_results(const std::string &directory, const std::vector<std::string> &names);

  // "kept in results/mine: checkpoint.h5, discrete.csv, discrete.h5, scene.prm"
  std::string kept_in(const std::string &directory);

  // Runs `work`. An error that is neither wrong input nor a broken invariant (a full disk, a library that throws) is passed on as
  // std::runtime_error with what the folder keeps.
  int keeping(const std::string &directory, const std::function<int()> &work);

  // The same with the folder locked, on one process.
  int writing(const std::string &directory, const std::function<int(FolderLock &)> &work);
} // namespace diptych::coupling
