// diptych: grains and contact forces of a snapshot as grids for ParaView
// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include "discrete/files/vtu_file.h"
#include "discrete/snapshot.h"

namespace diptych::discrete
{
  // A vertex at each centre, with the grain's fields (snapshot_fields.h; moments and forces excepted) and `mean_stress`: half the
  // trace of its internal moment over the area of the disc [pressure]. Fields that an imported frame lacks are left out.
  VtuGrid grains_of(const Snapshot &s);

  // A line for each contact that carries force in the last step: from the centre of the first grain to that of the second, or to
  // the contact point on a wall. Both ends have the values of the contact: normal_force (positive in compression),
  // tangential_force (along the normal turned by +90 degrees), gap and status.
  VtuGrid contacts_of(const Snapshot &s);
} // namespace diptych::discrete
