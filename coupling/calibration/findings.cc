// diptych: turns the results of a fit into records and findings
// SPDX-License-Identifier: LGPL-2.1-or-later
#include "coupling/calibration/findings.h"

#include <algorithm>
#include <cmath>
#include <sstream>

#include "coupling/scene/keys.h"
#include "coupling/statistics/equivalence.h"
#include "coupling/statistics/student.h"
#include "discrete/choices.h"
#include "discrete/files/words.h"

namespace diptych::coupling
{
  namespace
  {
    ParameterRecord parameter_record(const Coordinates     &coordinates,
                                     const Identification  &knowledge,
                                     const Eigen::VectorXd &point,
                                     const std::size_t      k)
    {
      constexpr double            close = 1e-3;
      const CalibrationParameter &p     = coordinates.parameter(k);
      const Eigen::Index          place = Eigen::Index(k);
      const double                here = point[place], deviation = knowledge.deviation[place];
      const auto                  number_at = [&](const double x) {
        Eigen::VectorXd moved = point;
        moved[place]          = std::clamp(x, 0., 1.);
        return coordinates.numbers(moved)[k];
      };
      ParameterRecord result;
      result.key = p.key, result.targets = p.targets, result.coordinate = discrete::name_of(p.coordinate), result.other = p.other;
      result.low = p.low, result.high = p.high, result.start = p.start;
      result.number        = number_at(here);
      result.value         = coordinates.values(point)[k];
      result.number_low    = number_at(here - knowledge.quantile[place] * deviation);
      result.number_high   = number_at(here + knowledge.quantile[place] * deviation);
      result.share_known   = knowledge.share_known[place];
      result.is_identified = knowledge.is_identified[k];
      result.at_bound      = here < close || here > 1 - close;
      result.is_cut        = here - knowledge.quantile[place] * deviation < 0 || here + knowledge.quantile[place] * deviation > 1;
      return result;
    }

    // One number of a path: the grains' values, one per sample, and the continuum's.
    struct PathNumber
    {
      std::vector<double> grains;
      double              before = NAN, after = NAN;
    };

    PredictionRecord prediction(const std::string &quantity,
                                const PathNumber  &number,
                                const double       margin,
                                const bool         is_relative)
    {
      PredictionRecord    record;
      std::vector<double> grains;
      std::copy_if(number.grains.begin(), number.grains.end(), std::back_inserter(grains),
                   [](const double x) { return std::isfinite(x); });
      record.quantity = quantity, record.margin = margin, record.before = number.before, record.after = number.after;
      record.data = statistics(grains).mean;
      Equivalence test;
      if (std::isfinite(number.after) && is_relative)
        test = compare_relative(grains, std::vector<double>(grains.size(), number.after), margin);
      else if (std::isfinite(number.after))
        {
          std::vector<double> differences;
          for (const double x : grains)
            differences.push_back(number.after - x);
          test = compare_differences(differences, margin);
        }
      record.difference = test.difference, record.verdict = text_of(test.verdict), record.test = test;
      return record;
    }

    // The last observable of a kind, if there is one.
    std::optional<std::size_t> last_of(const std::vector<Observable> &observables, const ObservableKind kind)
    {
      for (std::size_t k = observables.size(); k-- > 0;)
        if (observables[k].kind == kind)
          return k;
      return {};
    }

    PathNumber path_number(const CalibrationPath &path, const PathRuns &runs, const std::size_t k, const bool is_logarithm)
    {
      const auto value = [&](const Observation &o) {
        const double x = o.values.size() > 0 ? o.values[Eigen::Index(k)] : NAN;
        return is_logarithm ? std::exp(x) : x;
      };
      PathNumber number{{}, value(runs.before.observation), value(runs.after.observation)};
      for (const Observation &sample : path.samples)
        number.grains.push_back(value(sample));
      return number;
    }

    void add_predictions(const CalibrationPath &path, const PathRuns &runs, PathRecord &record)
    {
      const EquivalenceMargins &margins = path.scene.comparison.margins;
      PathNumber                peak{{}, runs.before.observation.peak_stress_ratio, runs.after.observation.peak_stress_ratio};
      std::vector<double>       turns;
      for (const Observation &sample : path.samples)
        {
          peak.grains.push_back(sample.peak_stress_ratio);
          const double turn = runs.after.observation.angle_deg - sample.angle_deg;
          if (std::isfinite(turn))
            turns.push_back(turn);
        }
      record.predictions.push_back(prediction("peak_stress_ratio", peak, margins.peak_stress_ratio, true));
      if (const auto k = last_of(path.data.observables, ObservableKind::volumetric_strain))
        record.predictions.push_back(
          prediction("volumetric_strain", path_number(path, runs, *k, false), margins.volumetric_strain, false));
      if (const auto k = last_of(path.data.observables, ObservableKind::ln_width))
        {
          PathNumber width = path_number(path, runs, *k, true);
          if (!std::isfinite(runs.before.observation.angle_deg)) // in the fit only, half the height replaces a missing band
            width.before = NAN;
          if (!std::isfinite(runs.after.observation.angle_deg))
            width.after = NAN;
          record.predictions.push_back(prediction("width_10_90", width, margins.thickness, true));
          const Equivalence test = compare_turns(turns, margins.angle);
          PredictionRecord  angle;
          angle.quantity = "angle_deg", angle.before = runs.before.observation.angle_deg,
          angle.after = runs.after.observation.angle_deg;
          std::vector<double> of_grains;
          for (const Observation &sample : path.samples)
            if (std::isfinite(sample.angle_deg))
              of_grains.push_back(sample.angle_deg);
          angle.data = line_statistics(of_grains).mean, angle.margin = margins.angle;
          angle.difference = test.difference, angle.verdict = text_of(test.verdict);
          record.predictions.push_back(angle);
        }
    }

    // Mean of the samples, plus and minus two deviations of one sample, and both curves of the continuum.
    void add_curves(const CalibrationPath &path, const PathRuns &runs, PathRecord &record)
    {
      const auto &first = path.samples.front();
      record.progress   = first.progress;
      for (std::size_t k = 0; k < first.progress.size(); ++k)
        {
          std::vector<double> t, v;
          for (const Observation &sample : path.samples)
            t.push_back(sample.stress_ratio[k]), v.push_back(sample.volumetric_strain[k]);
          const SampleStatistics stress = statistics(t), volume = statistics(v);
          record.stress_ratio.push_back(stress.mean), record.volume.push_back(volume.mean);
          record.stress_ratio_low.push_back(stress.mean - 2 * stress.deviation);
          record.stress_ratio_high.push_back(stress.mean + 2 * stress.deviation);
          record.volume_low.push_back(volume.mean - 2 * volume.deviation);
          record.volume_high.push_back(volume.mean + 2 * volume.deviation);
        }
      record.stress_ratio_before = runs.before.observation.stress_ratio,
      record.volume_before       = runs.before.observation.volumetric_strain;
      record.stress_ratio_after  = runs.after.observation.stress_ratio,
      record.volume_after        = runs.after.observation.volumetric_strain;
    }
  } // namespace

  void tell_parameters(const Coordinates     &coordinates,
                       const Identification  &knowledge,
                       const Eigen::VectorXd &point,
                       CalibrationRecord     &record)
  {
    for (std::size_t k = 0; k < coordinates.size(); ++k)
      record.parameters.push_back(parameter_record(coordinates, knowledge, point, k));
    for (Eigen::Index i = 0; i < knowledge.correlation.rows(); ++i)
      {
        record.correlation.emplace_back();
        for (Eigen::Index j = 0; j < knowledge.correlation.cols(); ++j)
          record.correlation.back().push_back(knowledge.correlation(i, j));
      }
    for (const ParameterRecord &p : record.parameters)
      {
        const std::string name = p.key + (p.targets.empty() ? "" : " (" + discrete::listed(p.targets) + ")");
        if (!p.is_identified)
          record.words.push_back(name + " is not identified: its uncertainty is still " +
                                 text_of(std::round(100 * p.share_known)) + " % of what it was before");
        if (p.at_bound)
          record.words.push_back(name + " lies at its bound; widen low and high, or fix it");
        else if (p.is_cut)
          record.words.push_back("the interval of " + name +
                                 " ends at its bound, so this end comes from the bound and not from the data");
      }
  }

  void add_parameters_to_predictions(const double quantile, PathRecord &record)
  {
    // The peak is the largest value of the curve. Near a flat peak it moves as the curve does.
    const ObservableRecord *highest = nullptr, *last_volume = nullptr, *last_width = nullptr;
    for (const ObservableRecord &one : record.observables)
      {
        if (one.kind == discrete::name_of(ObservableKind::stress_ratio) && (highest == nullptr || one.after > highest->after))
          highest = &one;
        if (one.kind == discrete::name_of(ObservableKind::volumetric_strain))
          last_volume = &one;
        if (one.kind == discrete::name_of(ObservableKind::ln_width))
          last_width = &one;
      }
    const auto widen = [&](const char *quantity, const ObservableRecord *by, const auto &deviation_of) {
      for (PredictionRecord &p : record.predictions)
        if (p.quantity == quantity && by != nullptr && std::isfinite(by->parameter_deviation))
          {
            p.parameter_deviation = deviation_of(p, *by);
            p.test                = widened(p.test, p.parameter_deviation, quantile, p.margin);
            p.difference = p.test.difference, p.verdict = text_of(p.test.verdict);
          }
    };
    widen("peak_stress_ratio", highest, [](const auto &p, const auto &by) { return by.parameter_deviation / p.data; });
    widen("volumetric_strain", last_volume, [](const auto &, const auto &by) { return by.parameter_deviation; });
    widen("width_10_90", last_width, [](const auto &p, const auto &by) { return by.parameter_deviation * p.after / p.data; });
  }

  void tell_misfit(CalibrationRecord &record)
  {
    if (!(record.misfit > 1))
      return;
    std::ostringstream text;
    text.precision(3);
    text << "chi^2 is " << record.chi2 << ", " << record.misfit * record.misfit
         << " times the expected value: this law cannot reproduce the data within noise and model tolerance; "
            "deviations of the parameters are multiplied by "
         << record.misfit;
    record.words.push_back(text.str());
  }

  PathRecord path_record(const CalibrationPath &path, const PathRuns &runs)
  {
    PathRecord record;
    record.name = path.target.name, record.use = path.target.is_fitted ? "fit" : "predict", record.seeds = path.target.seeds;
    record.failed                  = runs.after.words;
    const Eigen::VectorXd variance = covariance(runs.noise, path.data.observables).diagonal();
    const auto            value    = [](const ModelRun &run, const std::size_t k) {
      return run.words.empty() && run.observation.values.size() > 0 ? run.observation.values[Eigen::Index(k)] : NAN;
    };
    for (std::size_t k = 0; k < path.data.observables.size(); ++k)
      {
        const Observable  &one = path.data.observables[k];
        const Eigen::Index at  = Eigen::Index(k);
        ObservableRecord   entry;
        entry.kind = discrete::name_of(one.kind), entry.from = one.from, entry.to = one.to;
        entry.count = path.data.count[at], entry.mean = path.data.mean[at];
        entry.deviation         = std::sqrt(variance[at]);
        entry.deviation_of_mean = entry.deviation / std::sqrt(double(std::max(1, entry.count)));
        entry.before = value(runs.before, k), entry.after = value(runs.after, k);
        entry.half_step = value(runs.halved, k) - entry.after;
        entry.left_out  = path.left_out.empty() ? "" : path.left_out[k];
        record.observables.push_back(entry);
      }
    add_predictions(path, runs, record);
    add_curves(path, runs, record);
    return record;
  }
} // namespace diptych::coupling
