// diptych: how shear bands are looked for, as a scene says it
// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

namespace diptych::coupling
{
  struct BandOptions
  {
    int    max_bands          = 2;    // 0, 1 or 2
    double huber_threshold    = 2.0;  // residuals beyond this many scales enter linearly, not squared
    double correlation_length = 10.0; // mean diameters; points closer than this are one independent sample
    double minimum_jump       = 0.1;  // of the platen increment; weaker bands are not reported
    double residual_floor     = 0.01; // of the platen increment; misfits below it count for nothing
    int    resamples          = 200;  // of the block bootstrap; 0 saves its time
  };

  template <class Visitor> void visit_parameters(BandOptions &o, Visitor &&visitor)
  {
    visitor("max_bands", o.max_bands, "-", {0, 2}, "largest number of bands tried in one displacement field");
    visitor("huber_threshold", o.huber_threshold, "scales", {0.5, 1e6},
            "misfit beyond which a point counts linearly, not squared");
    visitor("correlation_length", o.correlation_length, "mean diameters", {1., 100.},
            "points closer than this are one independent sample; also the least side of the blocks of the bootstrap");
    visitor("minimum_jump", o.minimum_jump, "platen increments", {0., 1.}, "weaker bands are not reported");
    visitor("residual_floor", o.residual_floor, "platen increments", {1e-6, 1.}, "misfit below which fits are equally good");
    visitor("band_resamples", o.resamples, "-", {0, 10000},
            "resamples of the block bootstrap that gives the 95 % intervals of a band; fewer than 40: no intervals");
  }
} // namespace diptych::coupling
