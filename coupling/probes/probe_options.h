// diptych: options for the places of probes and for their resampling
// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <stdexcept>
#include <string>
#include <vector>
#include "discrete/files/wrong_keys.h"

namespace diptych::coupling
{
  struct ProbeOptions
  {
    double              zone_length  = 0.6;  // share of the band's chord through the sample
    double              aspect       = 1.5;  // length / thickness of the rectangles beside the band
    double              platen_gap   = 1.5;  // distance from platens and sides, in mean diameters
    double              minimum_side = 5;    // in mean diameters
    std::vector<double> probe_rectangles;    // five numbers per probe; empty: the band places the probes
    std::vector<double> probe_circle;        // three numbers; empty: the band places the circle
    double              probe_block     = 5; // in mean diameters
    int                 probe_resamples = 400;
  };

  template <class Visitor> void visit_parameters(ProbeOptions &o, Visitor &&visitor)
  {
    visitor("zone_length", o.zone_length, "-", {0.1, 1.},
            "length of the rectangular probe in the band, as a share of the band's chord through the sample");
    visitor("aspect", o.aspect, "-", {0.2, 5.},
            "ratio of length to thickness of the rectangular probes above and below the band");
    visitor("platen_gap", o.platen_gap, "mean diameters", {0., 100.},
            "smallest distance of the circular probe, and of the probes above and below the band, from platens and sides");
    visitor("minimum_side", o.minimum_side, "mean diameters", {1., 100.},
            "smallest side of a rectangular probe; half of it is the smallest radius of the circular probe");
    visitor(
      "probe_rectangles", o.probe_rectangles, "mean diameters, degrees", {-1e6, 1e6},
      "rectangular probes that replace the automatic ones, five numbers each: x and y of the centre from the sample's centre, "
      "length, thickness, angle of the length from the horizontal (anticlockwise); the others are compared with the first; "
      "empty: the detected band places the probes");
    visitor(
      "probe_circle", o.probe_circle, "mean diameters", {-1e6, 1e6},
      "circular probe: x and y of its centre from the sample's centre, then its radius; empty: the largest circle that fits "
      "around the band's middle");
    visitor("probe_block", o.probe_block, "mean diameters", {5., 100.},
            "smallest side of the blocks that are drawn with replacement for the 95 % intervals of the probes");
    visitor("probe_resamples", o.probe_resamples, "-", {0, 100000},
            "number of resamples for the 95 % intervals of the probes; below 40 there are none");
  }

  // Throws WrongKeys if probe_rectangles or probe_circle has a wrong number of values or a size <= 0.
  inline void check_probe_options(const ProbeOptions &options)
  {
    const std::vector<double> &rectangles = options.probe_rectangles, &circle = options.probe_circle;
    if (rectangles.size() % 5 != 0)
      throw discrete::WrongKeys({"comparison/probe_rectangles"},
                                "probe_rectangles: " + std::to_string(rectangles.size()) +
                                  " numbers; give five per probe: x, y, length, thickness, angle");
    for (std::size_t k = 0; k < rectangles.size(); k += 5)
      if (!(rectangles[k + 2] > 0 && rectangles[k + 3] > 0))
        throw discrete::WrongKeys({"comparison/probe_rectangles"}, "probe_rectangles: length and thickness of probe " +
                                                                     std::to_string(k / 5 + 1) + " must be above 0");
    if (!circle.empty() && circle.size() != 3)
      throw discrete::WrongKeys({"comparison/probe_circle"},
                                "probe_circle: " + std::to_string(circle.size()) + " numbers; give three: x, y, radius");
    if (!circle.empty() && !(circle[2] > 0))
      throw discrete::WrongKeys({"comparison/probe_circle"}, "probe_circle: the radius must be above 0");
  }
} // namespace diptych::coupling
