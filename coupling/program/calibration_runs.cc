// diptych: the runs of a calibration, on the study's workers
// SPDX-License-Identifier: LGPL-2.1-or-later
#include "coupling/program/calibration_runs.h"

#include <algorithm>
#include <cmath>
#include <filesystem>

#include "continuum/history.h"
#include "continuum/mesh/mesh.h"
#include "coupling/comparison/increment.h"
#include "coupling/panels/continuum_mesh.h"
#include "coupling/plans/plan_text.h"
#include "coupling/processes/processes.h"
#include "coupling/processes/stop_signal.h"
#include "coupling/scene/scene_file.h"
#include "coupling/statistics/student.h"
#include "coupling/store/continuum_snapshot_file.h"
#include "coupling/store/file_names.h"
#include "coupling/store/provenance.h"
#include "coupling/studies/study_folder.h"
#include "coupling/studies/study_results.h"
#include "discrete/panel/snapshot_file.h"

namespace diptych::coupling
{
  namespace
  {
    Entry setting(const std::string &section, const std::string &key, const std::string &value)
    {
      return {section, key, value, "the calibration", ""};
    }

    // Without the reference.
    std::vector<ScenePoint> own_points_of(const Study &study)
    {
      std::vector<ScenePoint> points;
      for (const ScenePoint &point : points_of(study))
        if (point.family >= 0)
          points.push_back(point);
      return points;
    }

    // Whether the law asks for a solid fraction.
    bool has_density(const Scene &scene, const Settings &settings)
    {
      std::string hardening = text_of(scene.continuum.material.hardening);
      for (const Entry &entry : settings)
        if (entry.section == "continuum" && entry.key == "hardening")
          hardening = entry.value;
      return hardening == text_of(continuum::HardeningKind::critical_state);
    }

    // Why a run has no result; empty: it has.
    std::string words_of(const std::string &directory, const StudyRun &run, const StudyCommand command)
    {
      if (const auto end = found_end(directory, run); end && end->exit_code == 0)
        return "";
      Study study;
      study.command          = command;
      const RunResult result = result_of(directory, study, run);
      return result.words.empty() ? "the run was lost" : result.words;
    }
  } // namespace

  CalibrationRuns::CalibrationRuns(const CommandLine &line, const Calibration &calibration, std::string directory)
      : line(line),
        calibration(calibration),
        directory(std::move(directory))
  {
    this->line.resume = false; // what is finished is told once
  }

  Study CalibrationRuns::study_of(const CalibrationTarget &target, const StudyCommand command) const
  {
    Study study;
    study.name     = target.name;
    study.file     = calibration.file;
    study.scene    = target.scene;
    study.command  = command;
    study.settings = target.settings;
    if (command == StudyCommand::discrete)
      study.families.push_back(family_of({{}}));
    return study;
  }

  void CalibrationRuns::run_or_stop(const StudyPoints &asked)
  {
    for (const TaskOutcome &outcome : do_runs(line, asked))
      stopped = stopped || outcome.interrupted;
    stopped = any_process(stopped);
    if (stopped)
      throw StoppedOnRequest("stopped on request");
  }

  void CalibrationRuns::note_cost(const std::string &folder, double &sum)
  {
    if (!counted.insert(folder).second)
      return;
    for (const PhaseCost &phase : read_run_facts(folder).phases)
      sum += phase.cpu_s;
  }

  std::vector<std::string> CalibrationRuns::folders_of(const CalibrationTarget &target)
  {
    if (!target.results.empty())
      return target.results;
    Study study = study_of(target, StudyCommand::discrete);
    study.seeds = target.seeds;
    const StudyPoints asked{study, own_points_of(study), directory};
    run_or_stop(asked);
    std::vector<std::string> folders;
    for (std::size_t k = 0; k < target.seeds.size(); ++k)
      {
        const StudyRun run = asked.points.front().runs.at(k);
        if (const std::string words = words_of(directory, run, study.command); !words.empty())
          throw std::invalid_argument(calibration.file + ": target '" + target.name + "', seed " +
                                      std::to_string(target.seeds[k]) + ": the grains did not come to their end: " + words);
        folders.push_back(run_folder(directory, run));
        note_cost(folders.back(), spent_on_grains);
      }
    return folders;
  }

  std::string CalibrationRuns::mesh_of_sample(const Scene &scene, const discrete::Snapshot &grains)
  {
    if (scene.continuum.mesh.kind == continuum::MeshOption::Kind::file)
      return scene.continuum.mesh.file;
    const std::string file =
      std::filesystem::absolute(directory + "/meshes/path_" + std::to_string(1 + outlines.size()) + ".msh").string();
    on_first_process([&] {
      std::filesystem::create_directories(directory + "/meshes");
      continuum::write_mesh(mesh_of(scene.continuum, continuum_parts(scene).front().edge, &grains), file);
      return 0;
    });
    return file;
  }

  // One outline serves all samples of a path: what differs between them is the grains' business.
  CalibrationRuns::Outline CalibrationRuns::outline_of(const CalibrationPath                 &path,
                                                       const std::vector<discrete::Snapshot> &snapshots)
  {
    for (const CalibrationTarget &other : calibration.targets)
      if (const auto found = outlines.find(other.name); found != outlines.end() && is_same_path(other, path.target))
        return found->second;
    const SampleFrame box = sample_frame(snapshots.front(), snapshots.front());
    return {box.width, box.height, solid_fraction(snapshots.front()), frames_of(path.data.observables, snapshots),
            mesh_of_sample(path.scene, snapshots.front())};
  }

  CalibrationPath CalibrationRuns::path_of(const CalibrationTarget &target)
  {
    const Scene     scene = read_changed_scene(target.scene, target.settings, true);
    CalibrationPath path{target, scene, {}, {}, {}};
    path.data.observables = observables_of(calibration, scene);
    for (const std::string &folder : folders_of(target))
      {
        const HistoryTable history = panel_table(folder, Source::discrete);
        const double       reached = history.empty() || history.at("progress").empty() ? 0 : history.at("progress").back();
        if (is_beyond(path.data.observables.front().to, reached) || is_beyond(scene.loading.axial_strain, reached))
          throw SceneError(calibration.file + ": target '" + target.name + "': " + folder + " ends at " +
                           std::to_string(reached) + ", before the end of its loading");
        const auto snapshots = discrete::read_snapshots(discrete_h5(folder));
        if (path.samples.empty())
          outlines[target.name] = outline_of(path, snapshots);
        path.samples.push_back(observe(scene, path.data.observables, history, snapshots));
        path.data.samples.push_back(path.samples.back().values);
      }
    summarise(path.data);
    path.left_out.resize(path.data.observables.size());
    return path;
  }

  std::vector<CalibrationPath> CalibrationRuns::paths()
  {
    std::vector<CalibrationPath> paths;
    for (const CalibrationTarget &target : calibration.targets)
      paths.push_back(path_of(target));
    return paths;
  }

  std::vector<std::string> CalibrationRuns::without_frames(const CalibrationPath &path) const
  {
    std::vector<std::string> why;
    for (const Observable &one : path.data.observables)
      {
        const std::vector<double> frames = stages(path.scene.loading);
        const bool                holds  = std::any_of(frames.begin(), frames.end(),
                                                       [&](const double at) { return at >= one.from && at <= one.to; });
        why.push_back(holds || one.kind == ObservableKind::ln_width ? "" : "no frame lies in it");
      }
    return why;
  }

  std::vector<std::string> CalibrationRuns::unsteady(const CalibrationPath &path, const NoiseModel &noise)
  {
    Study             study = study_of(path.target, StudyCommand::discrete);
    const std::size_t n     = std::min(std::size_t(calibration.check_samples), path.target.seeds.size());
    study.seeds             = {path.target.seeds.begin(), path.target.seeds.begin() + std::ptrdiff_t(n)};
    if (const std::optional<double> step = path.scene.discrete.time.step)
      study.settings.push_back(setting("discrete", "step", text_of(0.5 * *step)));
    else
      study.settings.push_back(setting("discrete", "accuracy", text_of(0.5 * path.scene.discrete.accuracy.accuracy)));
    const StudyPoints asked{study, own_points_of(study), directory};
    run_or_stop(asked);
    Eigen::VectorXd moved = Eigen::VectorXd::Zero(Eigen::Index(path.data.observables.size()));
    for (std::size_t k = 0; k < n; ++k)
      {
        const StudyRun run = asked.points.front().runs.at(k);
        if (const std::string words = words_of(directory, run, study.command); !words.empty())
          throw std::invalid_argument(calibration.file + ": target '" + path.target.name + "', seed " +
                                      std::to_string(study.seeds[k]) + ", with half the grains' step: " + words);
        const std::string folder = run_folder(directory, run);
        note_cost(folder, spent_on_grains);
        moved += (observe(path.scene, path.data.observables, panel_table(folder, Source::discrete),
                          discrete::read_snapshots(discrete_h5(folder)))
                    .values -
                  path.samples[k].values) /
                 double(n);
      }
    std::vector<std::string> why;
    const Eigen::VectorXd    scatter = covariance(noise, path.data.observables).diagonal().cwiseSqrt();
    // Grains part after a while: two runs of a sample differ by chance, too.
    const double allowed = std::max(1., normal_quantile * std::sqrt(2. / double(n)));
    for (Eigen::Index k = 0; k < moved.size(); ++k)
      why.push_back(std::abs(moved[k]) > allowed * scatter[k] ? "half the step of the grains moves it by " + rounded(moved[k]) +
                                                                  ", samples scatter by " + rounded(scatter[k])
                                                              : "");
    return why;
  }

  Settings CalibrationRuns::model_settings(const CalibrationPath &path, const ModelTask &task) const
  {
    const Outline &outline  = outlines.at(path.target.name);
    Settings       settings = path.target.settings;
    if (task.mesh == ModelMesh::coarse)
      for (const auto &[key, value] : {std::pair<const char *, std::string>{"mesh", "rectangle"},
                                       {"rectangle_width", text_of(outline.width)},
                                       {"rectangle_height", text_of(outline.height)},
                                       {"element_size", text_of(calibration.coarse_element_size)}})
        settings.push_back(setting("continuum", key, value));
    else
      settings.push_back(setting("continuum", "mesh", outline.mesh));
    for (const char *key : {"initial_step", "max_step"})
      settings.push_back(setting("continuum", key, text_of(task.load_step)));
    settings.push_back(setting("comparison", "coarse_element_size", "0"));
    return settings;
  }

  std::vector<Settings> CalibrationRuns::with_density(const CalibrationPath &path, std::vector<Settings> points) const
  {
    for (Settings &settings : points)
      if (has_density(path.scene, settings) && !path.scene.continuum.material.solid_fraction_start)
        settings.push_back(setting("continuum", "solid_fraction_start", text_of(outlines.at(path.target.name).solid_fraction)));
    return points;
  }

  ModelRun CalibrationRuns::model_run(const CalibrationPath &path, const StudyRun &run)
  {
    ModelRun result;
    if (!run.scene)
      {
        result.words = run.refusal;
        return result;
      }
    const std::string folder = run_folder(directory, run);
    result.words             = words_of(directory, run, StudyCommand::continuum);
    note_cost(folder, spent_on_continuum);
    if (result.words.empty())
      result.observation = observe(path.scene, path.data.observables, panel_table(folder, Source::continuum),
                                   read_continuum_snapshots(continuum_h5(folder)), outlines.at(path.target.name).frames);
    return result;
  }

  std::vector<std::vector<ModelRun>> CalibrationRuns::continuum(const std::vector<CalibrationPath> &paths, const ModelTask &task)
  {
    StudyPoints asked{study_of(paths[task.paths.front()].target, StudyCommand::continuum), {}, directory};
    for (std::size_t at = 0; at < task.paths.size(); ++at)
      {
        const CalibrationPath &path  = paths[task.paths[at]];
        Study                  study = study_of(path.target, StudyCommand::continuum);
        study.settings               = model_settings(path, task);
        std::vector<Settings> of_points;
        for (const std::vector<Settings> &point : task.points)
          of_points.push_back(point[at]);
        study.families.push_back(family_of(with_density(path, of_points)));
        const std::vector<ScenePoint> points = own_points_of(study);
        asked.points.insert(asked.points.end(), points.begin(), points.end());
      }
    run_or_stop(asked);
    std::vector<std::vector<ModelRun>> results(task.points.size());
    for (std::size_t p = 0; p < task.paths.size(); ++p)
      for (std::size_t k = 0; k < task.points.size(); ++k)
        results[k].push_back(model_run(paths[task.paths[p]], asked.points[p * task.points.size() + k].runs.front()));
    return results;
  }
} // namespace diptych::coupling
