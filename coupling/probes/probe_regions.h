// diptych: places of the rectangular probes: in the band and in the packs on either side (Moreau 1997), or as given by the scene
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
    std::string                  name;          // "upper", "zone", "lower", or "probe 1", ... for probes of the scene
    std::vector<Eigen::Vector2d> polygon;       // corners, counter-clockwise [length]
    double                       angle_deg = 0; // angle of the side `length` from the horizontal
    bool                         is_zone   = false;
  };

  // Closed outline, counter-clockwise: left side downward, right side upward.
  std::vector<Eigen::Vector2d> outline_polygon(const discrete::Outline &outline);

  // Middle of the band's chord through the sample; none if the band's centre line misses the sample.
  std::optional<Eigen::Vector2d> band_middle(const std::vector<Eigen::Vector2d> &outline,
                                             const SampleFrame                  &frame,
                                             const Band                         &band);

  // The probes upper, zone and lower, in this order, inside the outline. The zone's rectangle lies along the first band and is
  // centred on its chord. It is as thick as the band's 10-90 % width, at most 0.3 of the chord. The packs' rectangles are
  // horizontal and do not touch the zone's. They are the largest that fit, up to the zone's area, and as far from it as possible.
  // Without bands there are three horizontal rectangles one above another. The polygon is empty if no rectangle of the minimum
  // side fits in a pack.
  // If options.probe_rectangles is given, its rectangles replace all three. Each is cut to the part inside the sample, which may
  // be empty. Throws as check_probe_options() does.
  std::vector<ProbeRegion> place_probes(const std::vector<Eigen::Vector2d> &outline,
                                        const SampleFrame                  &frame,
                                        const std::vector<Band>            &bands,
                                        const ProbeOptions                 &options = {});
} // namespace diptych::coupling
