// diptych: results of a calibration
// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <cmath>
#include <string>
#include <vector>

#include "coupling/calibration/noise.h"
#include "coupling/scene/scene_text.h"
#include "coupling/statistics/equivalence.h"

namespace diptych::coupling
{
  // One observable of a path. The noise model gives the deviations of one sample and of their mean.
  struct ObservableRecord
  {
    std::string kind;
    double      from = 0, to = 0;
    int         count = 0;
    double      mean = NAN, deviation = NAN, deviation_of_mean = NAN;
    double      before = NAN, after = NAN;   // of the continuum
    double      parameter_deviation = NAN;   // of `after`, from the deviations of the parameters
    double      half_step           = NAN;   // `after` with half the load step, minus `after`
    bool        counts              = false; // true if the fit uses it
    std::string left_out;
  };

  struct PredictionRecord
  {
    std::string quantity;
    double      data = NAN, before = NAN, after = NAN; // mean over the samples; continuum
    double      margin = NAN;
    Interval    difference; // continuum minus grains, 95 %
    std::string verdict;
    double      parameter_deviation = NAN; // of the difference, from the parameters; paths not fitted
    Equivalence test;                      // of the samples, and of the parameters if they are included
  };

  struct PathRecord
  {
    std::string                   name, use;
    std::vector<int>              seeds;
    std::vector<ObservableRecord> observables;
    std::vector<PredictionRecord> predictions;
    std::vector<double>           progress;
    std::vector<double>           stress_ratio, stress_ratio_low, stress_ratio_high, stress_ratio_before, stress_ratio_after;
    std::vector<double>           volume, volume_low, volume_high, volume_before, volume_after;
    std::string                   failed; // reason why the calibrated continuum has no run here
  };

  struct ParameterRecord
  {
    std::string              key, coordinate, other;
    std::vector<std::string> targets;                                           // targets it belongs to; empty: all
    double                   low = 0, high = 0, start = 0;                      // numbers of the coordinate
    double                   number = NAN, number_low = NAN, number_high = NAN; // 95 % interval
    double                   value         = NAN;                               // of the key
    double                   share_known   = NAN;
    bool                     is_identified = false, at_bound = false, is_cut = false;
    std::vector<double>      profile_number, profile_chi2, profile_expected; // coarse mesh; other parameters follow
  };

  struct MinimumRecord
  {
    std::vector<double> start, numbers; // numbers of the coordinates
    double              chi2    = NAN;  // of the data
    double              total   = NAN;  // with the prior: the sum that the search minimises
    int                 runs    = 0;
    bool                is_best = false;
    std::string         words;
  };

  // A value that belongs to one target.
  struct OwnValue
  {
    std::string target, key;
    double      value = NAN;
  };

  struct CalibrationRecord
  {
    std::string                      title, status = "started";
    std::vector<PathRecord>          paths;
    std::vector<ParameterRecord>     parameters;
    std::vector<std::vector<double>> correlation;
    std::vector<MinimumRecord>       minima;
    NoiseModel                       noise;
    std::vector<std::string>         words;    // findings
    Settings                         settings; // best so far, common to all targets
    std::vector<OwnValue>            own;      // values of single targets
    double                           chi2_before = NAN, chi2_coarse = NAN, chi2 = NAN, misfit = NAN;
    int                              n_observables = 0, coarse_runs = 0, fine_runs = 0, other_runs = 0;
    double                           cpu_s = 0, grains_cpu_s = 0;
  };
} // namespace diptych::coupling
