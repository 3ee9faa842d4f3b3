// diptych: contact networks in exact equilibrium under a known stress field
// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <cmath>
#include <functional>
#include <random>
#include <vector>

#include <Eigen/Core>

#include "coupling/averaging/power_cells.h"
#include "discrete/snapshot.h"

namespace diptych::benchmarks
{
  // Airy's function phi with its first and second derivatives at a point. Stress, positive in compression: xx = -phi,yy,
  // yy = -phi,xx, xy = phi,xy. It is in equilibrium without weight for every phi.
  struct Airy
  {
    double          value;
    Eigen::Vector2d gradient;
    Eigen::Matrix2d hessian;

    Eigen::Matrix2d stress() const
    {
      Eigen::Matrix2d s;
      s << -hessian(1, 1), hessian(0, 1), hessian(0, 1), -hessian(0, 0);
      return s;
    }
  };
  using AiryFunction = std::function<Airy(const Eigen::Vector2d &)>;

  // Pressure 1 with a wave, phi = -r^2/2 + a/k^2 cos(k x) cos(k y): the stress varies by a around 1, wave length 2 pi/k.
  inline AiryFunction pressure_wave(const double amplitude, const double wave_length)
  {
    return [a = amplitude, k = 2 * M_PI / wave_length](const Eigen::Vector2d &x) {
      const double cx = std::cos(k * x.x()), sx = std::sin(k * x.x()), cy = std::cos(k * x.y()), sy = std::sin(k * x.y());
      Airy         phi;
      phi.value    = -0.5 * x.squaredNorm() + a / (k * k) * cx * cy;
      phi.gradient = -x - a / k * Eigen::Vector2d(sx * cy, cx * sy);
      phi.hessian << -1 - a * cx * cy, a * sx * sy, a * sx * sy, -1 - a * cx * cy;
      return phi;
    };
  }

  struct AiryNetwork
  {
    std::vector<Eigen::Vector2d>        position;
    std::vector<double>                 radius;
    std::vector<discrete::ContactForce> contacts; // Body n_grains is the box around the grains.
  };

  enum class Faces
  {
    power_cells, // Power cells of the discs, as touching discs have them.
    voronoi      // Voronoi cells of the centres, independent of the radii.
  };

  // A box of discs of radius 0.3 to 0.7 and mean 0.5 on a shaken square lattice of spacing 1, each with a cell around it. The
  // force of a contact is what the stress transmits through the edge between two cells. Its point on the edge's line gives it
  // the moment of the stress. Forces and moments on every grain add up to zero to round-off.
  inline AiryNetwork airy_network(const Eigen::Vector2d &lower,
                                  const Eigen::Vector2d &upper,
                                  const AiryFunction    &phi,
                                  const std::uint64_t    seed,
                                  const Faces            faces = Faces::power_cells)
  {
    std::mt19937_64 random(seed);
    const auto      uniform = [&random](const double low, const double high) {
      return low + (high - low) * double(random() >> 11) * 0x1p-53;
    };
    AiryNetwork network;
    for (double y = lower.y() + 0.5; y < upper.y(); ++y)
      for (double x = lower.x() + 0.5; x < upper.x(); ++x)
        {
          const double dx = uniform(-0.25, 0.25), dy = uniform(-0.25, 0.25);
          network.position.emplace_back(x + dx, y + dy);
          network.radius.push_back(uniform(0.3, 0.7));
        }
    const int                 n = int(network.position.size());
    const std::vector<double> equal(network.radius.size(), 0.5);
    const auto cells = coupling::power_cells(network.position, faces == Faces::voronoi ? equal : network.radius, n, lower, upper);
    const auto cross = [](const Eigen::Vector2d &a, const Eigen::Vector2d &b) { return a.x() * b.y() - a.y() * b.x(); };
    for (int i = 0; i < n; ++i)
      for (std::size_t k = 0; k < cells[i].corner.size(); ++k)
        {
          const int j = cells[i].beyond[k] < 0 ? n : cells[i].beyond[k];
          if (j < i)
            continue;
          // Tractions along the edge: sigma n dl = d(phi,y, -phi,x) and x cross sigma n dl = d(phi - x . grad phi).
          const Eigen::Vector2d &a = cells[i].corner[k], &b = cells[i].corner[(k + 1) % cells[i].corner.size()], edge = b - a;
          const Airy             at_a = phi(a), at_b = phi(b);
          const Eigen::Vector2d  change = at_b.gradient - at_a.gradient, force(change.y(), -change.x());
          const double           moment = at_b.value - b.dot(at_b.gradient) - at_a.value + a.dot(at_a.gradient);
          const double           lever  = cross(edge, force);
          if (edge.norm() < 1e-9)
            continue;
          const double t = std::abs(lever) > 1e-12 * force.norm() * edge.norm() ? (moment - cross(a, force)) / lever : 0.5;
          network.contacts.push_back({i, j, a + t * edge, Eigen::Vector2d(-edge.y(), edge.x()) / edge.norm(), force});
        }
    return network;
  }
} // namespace diptych::benchmarks
