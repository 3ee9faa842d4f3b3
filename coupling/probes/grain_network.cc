// diptych: grains with their moments and contact forces for the probes, also in periodic samples
// SPDX-License-Identifier: LGPL-2.1-or-later
#include "coupling/probes/grain_network.h"

#include <stdexcept>

namespace diptych::coupling
{
  GrainNetwork grain_network(const discrete::Snapshot &s)
  {
    GrainNetwork network{s.position, s.radius, s.mean_internal_moment, s.window_forces, s.contacts, period_of(s)};
    if (!network.period.any())
      return network;
    const std::vector<Eigen::Vector2d> moves = network.period.wrap(s.outline.left.front(), network.position);
    follow_grains(moves, network.forces);
    follow_grains(moves, network.contacts);
    return network;
  }

  std::vector<Branch> branches(const std::vector<Eigen::Vector2d>        &position,
                               const std::vector<discrete::ContactForce> &contacts,
                               const Period                              &period)
  {
    const int           n      = static_cast<int>(position.size());
    const auto          copies = period.neighbours();
    std::vector<Branch> result;
    for (const auto &contact : contacts)
      {
        if (contact.i < 0 || contact.i >= n || contact.j < 0)
          throw std::invalid_argument("a contact joins a grain that does not exist");
        if (contact.force.isZero(0))
          continue;
        const Eigen::Vector2d image(contact.shift, contact.shift_y);
        const Eigen::Vector2d to = contact.j < n ? Eigen::Vector2d(position[contact.j] + image) : contact.point;
        result.push_back({position[contact.i], to, contact.force});
        for (const Eigen::Vector2d &shift : copies)
          result.push_back({position[contact.i] + shift, to + shift, contact.force});
      }
    return result;
  }
} // namespace diptych::coupling
