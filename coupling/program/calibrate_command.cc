// diptych: calibrate CALIBRATION.json: the continuum's parameters from the grains' curves
// SPDX-License-Identifier: LGPL-2.1-or-later
#include "coupling/program/calibrate_command.h"

#include <algorithm>
#include <cstdlib>
#include <iostream>
#include <map>
#include <optional>
#include <sstream>

#include "coupling/calibration/calibration_file.h"
#include "coupling/calibration/calibration_output.h"
#include "coupling/panels/continuum_loading.h"
#include "coupling/plans/plan_text.h"
#include "coupling/processes/processes.h"
#include "coupling/processes/stop_signal.h"
#include "coupling/program/calibration_runs.h"
#include "coupling/program/report_command.h"
#include "coupling/scene/identity.h"
#include "coupling/scene/keys.h"
#include "coupling/scene/scene_file.h"
#include "coupling/store/provenance.h"
#include "coupling/store/result_folder.h"
#include "coupling/studies/study_folder.h"
#include "discrete/choices.h"

namespace diptych::coupling
{
  namespace
  {
    // Of keys that are numbers, the first that is met.
    struct TakeNumbers
    {
      std::map<std::string, double> &values;

      template <class T> void operator()(const char *key, const T &value, const char *, const char *) const
      {
        (*this)(key, value, "", Range(), "");
      }
      template <class T> void operator()(const char *key, const T &value, const char *, const Range &, const char *) const
      {
        if constexpr (std::is_same_v<T, double>)
          values.emplace(key, value);
      }
    };

    // Values that shares and drops refer to: those of the first fitted scene, with what is fixed.
    std::map<std::string, double> fixed_values(const Calibration &calibration)
    {
      std::map<std::string, double> values;
      for (const Entry &entry : calibration.fixed)
        {
          char        *end   = nullptr;
          const double value = std::strtod(entry.value.c_str(), &end);
          if (end != entry.value.c_str() && *end == 0)
            values.emplace(entry.key, value);
        }
      for (const CalibrationTarget &target : calibration.targets)
        if (target.is_fitted)
          {
            Scene scene = read_changed_scene(target.scene, target.settings, true);
            visit_parameters(scene.continuum.material, TakeNumbers{values});
          }
      return values;
    }

    void demand_observables(const Calibration &calibration, const CalibrationTarget &target, const Scene &scene)
    {
      if (scene.continuum.initial_stress == continuum::InitialStress::mapped)
        throw SceneError(target.scene +
                         ": continuum/initial_stress = mapped has no place in a calibration: one mesh serves all samples");
      try
        {
          const std::vector<Observable> observables = observables_of(calibration, scene);
          for (const ObservableKind kind : calibration.kinds)
            if (target.is_fitted &&
                std::none_of(observables.begin(), observables.end(), [&](const Observable &o) { return o.kind == kind; }))
              throw std::invalid_argument("no bin or window of " + discrete::name_of(kind) + " lies within its loading");
        }
      catch (const std::invalid_argument &error)
        {
          throw SceneError(calibration.file + ": target '" + target.name + "': " + error.what());
        }
    }

    // The start must be a scene for every target.
    void check_start(const Calibration &calibration, const Coordinates &coordinates)
    {
      for (const CalibrationTarget &target : calibration.targets)
        {
          Settings       settings = target.settings;
          const Settings start    = coordinates.settings(coordinates.start(), target.name);
          settings.insert(settings.end(), calibration.fixed.begin(), calibration.fixed.end());
          settings.insert(settings.end(), start.begin(), start.end());
          const Scene scene = read_changed_scene(target.scene, settings, true);
          require_continuum(scene);
          demand_observables(calibration, target, scene);
          for (const CalibrationParameter &p : calibration.parameters)
            for (const auto &[key, because] : continuum::unused_keys(scene.continuum))
              if (p.key == key && p.belongs_to(target.name))
                throw SceneError(calibration.file + ": parameters: " + key + " is read by no law of target '" + target.name +
                                 "': continuum/" + because);
          Settings before = target.settings;
          before.insert(before.end(), target.before.begin(), target.before.end());
          (void)read_changed_scene(target.scene, before, true);
        }
    }

    // Whether the samples can tell how they scatter shows in how many they are.
    void check_noise(const Calibration &calibration)
    {
      std::vector<TargetData> all;
      for (const CalibrationTarget &target : calibration.targets)
        {
          TargetData data;
          data.observables = observables_of(calibration, read_changed_scene(target.scene, target.settings, true));
          data.samples.assign(target.seeds.size(), Eigen::VectorXd::Zero(Eigen::Index(data.observables.size())));
          summarise(data);
          all.push_back(data);
        }
      try
        {
          (void)noise_of(all, calibration.noise);
        }
      catch (const std::invalid_argument &error)
        {
          throw SceneError(calibration.file + ": " + error.what());
        }
    }

    InputFiles inputs_of(const Calibration &calibration)
    {
      InputFiles inputs{{"the calibration", calibration.file}};
      for (const CalibrationTarget &target : calibration.targets)
        {
          inputs.emplace_back("targets: '" + target.name + "': the scene", target.scene);
          for (const std::string &folder : target.results)
            inputs.emplace_back("targets: '" + target.name + "': results", folder);
          for (const auto &input : input_files(read_changed_scene(target.scene, target.settings, true)))
            inputs.push_back(input);
        }
      return inputs;
    }

    Coordinates coordinates_of(const Calibration &calibration)
    {
      try
        {
          return {calibration.parameters, fixed_values(calibration)};
        }
      catch (const std::invalid_argument &error)
        {
          throw SceneError(calibration.file + ": parameters: " + error.what());
        }
    }

    std::string summary(const CalibrationRecord &record)
    {
      std::ostringstream text;
      text.precision(4);
      text << record.title << ": chi^2 of " << record.n_observables << " observables " << record.chi2_before << " -> "
           << record.chi2 << "; " << record.coarse_runs << " coarse and " << record.fine_runs << " fine runs, "
           << record.other_runs << " of predictions, " << record.cpu_s << " CPU s\n";
      for (const ParameterRecord &p : record.parameters)
        text << "  " << p.key << " = " << p.value << ' '
             << (p.other.empty() ? "" : p.coordinate + " " + p.other + " " + rounded(p.number) + " ") << '[' << p.number_low
             << ", " << p.number_high << "]" << (p.is_identified ? "" : ", not identified") << '\n';
      for (const PathRecord &path : record.paths)
        for (const PredictionRecord &one : path.predictions)
          text << "  " << path.name << " (" << path.use << "): " << one.quantity << ' ' << one.data << ", before " << one.before
               << ", after " << one.after << ": " << one.verdict << '\n';
      for (const std::string &words : record.words)
        text << "  " << words << '\n';
      return text.str();
    }

    // What the step of the grains moves is no datum.
    void check_data(const Calibration            &calibration,
                    std::vector<CalibrationPath> &paths,
                    CalibrationRuns              &runs,
                    CalibrationRecord            &record)
    {
      std::vector<TargetData> all;
      for (const CalibrationPath &path : paths)
        all.push_back(path.data);
      const NoiseModel noise = noise_of(all, calibration.noise);
      for (CalibrationPath &path : paths)
        {
          if (!path.target.is_fitted)
            continue;
          if (path.scene.discrete.method.method == discrete::Method::imported)
            {
              path.left_out = runs.without_frames(path);
              record.words.push_back("target '" + path.target.name +
                                     "' is imported: nothing was run again, and only bins that hold a frame count");
              continue;
            }
          if (calibration.check_samples == 0 || !path.target.results.empty())
            {
              record.words.push_back("target '" + path.target.name + "' was not checked for the step of its grains");
              continue;
            }
          path.left_out = runs.unsteady(path, noise);
          for (std::size_t k = 0; k < path.left_out.size(); ++k)
            if (const Observable &one = path.data.observables[k]; !path.left_out[k].empty())
              record.words.push_back("left out: " + path.target.name + ", " + discrete::name_of(one.kind) + " from " +
                                     rounded(one.from) + " to " + rounded(one.to) + ": " + path.left_out[k]);
        }
    }

    void keep(const std::string &directory, const CalibrationRuns &runs, CalibrationRecord &record)
    {
      record.cpu_s        = runs.continuum_cpu_s();
      record.grains_cpu_s = runs.grains_cpu_s();
      on_first_process([&] {
        write_calibration(directory, record);
        return 0;
      });
    }

    int carry_out(const CommandLine &line,
                  const Calibration &calibration,
                  const Coordinates &coordinates,
                  const std::string &directory)
    {
      CalibrationRuns   runs(line, calibration, directory);
      CalibrationRecord record;
      record.title = calibration.title;
      try
        {
          std::vector<CalibrationPath> paths = runs.paths();
          check_data(calibration, paths, runs, record);
          calibrate(
            calibration, coordinates, paths, [&](const ModelTask &task) { return runs.continuum(paths, task); }, record);
        }
      catch (const StoppedOnRequest &stopped)
        {
          if (!runs.are_stopped()) // this process alone: the others do not come to keep()
            throw;
          record.status = stopped.what();
        }
      catch (const SceneError &)
        {
          throw;
        }
      catch (const std::invalid_argument &error)
        {
          record.status = error.what();
        }
      keep(directory, runs, record);
      return on_first_process([&] {
        if (record.status == "finished")
          {
            std::cout << summary(record) << std::flush;
            if (!stop_requested())
              draw_page(line, Drawing::calibration, directory);
            say(line, directory + "/calibrated.prm, calibration.json, calibration.csv");
            return int(done);
          }
        std::cerr << "diptych: " << record.status << "; what was found is kept in " << directory
                  << "; to go on: diptych calibrate " << line.target << " --output " << directory << " --resume" << std::endl;
        return int(not_converged);
      });
    }
  } // namespace

  int run_calibration(const CommandLine &line)
  {
    const Calibration calibration = read_calibration(line.target);
    const std::string directory   = line.output.empty() ? "results/" + calibration.name + "_calibration" : line.output;
    const Coordinates coordinates = coordinates_of(calibration);
    check_start(calibration, coordinates); // before anything is changed
    check_noise(calibration);
    std::optional<FolderLock> lock;
    return keeping(directory, [&] {
      on_first_process([&] {
        lock.emplace(directory);
        open_runs_folder(*lock, folder_of_a_calibration, calibration.file, opening_of(line), inputs_of(calibration));
        return 0;
      });
      return carry_out(line, calibration, coordinates, directory);
    });
  }
} // namespace diptych::coupling
