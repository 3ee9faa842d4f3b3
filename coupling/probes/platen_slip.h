// diptych: traction and slip along a platen, and the friction law of the pair
// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <vector>

#include "continuum/snapshot.h"
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

  struct PlatenContacts
  {
    std::vector<PlatenContact> lower, upper;
  };

  // Grains: mean forces of the window, and the displacement of the centre, because grains roll along a platen. Glued grains of
  // a platen do not count.
  PlatenContacts platen_contacts(const discrete::Snapshot &from, const discrete::Snapshot &to);

  // Nodes: forces at the end of the window. travel: displacement of the upper platen to the right in the window [length].
  PlatenContacts platen_contacts(const continuum::Snapshot &from, const continuum::Snapshot &to, double travel);

  // A platen is divided into equal parts between its outermost contacts. A part adds both platens: the upper one, turned by half
  // a turn, lies on the lower one. In a mirror-symmetric test it also adds the left half, mirrored, to the right half.
  struct PlatenPart
  {
    double place  = 0;            // from the middle of the platen to the middle of the part [half widths]
    double normal = 0, shear = 0; // sums of the forces [pressure * length]
    double slip = 0;              // mean, weighted with the normal forces [length per unit progress]
  };
  using PlatenParts = std::vector<PlatenPart>;
  PlatenParts platen_parts(const PlatenContacts &contacts, bool is_mirror_symmetric, int n_parts);
  PlatenParts sum_of(const std::vector<PlatenParts> &windows);

  // shear / normal = -friction tanh(v / (friction slip_length)) for the slip v, as in continuum/platens = frictional.
  struct PlatenFriction
  {
    Interval friction;    // [-]
    Interval slip_length; // [length]
  };

  // Fits the law to the means over several windows or samples, by least squares weighted with the normal forces. The slip
  // of few grains is too uncertain for a fit to single windows. The 95 % intervals come from a jackknife over the windows or
  // samples and are NaN for a single one. All values are NaN if nothing slips, or if the traction does
  // not bend over the slip.
  PlatenFriction platen_friction(const std::vector<PlatenParts> &windows);
} // namespace diptych::coupling
