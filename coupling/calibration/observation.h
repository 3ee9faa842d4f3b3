// diptych: what grains and continuum are held against each other by, read from a run
// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <cmath>
#include <string>
#include <vector>

#include <Eigen/Core>

#include "continuum/snapshot.h"
#include "coupling/bands/band.h"
#include "coupling/calibration/noise.h"
#include "coupling/scene/scene.h"
#include "coupling/statistics/history_table.h"
#include "discrete/snapshot.h"

namespace diptych::coupling
{
  // Bins up to the end of the scene's loading, windows of its comparison. Throws std::invalid_argument where none is left.
  std::vector<Observable> observables_of(const Calibration &calibration, const Scene &scene);

  // One run of a panel.
  struct Observation
  {
    Eigen::VectorXd values;                  // one entry an observable; NaN: not reached, or no band
    double          peak_stress_ratio = NAN; // largest running mean
    double          angle_deg         = NAN; // of the first band of the last window; line, without its sign where
                                             // left and right are chosen by chance
    std::vector<double> progress, stress_ratio, volumetric_strain; // the curve, at curve_points places
  };
  constexpr int curve_points = 120;

  Observation observe(const Scene                           &scene,
                      const std::vector<Observable>         &observables,
                      const HistoryTable                    &history,
                      const std::vector<discrete::Snapshot> &snapshots);

  // The continuum's bands are looked for in the grains' frames, one an observable of kind ln_width, so that both are measured
  // alike. Where it shows none its width counts as half of the sample's height, from which on a band is not told from what the
  // whole sample does.
  Observation observe(const Scene                            &scene,
                      const std::vector<Observable>          &observables,
                      const HistoryTable                     &history,
                      const std::vector<continuum::Snapshot> &snapshots,
                      const std::vector<SampleFrame>         &frames);

  // Of the grains' windows.
  std::vector<SampleFrame> frames_of(const std::vector<Observable>         &observables,
                                     const std::vector<discrete::Snapshot> &snapshots);
} // namespace diptych::coupling
