// diptych: the list of all numbers in the result files of a calibration
// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include "coupling/calibration/calibration_record.h"
#include "coupling/numbers/number_entry.h"

namespace diptych::coupling
{
  template <class Visitor> void list_numbers(const NoiseModel &n, Visitor &v)
  {
    v({"stress_level", "-", "standard deviation of the shift of a sample's whole t/s curve"}, n.stress_level);
    v({"stress_shape", "-", "standard deviation of t/s about the shifted curve"}, n.stress_shape);
    v({"correlation_strain", "-", "strain over which the shape is correlated"}, n.correlation_strain);
    v({"volume_start", "-", "standard deviation of the volumetric strain: constant part"}, n.volume_start);
    v({"volume_growth", "-", "standard deviation of the volumetric strain: part that grows with strain, per strain"},
      n.volume_growth);
    v({"ln_width", "-", "standard deviation of the logarithm of a band's width"}, n.ln_width);
    v({"degrees_of_freedom", "-", "number of samples minus number of paths", Kind::setting}, n.degrees_of_freedom);
  }

  template <class Visitor> void list_numbers(const ObservableRecord &o, Visitor &v)
  {
    v({"kind", "-",
       "stress_ratio, volumetric_strain: mean over a bin; ln_width: logarithm of the band width in a window, in mean diameters",
       Kind::setting},
      o.kind);
    v({"from", "as walk says", "start of the bin or window", Kind::setting}, o.from);
    v({"to", "as walk says", "end of the bin or window", Kind::setting}, o.to);
    v({"count", "-", "samples that have this observable", Kind::setting}, o.count);
    v({"mean", "-", "mean of the grains over the samples"}, o.mean);
    v({"deviation", "-", "standard deviation of one sample, by the noise model"}, o.deviation);
    v({"deviation_of_mean", "-", "standard deviation of the mean over the samples"}, o.deviation_of_mean);
    v({"before", "-", "value of the continuum before the calibration"}, o.before);
    v({"after", "-", "value of the calibrated continuum"}, o.after);
    v({"parameter_deviation", "-", "deviation of `after` that follows from the deviations of the parameters"},
      o.parameter_deviation);
    v({"half_step", "-", "change of `after` if the load steps are half as long"}, o.half_step);
    v({"counts", "-", "true if the fit uses this observable"}, o.counts);
    v({"left_out", "-", "reason why the fit of its path does not use it; empty if it does", Kind::setting}, o.left_out);
  }

  template <class Visitor> void list_numbers(const PredictionRecord &p, Visitor &v)
  {
    v({"quantity", "-", "peak_stress_ratio, volumetric_strain (last bin), width_10_90 (last window, mean diameters) or angle_deg",
       Kind::setting},
      p.quantity);
    v({"data", "as the quantity says", "mean of the grains"}, p.data);
    v({"before", "as the quantity says", "value of the continuum before the calibration"}, p.before);
    v({"after", "as the quantity says", "value of the calibrated continuum"}, p.after);
    v({"difference", "as the margin says", "continuum minus grains; relative for peak and width"}, p.difference);
    v({"margin", "as the quantity says", "largest difference that counts as equivalent", Kind::setting}, p.margin);
    v({"verdict", "-", "equivalent, different or cannot tell", Kind::setting}, p.verdict);
    v({"parameter_deviation", "as the margin",
       "part of the deviation of the difference due to the parameters; null if the interval omits it (fitted paths, angles)"},
      p.parameter_deviation);
  }

  template <class Visitor> void list_numbers(const PathRecord &p, Visitor &v)
  {
    v({"name", "-", "name of the path", Kind::setting}, p.name);
    v({"use", "-", "fit or predict", Kind::setting}, p.use);
    v({"seeds", "-", "seeds of its samples", Kind::setting}, p.seeds);
    v({"failed", "-", "reason why the calibrated continuum did not finish here; empty if it did", Kind::setting}, p.failed);
    v.list("observables", "numbers by which grains and continuum are compared", p.observables);
    v.list("predictions", "single numbers with verdicts", p.predictions);
    v({"progress", "as walk says", "loading variable at the points of the curves", Kind::setting}, p.progress);
    v({"stress_ratio", "-", "mean t/s of the grains"}, p.stress_ratio);
    v({"stress_ratio_low", "-", "mean minus two standard deviations of one sample"}, p.stress_ratio_low);
    v({"stress_ratio_high", "-", "mean plus two standard deviations of one sample"}, p.stress_ratio_high);
    v({"stress_ratio_before", "-", "t/s of the continuum before the calibration"}, p.stress_ratio_before);
    v({"stress_ratio_after", "-", "t/s of the calibrated continuum"}, p.stress_ratio_after);
    v({"volume", "-", "mean volumetric strain of the grains"}, p.volume);
    v({"volume_low", "-", "mean minus two standard deviations of one sample"}, p.volume_low);
    v({"volume_high", "-", "mean plus two standard deviations of one sample"}, p.volume_high);
    v({"volume_before", "-", "volumetric strain of the continuum before the calibration"}, p.volume_before);
    v({"volume_after", "-", "volumetric strain of the calibrated continuum"}, p.volume_after);
  }

  template <class Visitor> void list_numbers(const ParameterRecord &p, Visitor &v)
  {
    v({"key", "-", "key of the section continuum", Kind::setting}, p.key);
    v({"targets", "-", "targets it belongs to; empty: one value for all", Kind::setting}, p.targets);
    v({"coordinate", "-", "coordinate in which the search varies the key", Kind::setting}, p.coordinate);
    v({"of", "-", "the key that a share or drop refers to", Kind::setting}, p.other);
    v({"low", "as the coordinate says", "lower bound", Kind::setting}, p.low);
    v({"high", "as the coordinate says", "upper bound", Kind::setting}, p.high);
    v({"start", "as the coordinate says", "start of the first search", Kind::setting}, p.start);
    v({"number", "as the coordinate says", "best value of the coordinate"}, p.number);
    v({"number_low", "as the coordinate says",
       "lower end of the 95 % interval, from the scatter of the samples and the model tolerance"},
      p.number_low);
    v({"number_high", "as the coordinate says", "upper end of the same interval"}, p.number_high);
    v({"value", "as the key says", "value of the key"}, p.value);
    v({"share_known", "-", "deviation after the fit / prior deviation (a quarter of the range)"}, p.share_known);
    v({"is_identified", "-", "true if the data leave less than two thirds of the prior deviation"}, p.is_identified);
    v({"at_bound", "-", "true if the value lies at a bound"}, p.at_bound);
    v({"is_cut", "-", "true if a bound cuts off the interval"}, p.is_cut);
    v({"profile_number", "as the coordinate says",
       "coordinate 1.5 deviations below the minimum, at it and above it; coarse mesh"},
      p.profile_number);
    v({"profile_chi2", "-", "chi^2 there; the linear model gives the other parameters"}, p.profile_chi2);
    v({"profile_expected", "-", "chi^2 that the linear model predicts there"}, p.profile_expected);
  }

  template <class Visitor> void list_numbers(const MinimumRecord &m, Visitor &v)
  {
    v({"start", "as the coordinates say", "start of the search", Kind::setting}, m.start);
    v({"numbers", "as the coordinates say", "end of the search"}, m.numbers);
    v({"chi2", "-", "chi^2 of the data at the end, on the coarse mesh"}, m.chi2);
    v({"total", "-", "chi^2 of the data plus that of the prior, which the search minimises"}, m.total);
    v({"runs", "-", "runs of the continuum in this search", Kind::setting}, m.runs);
    v({"is_best", "-", "true if the search continued from here"}, m.is_best);
    v({"words", "-", "reason why the search did not converge; empty if it did", Kind::setting}, m.words);
  }

  template <class Visitor> void list_numbers(const OwnValue &o, Visitor &v)
  {
    v({"target", "-", "target that the value belongs to", Kind::setting}, o.target);
    v({"key", "-", "key of the section continuum", Kind::setting}, o.key);
    v({"value", "as the key says", "best value so far"}, o.value);
  }

  // All of calibration.json.
  template <class Visitor> void list_numbers(const CalibrationRecord &c, Visitor &v)
  {
    std::vector<std::string> settings;
    for (const Entry &entry : c.settings)
      settings.push_back(entry.section + "/" + entry.key + " = " + entry.value);
    v({"format", "-", "version of this file's format"}, 1);
    v({"title", "-", "title of the calibration", Kind::setting}, c.title);
    v({"status", "-", "finished, or the reason why it stopped early", Kind::setting}, c.status);
    v({"settings", "-", "best settings so far: the keys of calibrated.prm", Kind::setting}, settings);
    v.list("own", "values that belong to single targets", c.own);
    v({"chi2_before", "-", "chi^2 before the calibration"}, c.chi2_before);
    v({"chi2_coarse", "-", "chi^2 at the best point of the coarse mesh"}, c.chi2_coarse);
    v({"chi2", "-", "chi^2 of the calibrated continuum"}, c.chi2);
    v({"misfit", "-", "root of chi2 / its expected value; above 1, deviations of parameters are multiplied by it"}, c.misfit);
    v({"n_observables", "-", "number of observables in the fit", Kind::setting}, c.n_observables);
    v({"coarse_runs", "-", "coarse runs of the fit and the profiles", Kind::setting}, c.coarse_runs);
    v({"fine_runs", "-", "runs of the fit on the samples' own meshes", Kind::setting}, c.fine_runs);
    v({"other_runs", "-", "runs for the predictions", Kind::setting}, c.other_runs);
    v.group("noise", "scatter of one sample", c.noise);
    v({"words", "-", "findings as text", Kind::setting}, c.words);
    v.list("parameters", "fitted parameters", c.parameters);
    v({"correlation", "-", "correlation of the parameters in their coordinates"}, c.correlation);
    v.list("minima", "one per start", c.minima);
    v.list("paths", "fitted and predicted paths", c.paths);
  }

  // calibration_cost.json: measured times, kept apart so that calibration.json has the same bits every time.
  struct CalibrationCost
  {
    double continuum_cpu_s = 0, grains_cpu_s = 0;
  };
  template <class Visitor> void list_numbers(const CalibrationCost &c, Visitor &v)
  {
    v({"continuum_cpu_s", "s", "CPU time of all runs of the continuum", Kind::clock}, c.continuum_cpu_s);
    v({"grains_cpu_s", "s", "CPU time of all runs of the grains", Kind::clock}, c.grains_cpu_s);
  }
} // namespace diptych::coupling
