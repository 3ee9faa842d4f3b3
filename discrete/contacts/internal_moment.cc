// diptych: Moreau's internal moment of every grain
// SPDX-License-Identifier: LGPL-2.1-or-later
#include "discrete/contacts/internal_moment.h"

#include <cmath>
#include <limits>

namespace diptych::discrete
{
  std::vector<Eigen::Matrix2d> raw_contact_moments(const std::vector<Eigen::Vector2d> &position,
                                                   const std::vector<ContactForce>    &forces)
  {
    std::vector<Eigen::Matrix2d> moment(position.size(), Eigen::Matrix2d::Zero());
    for (const ContactForce &c : forces)
      {
        const Eigen::Matrix2d couple{{0, 0.5 * c.acting_couple()},
                                     {-0.5 * c.acting_couple(), 0}}; // l f^T has the couple l_x f_y - l_y f_x
        moment[c.i] -= (c.point - position[c.i]) * c.force.transpose() + couple;
        if (std::size_t(c.j) < position.size())
          moment[c.j] += (c.point - position[c.j] - Eigen::Vector2d(c.shift, c.shift_y)) * c.force.transpose() + couple;
      }
    return moment;
  }

  std::vector<Eigen::Matrix2d> internal_moments(const std::vector<Eigen::Vector2d> &position,
                                                const std::vector<ContactForce>    &forces,
                                                const std::vector<double>          &spin_term)
  {
    std::vector<Eigen::Matrix2d> moment = raw_contact_moments(position, forces);
    for (std::size_t i = 0; i < moment.size(); ++i)
      moment[i] = (0.5 * (moment[i] + moment[i].transpose()) - spin_term[i] * Eigen::Matrix2d::Identity()).eval();
    return moment;
  }

  std::vector<double> spin_terms(const Grains &grains)
  {
    std::vector<double> term(grains.size());
    for (std::size_t i = 0; i < term.size(); ++i)
      term[i] = 0.5 * grains.spin[i] * grains.spin[i] * grains.moment_of_inertia(i);
    return term;
  }

  double stress_ratio(const Eigen::Matrix2d &stress)
  {
    const double s = 0.5 * (stress(0, 0) + stress(1, 1));
    const double t = std::hypot(0.5 * (stress(0, 0) - stress(1, 1)), 0.5 * (stress(0, 1) + stress(1, 0)));
    return s > 0 ? t / s : std::numeric_limits<double>::quiet_NaN();
  }
} // namespace diptych::discrete
