// diptych: where the rectangular probes lie: in the zone and in the packs on either side (Moreau 1997), or as the scene says
// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <string>
#include <vector>

#include <Eigen/Core>

#include "coupling/bands/band.h"
#include "coupling/cells/polygon.h"
#include "coupling/probes/probe_options.h"
#include "discrete/snapshot.h"

namespace diptych::coupling
{
  struct ProbeRegion
  {
    std::string                  name;          // "upper", "zone", "lower"; "probe 1", ... where the scene gives them
    std::vector<Eigen::Vector2d> polygon;       // corners, counter-clockwise [length]
    double                       angle_deg = 0; // of its sides of length, from the horizontal
    bool                         is_zone   = false;
  };

  // Closed outline, counter-clockwise: left side downward, right side upward.
  std::vector<Eigen::Vector2d> outline_polygon(const discrete::Outline &outline);

  // Middle of the band's chord through the sample; none where the band's middle line misses the sample.
  std::optional<Eigen::Vector2d> band_middle(const std::vector<Eigen::Vector2d> &outline,
                                             const SampleFrame                  &frame,
                                             const Band                         &band);

  // upper, zone, lower, in this order, inside the outline. The zone's is oblique, centred on the middle of the first band's
  // chord, as thick as the band's 10-90 % width up to 0.3 of the chord; the packs' are horizontal, the largest up to the zone's
  // area that clear it, as far from it as they go. bands empty: three horizontal rectangles one above another. A pack for which
  // no rectangle of the minimum side fits has an empty polygon. options.probe_rectangles in the place of them all: what of each
  // lies in the sample, empty where nothing does. Throws as check_probe_options().
  std::vector<ProbeRegion> place_probes(const std::vector<Eigen::Vector2d> &outline,
                                        const SampleFrame                  &frame,
                                        const std::vector<Band>            &bands,
                                        const ProbeOptions                 &options = {});
} // namespace diptych::coupling
