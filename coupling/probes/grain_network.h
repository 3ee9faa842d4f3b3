// diptych: grains with their moments and contact forces for the probes, also in periodic samples
// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <vector>

#include <Eigen/Core>

#include "coupling/cells/period.h"
#include "discrete/snapshot.h"

namespace diptych::coupling
{
  struct GrainNetwork
  {
    std::vector<Eigen::Vector2d> position; // [length]
    std::vector<double>          radius;   // [length]
    std::vector<Eigen::Matrix2d> moment;   // internal moments, positive in compression [pressure * length^2]

    std::vector<discrete::ContactForce> forces;   // means since the preceding snapshot
    std::vector<discrete::ContactForce> contacts; // at the instant of the snapshot
    Period                              period = {};
  };

  // Moments and forces are means since the preceding snapshot. In a periodic sample, whole periods move grains and contact
  // points into the outline.
  GrainNetwork grain_network(const discrete::Snapshot &snapshot);

  // The line along which a contact transmits its force. It runs from the centre of grain i to that of j (or of its image that
  // touches i). At a platen or wall it ends at the contact point.
  struct Branch
  {
    Eigen::Vector2d from, to; // [length]
    Eigen::Vector2d force;    // force on the body at `from` [pressure * length]
  };

  // Branches of the contacts that carry force. In a periodic sample each branch also at its surrounding copies.
  // Throws std::invalid_argument if a contact joins a grain that does not exist.
  std::vector<Branch> branches(const std::vector<Eigen::Vector2d>        &position,
                               const std::vector<discrete::ContactForce> &contacts,
                               const Period                              &period = {});
} // namespace diptych::coupling
