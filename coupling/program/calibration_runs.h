// diptych: the runs of a calibration, on the study's workers
// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <map>
#include <set>
#include <string>
#include <vector>

#include "coupling/calibration/calibrate.h"
#include "coupling/program/command_line.h"
#include "coupling/program/study_runs.h"

namespace diptych::coupling
{
  // Every run is done once: its folder is named by what is run. Collective; all processes read the results. Functions that run
  // something throw StoppedOnRequest on all processes after a stop signal.
  class CalibrationRuns
  {
  public:
    CalibrationRuns(const CommandLine &line, const Calibration &calibration, std::string directory);

    // The grains of every target, run or read, with what they show. Throws SceneError where a result ends too early,
    // std::invalid_argument where grains do not come to their end.
    std::vector<CalibrationPath> paths();

    // Of the bins of an imported path: why one does not count. Between frames nothing is known of the grains.
    std::vector<std::string> without_frames(const CalibrationPath &path) const;

    // The first samples of a target with half the step: why an observable is left out, one entry each; empty: it is not. It is
    // where it moves by more than samples scatter, and by more than two runs of a sample differ by chance.
    std::vector<std::string> unsteady(const CalibrationPath &path, const NoiseModel &noise);

    std::vector<std::vector<ModelRun>> continuum(const std::vector<CalibrationPath> &paths, const ModelTask &task);

    bool   are_stopped() const { return stopped; } // on all processes
    double continuum_cpu_s() const { return spent_on_continuum; }
    double grains_cpu_s() const { return spent_on_grains; }

  private:
    // The box of a path's sample, where it looks for bands, and its mesh.
    struct Outline
    {
      double                   width = 0, height = 0, solid_fraction = 0;
      std::vector<SampleFrame> frames;
      std::string              mesh; // file
    };

    void                     run_or_stop(const StudyPoints &asked);
    std::vector<std::string> folders_of(const CalibrationTarget &target);
    Outline                  outline_of(const CalibrationPath &path, const std::vector<discrete::Snapshot> &snapshots);
    CalibrationPath          path_of(const CalibrationTarget &target);
    Study                    study_of(const CalibrationTarget &target, StudyCommand command) const;
    void                     note_cost(const std::string &folder, double &sum);
    std::string              mesh_of_sample(const Scene &scene, const discrete::Snapshot &grains);
    Settings                 model_settings(const CalibrationPath &path, const ModelTask &task) const;
    // The sample's mean density in the place of that of every cell: the meshes here have no grains.
    std::vector<Settings> with_density(const CalibrationPath &path, std::vector<Settings> points) const;
    ModelRun              model_run(const CalibrationPath &path, const StudyRun &run);

    CommandLine                    line;
    const Calibration             &calibration;
    std::string                    directory;
    std::map<std::string, Outline> outlines; // by the target's name
    std::set<std::string>          counted;
    bool                           stopped            = false;
    double                         spent_on_continuum = 0, spent_on_grains = 0;
  };
} // namespace diptych::coupling
