// diptych: bodies of the discrete panel
// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <vector>

#include <Eigen/Core>

namespace diptych::discrete
{
  // Rigid discs of unit thickness. One entry per grain in every vector.
  struct Grains
  {
    std::vector<Eigen::Vector2d> position; // at the end of the last step [length]
    std::vector<Eigen::Vector2d> velocity; // [length/time]
    std::vector<double>          rotation; // counter-clockwise [rad]
    std::vector<double>          spin;     // counter-clockwise [rad/time]
    std::vector<double>          radius;   // [length]
    std::vector<double>          mass;     // rho pi r^2, per unit thickness

    std::size_t size() const { return radius.size(); }

    // I = m r^2 / 2 of a disc about its centre.
    double moment_of_inertia(const std::size_t i) const { return 0.5 * mass[i] * radius[i] * radius[i]; }
  };

  // Adds a grain at rest.
  inline void add_grain(Grains &grains, const Eigen::Vector2d &position, const double radius, const double density)
  {
    grains.position.push_back(position);
    grains.velocity.push_back(Eigen::Vector2d::Zero());
    grains.rotation.push_back(0.);
    grains.spin.push_back(0.);
    grains.radius.push_back(radius);
    grains.mass.push_back(density * M_PI * radius * radius);
  }

  // Straight rigid wall or platen: the half plane behind `point`, moving with a prescribed velocity.
  struct Wall
  {
    Eigen::Vector2d point;  // any point of its surface [length]
    Eigen::Vector2d normal; // unit, into the sample
    Eigen::Vector2d velocity = Eigen::Vector2d::Zero();
  };

  // Impulse of a pair, kept from one step to the next as first guess. Walls are bodies n_grains, n_grains + 1, ...
  struct PairImpulse
  {
    int    i, j; // i < j
    double normal, tangential;
  };

  struct State
  {
    Grains                   grains;
    std::vector<Wall>        walls;    // a sample between platens has walls[0] below and walls[1] above
    std::vector<PairImpulse> impulses; // of the last step, ascending in (i, j)
    double                   time = 0;
  };
} // namespace diptych::discrete
