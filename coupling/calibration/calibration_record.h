// diptych: what a calibration found
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
  // One observable of a path. Deviations of one sample and of their mean by the noise model.
  struct ObservableRecord
  {
    std::string kind;
    double      from = 0, to = 0;
    int         count = 0;
    double      mean = NAN, deviation = NAN, deviation_of_mean = NAN;
    double      before = NAN, after = NAN;   // of the continuum
    double      parameter_deviation = NAN;   // of `after`, by that of the parameters
    double      half_step           = NAN;   // of `after` with load steps half as long, less `after`
    bool        counts              = false; // in the fit
    std::string left_out;
  };

  struct PredictionRecord
  {
    std::string quantity;
    double      data = NAN, before = NAN, after = NAN; // means over the samples; of the continuum
    double      margin = NAN;
    Interval    difference; // continuum less grains, 95 %
    std::string verdict;
    double      parameter_deviation = NAN; // of the difference, by that of the parameters; paths not fitted
    Equivalence test;                      // of the samples, and of the parameters where these count
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
    std::string                   failed; // why the calibrated continuum has no run here
  };

  struct ParameterRecord
  {
    std::string              key, coordinate, other;
    std::vector<std::string> targets;                                           // whose own it is; empty: of all
    double                   low = 0, high = 0, start = 0;                      // numbers of the coordinate
    double                   number = NAN, number_low = NAN, number_high = NAN; // 95 %
    double                   value         = NAN;                               // of the key
    double                   share_known   = NAN;
    bool                     is_identified = false, at_bound = false, is_cut = false;
    std::vector<double>      profile_number, profile_chi2, profile_expected; // coarse; others moved along
  };

  struct MinimumRecord
  {
    std::vector<double> start, numbers; // of the coordinates
    double              chi2    = NAN;  // of the data
    double              total   = NAN;  // with what was known beforehand: what the search makes small
    int                 runs    = 0;
    bool                is_best = false;
    std::string         words;
  };

  // A value that one target has for itself.
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
    Settings                         settings; // best so far; what all targets have in common
    std::vector<OwnValue>            own;      // and what they do not
    double                           chi2_before = NAN, chi2_coarse = NAN, chi2 = NAN, misfit = NAN;
    int                              n_observables = 0, coarse_runs = 0, fine_runs = 0, other_runs = 0;
    double                           cpu_s = 0, grains_cpu_s = 0;
  };
} // namespace diptych::coupling
