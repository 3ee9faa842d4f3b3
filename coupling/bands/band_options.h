// diptych: options of the band detection
// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

namespace diptych::coupling
{
  struct BandOptions
  {
    int    max_bands          = 2;    // 0, 1 or 2
    double huber_threshold    = 2.0;  // in robust scales of the misfit; larger residuals enter linearly, not squared
    double correlation_length = 10.0; // in mean diameters; points closer than this count as one independent sample
    double minimum_jump       = 0.1;  // in platen increments; weaker bands are not reported
    double residual_floor     = 0.01; // in platen increments; smaller misfits do not count
    int    resamples          = 200;  // resamples of the block bootstrap; 0: no intervals, which saves time
  };

  template <class Visitor> void visit_parameters(BandOptions &o, Visitor &&visitor)
  {
    visitor("max_bands", o.max_bands, "-", {0, 2}, "largest number of bands tried in one displacement field");
    visitor("huber_threshold", o.huber_threshold, "scales", {0.5, 1e6},
            "misfit, in robust standard deviations, beyond which a point counts linearly instead of squared");
    visitor("correlation_length", o.correlation_length, "mean diameters", {1., 100.},
            "distance below which points count as one independent sample; also the smallest side of a bootstrap block");
    visitor("minimum_jump", o.minimum_jump, "platen increments", {0., 1.}, "smallest displacement jump of a reported band");
    visitor("residual_floor", o.residual_floor, "platen increments", {1e-6, 1.},
            "misfit of the displacements below which fits count as equally good");
    visitor("band_resamples", o.resamples, "-", {0, 10000},
            "number of resamples of the block bootstrap that gives the 95 % intervals of a band; below 40 there are none");
  }
} // namespace diptych::coupling
