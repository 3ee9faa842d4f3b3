// diptych: repetition of the grain sample along x or in both directions
// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <array>
#include <cmath>
#include <optional>
#include <variant>
#include <vector>

#include <Eigen/Core>
#include <Eigen/LU>

#include "discrete/bodies/time_table.h"

namespace diptych::discrete
{
  // An image of a grain: `along` widths or lattice vectors a1 and `upward` vectors a2 away, in all by `shift`.
  struct Image
  {
    int             along = 0, upward = 0;
    Eigen::Vector2d shift = Eigen::Vector2d::Zero();
  };

  // Each kind of periodicity answers the same questions. `nearest_image`: the image of a grain that is nearest to another one, at
  // `branch` from the grain itself. `least_extent`: smallest distance of a grain from its images, 0 without images [length].
  // `speed`: bound for the motion of an image relative to grains of diameter `d` beside it [length/time]. `drift` moves for a
  // time and carries the given places along. `stop` sets the state of rest.
  struct NoPeriod
  {
    Image  nearest_image(const Eigen::Vector2d &) const { return {}; }
    double least_extent() const { return 0; }
    double speed(double) const { return 0; }
    double kinetic_energy() const { return 0; }
    void   drift(double, std::vector<Eigen::Vector2d> &) {}
    void   stop() {}
  };

  // Along x (lateral = periodic). Grains keep their own abscissae.
  struct PeriodicWidth
  {
    double                width;         // [length]
    double                velocity = 0;  // d width / dt; constant unless the width is free
    std::optional<double> pressure = {}; // a free width is under this pressure x height; without a value the width is prescribed
    double                mass     = 1;  // inertia of a free width

    bool   moves() const { return pressure || velocity != 0; }
    double inverse_mass() const { return pressure ? 1 / mass : 0.; }

    Image nearest_image(const Eigen::Vector2d &branch) const
    {
      const int along = int(std::lround(branch.x() / width));
      return {along, 0, {along * width, 0}};
    }
    double least_extent() const { return width; }
    double speed(double) const { return std::abs(velocity); }
    double kinetic_energy() const { return pressure ? 0.5 * mass * velocity * velocity : 0.; }
    void   drift(const double duration, std::vector<Eigen::Vector2d> &) { width += duration * velocity; }
    void   stop() { velocity = 0; }
  };

  // Three controls of a lattice over time. A control is a linear form of the strains (exx, eyy, 2 exy) or of the stresses (sxx,
  // syy, sxy). No control may follow from the others.
  struct LatticeDrive
  {
    Eigen::Matrix3d          form      = Eigen::Matrix3d::Identity(); // one row per control
    std::array<bool, 3>      is_stress = {true, true, true};
    TableOf<Eigen::Vector3d> values    = {};
    Eigen::Matrix3d          inertia   = Eigen::Matrix3d::Identity(); // of the strains, symmetric [pressure x length^2 x time^2]
  };

  // In both directions (lateral = cell), without walls. Each grain has images at whole numbers of the lattice vectors. The
  // lattice deforms without turning: its velocity gradient is symmetric. Lattice and grains follow it; the velocity of a grain is
  // what it moves beyond.
  struct Lattice
  {
    Eigen::Matrix2d vectors;                          // columns a1 and a2, counter-clockwise [length]
    Eigen::Vector3d strain = Eigen::Vector3d::Zero(); // (exx, eyy, 2 exy), logarithmic, positive in compression
    Eigen::Vector3d rate   = Eigen::Vector3d::Zero(); // of the strain [1/time]
    LatticeDrive    drive  = {};

    double area() const { return vectors.determinant(); }

    // The nearest one for distances below half the least extent.
    Image nearest_image(const Eigen::Vector2d &branch) const
    {
      const Eigen::Matrix2d &a     = vectors;
      const int              along = int(std::lround((branch.x() * a(1, 1) - branch.y() * a(0, 1)) / area())),
                upward             = int(std::lround((a(0, 0) * branch.y() - a(1, 0) * branch.x()) / area()));
      return {along, upward, along * a.col(0) + upward * a.col(1)};
    }
    double least_extent() const; // the smaller height of the parallelogram
    double speed(const double d) const { return rate.norm() * 2 * d; }
    double kinetic_energy() const { return 0.5 * rate.dot(drive.inertia * rate); }
    void   drift(double duration, std::vector<Eigen::Vector2d> &position);
    void   stop(); // the strain counts from a state of rest
  };

  using Periodicity = std::variant<NoPeriod, PeriodicWidth, Lattice>;

  // Velocity gradient of a rate of strain (positive in compression) [1/time].
  inline Eigen::Matrix2d velocity_gradient(const Eigen::Vector3d &rate)
  {
    return (Eigen::Matrix2d() << -rate[0], -0.5 * rate[2], -0.5 * rate[2], -rate[1]).finished();
  }
} // namespace diptych::discrete
