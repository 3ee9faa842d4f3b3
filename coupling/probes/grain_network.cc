// diptych: grains with their moments and contact forces for the probes, also in periodic samples
// SPDX-License-Identifier: LGPL-2.1-or-later
#include "coupling/probes/grain_network.h"

#include <cmath>
#include <stdexcept>

namespace diptych::coupling
{
  namespace
  {
    // If i and j move by different numbers of periods, another image of j touches i.
    void follow_grains(const std::vector<double> &moved, std::vector<discrete::ContactForce> &contacts)
    {
      for (discrete::ContactForce &contact : contacts)
        {
          const double of_i = moved.at(contact.i);
          contact.point.x() += of_i;
          if (contact.j < static_cast<int>(moved.size()))
            contact.shift += of_i - moved[contact.j];
        }
    }
  } // namespace

  GrainNetwork grain_network(const discrete::Snapshot &s)
  {
    GrainNetwork network{s.position, s.radius, s.mean_internal_moment, s.window_forces, s.contacts, s.cell_width};
    if (!(s.cell_width > 0))
      return network;
    const double        middle = 0.5 * (s.outline.left.front().x() + s.outline.right.front().x());
    std::vector<double> moved;
    for (Eigen::Vector2d &x : network.position)
      {
        moved.push_back(-s.cell_width * std::round((x.x() - middle) / s.cell_width));
        x.x() += moved.back();
      }
    follow_grains(moved, network.forces);
    follow_grains(moved, network.contacts);
    return network;
  }

  std::vector<Branch> branches(const std::vector<Eigen::Vector2d>        &position,
                               const std::vector<discrete::ContactForce> &contacts,
                               const double                               period)
  {
    const int           n = static_cast<int>(position.size());
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
        if (period > 0)
          for (const double x : {-period, period})
            result.push_back({position[contact.i] + Eigen::Vector2d(x, 0), to + Eigen::Vector2d(x, 0), contact.force});
      }
    return result;
  }
} // namespace diptych::coupling
