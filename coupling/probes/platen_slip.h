// diptych: traction and slip along a platen, and the friction law of the pair
// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <vector>

#include "coupling/statistics/interval.h"
#include "discrete/snapshot.h"

namespace diptych::coupling
{
  // A grain or a node of the continuum that presses on a platen, in a window between two instants.
  struct PlatenContact
  {
    double x;             // at the end [length]
    double normal, shear; // force on the sample: inwards; to the right [pressure * length]
    double slip;          // displacement to the right relative to the platen, per unit progress [length]
  };

  // Grains: mean forces of the window, and the displacement of the centre, because grains roll along a platen. Glued grains of
  // a platen do not count.
  std::vector<PlatenContact> platen_contacts(const discrete::Snapshot &from, const discrete::Snapshot &to, bool upper);

  // Equal parts of both platens together. Turned by half a turn, the upper platen is the lower one.
  struct PlatenPart
  {
    double normal = 0, shear = 0; // sums of the forces [pressure * length]
    double slip = 0;              // mean, weighted with the normal forces [length per unit progress]
  };
  struct PlatenFrame
  {
    double middle, half_width;  // of the platens [length]
    bool   is_mirror_symmetric; // then the left half is the right one, mirrored; parts count from the middle
  };
  std::vector<PlatenPart> platen_parts(const std::vector<PlatenContact> &lower,
                                       const std::vector<PlatenContact> &upper,
                                       const PlatenFrame                &frame,
                                       int                               n_parts);

  // shear / normal = -friction tanh(v / (friction slip_length)) for the slip v, as in continuum/platens = frictional.
  struct PlatenFriction
  {
    Interval friction;    // [-]
    Interval slip_length; // [length]
  };

  // Fits the law to the means over several windows of the same parts, by least squares weighted with the normal forces. The slip
  // of few grains is too uncertain for a fit to single windows. Intervals of 95 %: jackknife over the windows (NaN for one). NaN
  // if nothing slips.
  PlatenFriction platen_friction(const std::vector<std::vector<PlatenPart>> &windows);

  // Of the grains, from the windows between successive snapshots, in ten parts of a platen or of its half.
  PlatenFriction platen_friction(const std::vector<discrete::Snapshot> &snapshots, bool is_mirror_symmetric);
} // namespace diptych::coupling
