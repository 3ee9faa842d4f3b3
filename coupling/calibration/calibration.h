// diptych: what a calibration asks: which keys of the continuum, fitted to what of which grains
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
  // In what a parameter is searched for. Strengths, stiffnesses and lengths are searched for in their logarithm; a residual angle
  // by how far it drops, and a dilatancy angle by its share of a friction angle, so that no pair contradicts itself.
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

  // Start and bounds are numbers of the coordinate: the value itself (also of a logarithm), a share or a drop.
  struct CalibrationParameter
  {
    std::string              key; // of the section continuum
    Coordinate               coordinate = Coordinate::value;
    std::string              other; // share_of, drop_from: a key of the section continuum
    double                   start = 0, low = 0, high = 1;
    std::vector<std::string> targets = {}; // whose own it is, by name; empty: one value for all

    bool belongs_to(const std::string &target) const
    {
      return targets.empty() || std::find(targets.begin(), targets.end(), target) != targets.end();
    }
  };

  // One path: a scene on several samples.
  struct CalibrationTarget
  {
    std::string              name, scene;
    std::vector<std::string> results; // result folders, one a seed, in the place of runs
    Settings                 settings;
    std::vector<int>         seeds;
    bool                     is_fitted = true; // else predicted
    Settings                 before    = {};   // what the calibrated law is compared with; empty: the scene's own
  };

  // But for its samples.
  inline bool is_same_path(const CalibrationTarget &a, const CalibrationTarget &b)
  {
    const auto same = [](const Entry &x, const Entry &y) {
      return x.section == y.section && x.key == y.key && x.value == y.value;
    };
    return a.scene == b.scene && std::equal(a.settings.begin(), a.settings.end(), b.settings.begin(), b.settings.end(), same);
  }

  // What is held against each other.
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

  // What the noise model is told in the place of an estimate from the samples (noise.h).
  struct NoiseOptions
  {
    std::optional<double> stress_level, stress_shape, volume_start, volume_growth, ln_width;
    double                correlation_strain = 0.005;
    // How far the continuum's form itself may lie beside the grains: it goes into the weights and into the intervals.
    double stress_discrepancy = 0.008, early_stress_discrepancy = 0.03, early_strain = 0.002;
    double volume_discrepancy = 0.0008, width_discrepancy = 0.1;
  };

  struct Calibration
  {
    std::string                       name, file, title;
    std::vector<CalibrationTarget>    targets;
    std::vector<ObservableKind>       kinds;
    std::vector<double>               bins; // edges of the strain bins, ascending; those beyond a target's end do not count there
    std::vector<CalibrationParameter> parameters;
    Settings                          fixed; // continuum keys that are set and not searched for
    NoiseOptions                      noise;
    int                               starts              = 2;
    int                               start_jacobians     = 1;     // of a search beyond the first
    double                            load_step           = 0.001; // of the continuum
    double                            coarse_element_size = 4;     // of the first stage [mean diameters]
    int                               check_samples       = 2;     // of each fitted target, run again with half the grains' step
    int                               seed                = 1;     // of the starts beyond the first
  };
} // namespace diptych::coupling
