// diptych: where probes lie and how they are resampled, as a scene says it
// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <vector>

namespace diptych::coupling
{
  struct ProbeOptions
  {
    double              zone_length  = 0.6;  // of the band's chord through the sample
    double              aspect       = 1.5;  // length / thickness of the packs' rectangles
    double              platen_gap   = 1.5;  // mean diameters kept clear of platens and sides
    double              minimum_side = 5;    // mean diameters
    std::vector<double> probe_rectangles;    // five numbers a probe; empty: placed by the band
    std::vector<double> probe_circle;        // three numbers; empty: placed by the band
    double              probe_block     = 5; // mean diameters
    int                 probe_resamples = 400;
  };

  template <class Visitor> void visit_parameters(ProbeOptions &o, Visitor &&visitor)
  {
    visitor("zone_length", o.zone_length, "-", {0.1, 1.},
            "length of the zone's probe, as a share of the band's chord through the sample");
    visitor("aspect", o.aspect, "-", {0.2, 5.}, "length / thickness of the probes in the packs");
    visitor("platen_gap", o.platen_gap, "mean diameters", {0., 100.},
            "kept clear of platens and sides by the probes in the packs and by the circular probe");
    visitor("minimum_side", o.minimum_side, "mean diameters", {1., 100.}, "smallest side of a probe");
    visitor(
      "probe_rectangles", o.probe_rectangles, "mean diameters, degrees", {-1e6, 1e6},
      "probes in the place of the automatic ones, five numbers each: x and y of the centre from the sample's centre, length, "
      "thickness, angle of the length from the horizontal; probes are compared with the first; empty: zone and packs are "
      "found by the band");
    visitor("probe_circle", o.probe_circle, "mean diameters", {-1e6, 1e6},
            "circular probe: x and y of its centre from the sample's centre, radius; empty: the largest that fits about the "
            "band's middle");
    visitor("probe_block", o.probe_block, "mean diameters", {5., 100.},
            "smallest side of the blocks that are resampled for the intervals of the probes");
    visitor("probe_resamples", o.probe_resamples, "-", {0, 100000},
            "resamples for the intervals of the probes; fewer than 40: no intervals");
  }

  // Throws std::invalid_argument naming probe_rectangles or probe_circle where a count is wrong or a size is not positive.
  void check_probe_options(const ProbeOptions &options);
} // namespace diptych::coupling
