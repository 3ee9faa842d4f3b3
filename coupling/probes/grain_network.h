// diptych: grains with their moments and contact forces as the probes see them, across the edge of a periodic sample, too
// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <vector>

#include <Eigen/Core>

#include "discrete/snapshot.h"

namespace diptych::coupling
{
  struct GrainNetwork
  {
    // n_grains entries each
    std::vector<Eigen::Vector2d> position; // [length]
    std::vector<double>          radius;   // [length]
    std::vector<Eigen::Matrix2d> moment;   // internal moments, positive in compression [pressure * length^2]

    std::vector<discrete::ContactForce> forces;   // means over the window
    std::vector<discrete::ContactForce> contacts; // of the instant
    double                              period = 0;
  };

  // Moments and forces are the means over the window. Grains of a periodic sample, with the points of their contacts, are
  // moved by whole periods to within half a period of the outline's middle.
  GrainNetwork grain_network(const discrete::Snapshot &snapshot);

  // The line along which a contact transmits its force: from the centre of grain i to that of j (or of the image of it that
  // touches i), or to the contact point at a platen or wall.
  struct Branch
  {
    Eigen::Vector2d from, to; // [length]
    Eigen::Vector2d force;    // on what lies at `from` [pressure * length]
  };

  // Of the contacts that bear force. period > 0: each three times, one period to the left and to the right, too. Throws
  // std::invalid_argument where a contact names a grain that does not exist.
  std::vector<Branch> branches(const std::vector<Eigen::Vector2d>        &position,
                               const std::vector<discrete::ContactForce> &contacts,
                               double                                     period = 0);
} // namespace diptych::coupling
