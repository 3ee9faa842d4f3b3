// diptych: the observables of one run, by which grains and continuum are compared
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
  // Bins up to the end of the scene's loading, and windows of its comparison. Throws std::invalid_argument if there are none.
  std::vector<Observable> observables_of(const Calibration &calibration, const Scene &scene);

  // Results of one run of a panel.
  struct Observation
  {
    Eigen::VectorXd values;                  // one per observable; NaN: not reached, or no band
    double          peak_stress_ratio = NAN; // largest running mean
    double          angle_deg         = NAN; // of the first band of the last window, a line; without its sign
                                             // if chance decides between left and right
    std::vector<double> progress, stress_ratio, volumetric_strain; // the curve, at curve_points places
  };
  constexpr int curve_points = 120;

  Observation observe(const Scene                           &scene,
                      const std::vector<Observable>         &observables,
                      const HistoryTable                    &history,
                      const std::vector<discrete::Snapshot> &snapshots);

  // The continuum's bands are searched in the grains' frames, one per observable of kind ln_width, so that both panels are
  // measured alike. If there is no band, the width counts as half of the sample's height. A band that wide cannot be
  // distinguished from a homogeneous deformation.
  Observation observe(const Scene                            &scene,
                      const std::vector<Observable>          &observables,
                      const HistoryTable                     &history,
                      const std::vector<continuum::Snapshot> &snapshots,
                      const std::vector<SampleFrame>         &frames);

  // Frames of the grains' windows.
  std::vector<SampleFrame> frames_of(const std::vector<Observable>         &observables,
                                     const std::vector<discrete::Snapshot> &snapshots);
} // namespace diptych::coupling
