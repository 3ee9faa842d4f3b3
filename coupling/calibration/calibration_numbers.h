// diptych: the one list of the numbers of a calibration
// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include "coupling/calibration/calibration_record.h"
#include "coupling/numbers/number_entry.h"

namespace diptych::coupling
{
  template <class Visitor> void list_numbers(const NoiseModel &n, Visitor &v)
  {
    v({"stress_level", "-", "deviation of a shift of the whole t/s curve, of one sample"}, n.stress_level);
    v({"stress_shape", "-", "deviation of t/s beside that shift"}, n.stress_shape);
    v({"correlation_strain", "-", "over which the shape forgets"}, n.correlation_strain);
    v({"volume_start", "-", "deviation of the volumetric strain: constant part"}, n.volume_start);
    v({"volume_growth", "-", "and what grows with the strain, per strain"}, n.volume_growth);
    v({"ln_width", "-", "deviation of the logarithm of a band's width"}, n.ln_width);
    v({"degrees_of_freedom", "-", "samples less paths", Kind::setting}, n.degrees_of_freedom);
  }

  template <class Visitor> void list_numbers(const ObservableRecord &o, Visitor &v)
  {
    v({"kind", "-", "stress_ratio, volumetric_strain: means over a bin; ln_width: of a window, in mean diameters", Kind::setting},
      o.kind);
    v({"from", "as walk says", "of the bin or window", Kind::setting}, o.from);
    v({"to", "as walk says", "of the bin or window", Kind::setting}, o.to);
    v({"count", "-", "samples that have it", Kind::setting}, o.count);
    v({"mean", "-", "of the grains"}, o.mean);
    v({"deviation", "-", "of one sample, by the noise model"}, o.deviation);
    v({"deviation_of_mean", "-", "of the mean of the samples"}, o.deviation_of_mean);
    v({"before", "-", "of the continuum with the parameters from before"}, o.before);
    v({"after", "-", "of the continuum as calibrated"}, o.after);
    v({"parameter_deviation", "-", "of the latter, by that of the parameters"}, o.parameter_deviation);
    v({"half_step", "-", "how far load steps half as long move the latter"}, o.half_step);
    v({"counts", "-", "in the fit"}, o.counts);
    v({"left_out", "-", "why it does not count, though its path was fitted; empty: it counts", Kind::setting}, o.left_out);
  }

  template <class Visitor> void list_numbers(const PredictionRecord &p, Visitor &v)
  {
    v({"quantity", "-", "peak_stress_ratio, volumetric_strain (last bin), width_10_90 (last window, mean diameters), angle_deg",
       Kind::setting},
      p.quantity);
    v({"data", "as the quantity says", "mean of the grains"}, p.data);
    v({"before", "as the quantity says", "of the continuum with the parameters from before"}, p.before);
    v({"after", "as the quantity says", "of the continuum as calibrated"}, p.after);
    v({"difference", "as the margin says", "continuum less grains; relative for peak and width"}, p.difference);
    v({"margin", "as the quantity says", "up to where they count as equivalent", Kind::setting}, p.margin);
    v({"verdict", "-", "equivalent, different, cannot tell", Kind::setting}, p.verdict);
    v({"parameter_deviation", "as the margin",
       "of the difference, by that of the parameters; null: not in the interval (paths fitted, angles)"},
      p.parameter_deviation);
  }

  template <class Visitor> void list_numbers(const PathRecord &p, Visitor &v)
  {
    v({"name", "-", "of the path", Kind::setting}, p.name);
    v({"use", "-", "fit or predict", Kind::setting}, p.use);
    v({"seeds", "-", "of its samples", Kind::setting}, p.seeds);
    v({"failed", "-", "why the calibrated continuum does not come to its end here; empty: it does", Kind::setting}, p.failed);
    v.list("observables", "that grains and continuum are held against each other by", p.observables);
    v.list("predictions", "and single numbers, with verdicts", p.predictions);
    v({"progress", "as walk says", "of the curves", Kind::setting}, p.progress);
    v({"stress_ratio", "-", "mean of the grains"}, p.stress_ratio);
    v({"stress_ratio_low", "-", "two deviations of one sample below"}, p.stress_ratio_low);
    v({"stress_ratio_high", "-", "and above"}, p.stress_ratio_high);
    v({"stress_ratio_before", "-", "continuum, the parameters from before"}, p.stress_ratio_before);
    v({"stress_ratio_after", "-", "continuum, calibrated"}, p.stress_ratio_after);
    v({"volume", "-", "mean volumetric strain of the grains"}, p.volume);
    v({"volume_low", "-", "two deviations of one sample below"}, p.volume_low);
    v({"volume_high", "-", "and above"}, p.volume_high);
    v({"volume_before", "-", "continuum, the parameters from before"}, p.volume_before);
    v({"volume_after", "-", "continuum, calibrated"}, p.volume_after);
  }

  template <class Visitor> void list_numbers(const ParameterRecord &p, Visitor &v)
  {
    v({"key", "-", "of the section continuum", Kind::setting}, p.key);
    v({"targets", "-", "whose own it is; empty: one value for all", Kind::setting}, p.targets);
    v({"coordinate", "-", "in which it is searched for", Kind::setting}, p.coordinate);
    v({"of", "-", "the key that a share or drop refers to", Kind::setting}, p.other);
    v({"low", "as the coordinate says", "bound", Kind::setting}, p.low);
    v({"high", "as the coordinate says", "bound", Kind::setting}, p.high);
    v({"start", "as the coordinate says", "where the first search began", Kind::setting}, p.start);
    v({"number", "as the coordinate says", "found"}, p.number);
    v({"number_low", "as the coordinate says", "95 %, by the samples' scatter and what the law is granted"}, p.number_low);
    v({"number_high", "as the coordinate says", "95 %"}, p.number_high);
    v({"value", "as the key says", "of the key"}, p.value);
    v({"share_known", "-", "deviation left, of a quarter of the range that was known before"}, p.share_known);
    v({"is_identified", "-", "whether the data leave less than two thirds of it"}, p.is_identified);
    v({"at_bound", "-", "whether it lies at a bound"}, p.at_bound);
    v({"is_cut", "-", "whether its interval ends at a bound"}, p.is_cut);
    v({"profile_number", "as the coordinate says", "one and a half deviations below, the minimum, and above; coarse mesh"},
      p.profile_number);
    v({"profile_chi2", "-", "chi^2 there, the other parameters moved along as the linear model says"}, p.profile_chi2);
    v({"profile_expected", "-", "chi^2 that the linear model expects there"}, p.profile_expected);
  }

  template <class Visitor> void list_numbers(const MinimumRecord &m, Visitor &v)
  {
    v({"start", "as the coordinates say", "where the search began", Kind::setting}, m.start);
    v({"numbers", "as the coordinates say", "where it ended"}, m.numbers);
    v({"chi2", "-", "of the data there, on the coarse mesh"}, m.chi2);
    v({"total", "-", "the same with what was known beforehand: what the search makes small"}, m.total);
    v({"runs", "-", "that it took", Kind::setting}, m.runs);
    v({"is_best", "-", "whether the search went on from here"}, m.is_best);
    v({"words", "-", "why the search did not arrive; empty: it did", Kind::setting}, m.words);
  }

  template <class Visitor> void list_numbers(const OwnValue &o, Visitor &v)
  {
    v({"target", "-", "whose own the value is", Kind::setting}, o.target);
    v({"key", "-", "of the section continuum", Kind::setting}, o.key);
    v({"value", "as the key says", "found so far"}, o.value);
  }

  // The whole of calibration.json.
  template <class Visitor> void list_numbers(const CalibrationRecord &c, Visitor &v)
  {
    std::vector<std::string> settings;
    for (const Entry &entry : c.settings)
      settings.push_back(entry.section + "/" + entry.key + " = " + entry.value);
    v({"format", "-", "of this file"}, 1);
    v({"title", "-", "of the calibration", Kind::setting}, c.title);
    v({"status", "-", "finished, or why it ended before", Kind::setting}, c.status);
    v({"settings", "-", "found so far: the keys of calibrated.prm", Kind::setting}, settings);
    v.list("own", "values that single targets have for themselves", c.own);
    v({"chi2_before", "-", "with the parameters from before"}, c.chi2_before);
    v({"chi2_coarse", "-", "at the best point of the coarse mesh"}, c.chi2_coarse);
    v({"chi2", "-", "as calibrated"}, c.chi2);
    v({"misfit", "-", "root of chi2 / (observables - parameters); above 1 deviations of parameters are multiplied by it"},
      c.misfit);
    v({"n_observables", "-", "that count", Kind::setting}, c.n_observables);
    v({"coarse_runs", "-", "of the fit and the profiles", Kind::setting}, c.coarse_runs);
    v({"fine_runs", "-", "of the fit", Kind::setting}, c.fine_runs);
    v({"other_runs", "-", "of the predictions", Kind::setting}, c.other_runs);
    v.group("noise", "how samples scatter", c.noise);
    v({"words", "-", "what was found, in words", Kind::setting}, c.words);
    v.list("parameters", "that were searched for", c.parameters);
    v({"correlation", "-", "of the parameters in their coordinates"}, c.correlation);
    v.list("minima", "one a start", c.minima);
    v.list("paths", "that were fitted or predicted", c.paths);
  }

  // calibration_cost.json: what clocks measured, apart, so that calibration.json is the same bits every time.
  struct CalibrationCost
  {
    double continuum_cpu_s = 0, grains_cpu_s = 0;
  };
  template <class Visitor> void list_numbers(const CalibrationCost &c, Visitor &v)
  {
    v({"continuum_cpu_s", "s", "CPU time of all runs of the continuum", Kind::clock}, c.continuum_cpu_s);
    v({"grains_cpu_s", "s", "CPU time of the grains' runs", Kind::clock}, c.grains_cpu_s);
  }
} // namespace diptych::coupling
