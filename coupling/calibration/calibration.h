// diptych: the contents of a calibration file: targets, quantities and parameters to be fitted
// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "coupling/studies/study.h"

namespace diptych::coupling
{
  // The coordinate in which a parameter is varied. Strengths, stiffnesses and lengths are varied in their logarithm. A residual
  // angle is varied by its drop, and a dilatancy angle by its share of a friction angle, so that no combination contradicts
  // itself.
  enum class Coordinate
  {
    value,
    logarithm,
    share_of, // value / other
    drop_from // 1 - value / other
  };
  constexpr auto choices(Coordinate)
  {
    return std::array{std::pair{Coordinate::value, "value"}, std::pair{Coordinate::logarithm, "logarithm"},
                      std::pair{Coordinate::share_of, "share_of"}, std::pair{Coordinate::drop_from, "drop_from"}};
  }

  // Start and bounds are numbers of the coordinate: the value itself (also for a logarithm), a share or a drop.
  struct CalibrationParameter
  {
    std::string              key; // a key of the section continuum
    Coordinate               coordinate = Coordinate::value;
    std::string              other; // the key that a share or drop refers to
    double                   start = 0, low = 0, high = 1;
    std::vector<std::string> targets = {}; // names of the targets it belongs to; empty: one value for all

    bool belongs_to(const std::string &target) const
    {
      return targets.empty() || std::find(targets.begin(), targets.end(), target) != targets.end();
    }
  };

  // A loading path: one scene on several samples.
  struct CalibrationTarget
  {
    std::string              name, scene;
    std::vector<std::string> results; // result folders, one per seed, instead of runs
    Settings                 settings;
    std::vector<int>         seeds;
    bool                     is_fitted = true; // false: predicted
    Settings                 before    = {};   // parameters to compare with; empty: those of the scene
  };

  // True if the paths differ in their samples only.
  inline bool is_same_path(const CalibrationTarget &a, const CalibrationTarget &b)
  {
    const auto same = [](const Entry &x, const Entry &y) {
      return x.section == y.section && x.key == y.key && x.value == y.value;
    };
    return a.scene == b.scene && std::equal(a.settings.begin(), a.settings.end(), b.settings.begin(), b.settings.end(), same);
  }

  // A kind of number that grains and continuum are compared by.
  enum class ObservableKind
  {
    stress_ratio,      // mean of t/s over a bin of the progress
    volumetric_strain, // mean over a bin
    ln_width           // logarithm of width_10_90 of the first band of a window, in mean diameters
  };
  constexpr auto choices(ObservableKind)
  {
    return std::array{std::pair{ObservableKind::stress_ratio, "stress_ratio"},
                      std::pair{ObservableKind::volumetric_strain, "volumetric_strain"},
                      std::pair{ObservableKind::ln_width, "ln_width"}};
  }

  // Values given by the user replace the estimates from the samples (noise.h).
  struct NoiseOptions
  {
    std::optional<double> stress_level, stress_shape, volume_start, volume_growth, ln_width;
    double                correlation_strain = 0.005;
    // Model tolerance: the misfit that the form of the law may have. It enters the weights and the intervals.
    double stress_discrepancy = 0.008, early_stress_discrepancy = 0.03, early_strain = 0.002;
    double volume_discrepancy = 0.0008, width_discrepancy = 0.1;
  };

  struct Calibration
  {
    std::string                       name, file, title;
    std::vector<CalibrationTarget>    targets;
    std::vector<ObservableKind>       kinds;
    std::vector<double>               bins; // ascending edges; a target uses those up to its end
    std::vector<CalibrationParameter> parameters;
    Settings                          fixed; // continuum keys that are fixed during the search
    NoiseOptions                      noise;
    int                               starts              = 2;
    int                               start_jacobians     = 1;     // Jacobians of each search after the first
    double                            load_step           = 0.001; // load step of the continuum
    double                            coarse_element_size = 4;     // in the first stage [mean diameters]
    int                               check_samples       = 2;     // samples per fitted target run again with half the step
    int                               seed                = 1;     // seed of the starts after the first
  };
} // namespace diptych::coupling
