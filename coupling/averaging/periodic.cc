// diptych: maps the grains of one stage onto cells, also in periodic samples
// SPDX-License-Identifier: LGPL-2.1-or-later
#include "coupling/averaging/periodic.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "coupling/averaging/collar.h"

namespace diptych::coupling
{
  namespace
  {
    struct Network
    {
      std::vector<Eigen::Vector2d>        position;
      std::vector<discrete::ContactForce> contacts;
    };

    // Corner from which the fractions of a place in the mesh are counted.
    Eigen::Vector2d lower_corner(const QuadMesh &mesh, const Period &period)
    {
      Eigen::Vector2d lower = mesh.node.front(), upper = lower;
      for (const Eigen::Vector2d &x : mesh.node)
        {
          lower = lower.cwiseMin(x);
          upper = upper.cwiseMax(x);
        }
      return period.both() ? Eigen::Vector2d(0.5 * (lower + upper - period.vectors.rowwise().sum())) : lower;
    }

    // The grains of a periodic sample and their contacts, moved by whole periods into the mesh.
    Network network_in(const QuadMesh                     &mesh,
                       const Period                       &period,
                       const std::vector<Eigen::Vector2d> &position,
                       std::vector<discrete::ContactForce> contacts)
    {
      Network network{position, std::move(contacts)};
      if (period.any())
        follow_grains(period.wrap(lower_corner(mesh, period), network.position), network.contacts);
      return network;
    }

    std::vector<Eigen::Vector2d> branch_ends(const Network &network)
    {
      std::vector<Eigen::Vector2d> points;
      std::vector<bool>            bears(network.position.size(), false);
      for (const auto &c : network.contacts)
        if (!c.force.isZero(0))
          {
            points.push_back(c.point);
            bears.at(c.i) = true;
            if (std::size_t(c.j) < bears.size())
              bears[c.j] = true;
          }
      for (std::size_t i = 0; i < bears.size(); ++i)
        if (bears[i])
          points.push_back(network.position[i]);
      return points;
    }

    struct Ground
    {
      Ground(const QuadMesh &mesh, const Period &period, const Network &network)
          : cells(ground_of(mesh, period, branch_ends(network))),
            search(cells.mesh)
      {}

      CollaredMesh   cells;
      TriangleSearch search;
    };

    // Largest difference at any node between the two sides of the nodal identity / largest contact force.
    double relative_difference(const Ground                              &ground,
                               const std::vector<Eigen::Vector2d>        &stress_side,
                               const std::vector<Eigen::Vector2d>        &force_side,
                               const std::vector<discrete::ContactForce> &contacts)
    {
      double force = 0;
      for (const auto &c : contacts)
        force = std::max(force, c.force.norm());
      return force > 0 ? largest_difference(ground.cells, stress_side, force_side) / force : NAN;
    }

    // Adds the moments of the images and of the collar to the mesh's own triangles.
    MappedMoment folded(const MappedMoment &mapped, const CollaredMesh &cells, const std::size_t n_triangles)
    {
      MappedMoment result = mapped;
      result.triangle_moment.assign(n_triangles, Eigen::Matrix2d::Zero());
      result.triangle_weight.assign(n_triangles, 0.);
      for (std::size_t t = 0; t < mapped.triangle_moment.size(); ++t)
        {
          result.triangle_moment[cells.receiver[t]] += mapped.triangle_moment[t];
          (t < cells.n_inner ? result.triangle_weight[cells.receiver[t]] : result.outside_weight) += mapped.triangle_weight[t];
        }
      result.outside_share = outside_share(result);
      return result;
    }
  } // namespace

  MappedGrains map_grains(const QuadMesh &mesh, const discrete::Snapshot &grains)
  {
    const Period  period  = period_of(grains);
    const Network network = network_in(mesh, period, grains.position, grains.window_forces);
    const Ground  ground(mesh, period, network);
    const auto   &cells = ground.cells.mesh;
    MappedGrains  result{map_segments(cells, ground.search, network.position, network.contacts), NAN, false};

    result.has_collar = ground.cells.is_closed && result.moment.outside_weight == 0;
    if (result.has_collar)
      result.nodal_residual = relative_difference(ground, nodal_forces(cells, result.moment),
                                                  nodal_contact_forces(cells, ground.search, network.position, network.contacts),
                                                  network.contacts);
    add_spin_term(ground.search, network.position, grains.mean_spin_term, result.moment);
    result.moment = folded(result.moment, ground.cells, mesh.triangle.size());
    return result;
  }

  double momentum_residual(const QuadMesh                     &mesh,
                           const discrete::Snapshot           &grains,
                           const std::vector<Eigen::Vector2d> &acceleration)
  {
    const Period       period  = period_of(grains);
    Network            network = network_in(mesh, period, grains.position, grains.contacts);
    const Ground       ground(mesh, period, network);
    discrete::Snapshot last = grains;
    last.position           = std::move(network.position);
    last.contacts           = std::move(network.contacts);

    const MappedMoment mapped = map_segments(ground.cells.mesh, ground.search, last.position, last.contacts);
    if (!ground.cells.is_closed || mapped.outside_weight > 0)
      return NAN;
    return relative_difference(ground, nodal_forces(ground.cells.mesh, mapped),
                               nodal_applied_forces(ground.cells.mesh, ground.search, last, acceleration), last.contacts);
  }

  CellCover grain_cover(const QuadMesh              &mesh,
                        const Period                &period,
                        std::vector<Eigen::Vector2d> position,
                        std::vector<double>          radius)
  {
    if (period.any())
      (void)period.wrap(lower_corner(mesh, period), position);
    const std::size_t n = position.size();
    for (const Eigen::Vector2d &shift : period.neighbours())
      for (std::size_t i = 0; i < n; ++i)
        {
          position.emplace_back(position[i] + shift);
          radius.push_back(radius[i]);
        }
    return cell_cover(mesh, TriangleSearch(mesh), position, radius);
  }

  CellCover grain_cover(const QuadMesh &mesh, const discrete::Snapshot &grains)
  {
    return grain_cover(mesh, period_of(grains), grains.position, grains.radius);
  }
} // namespace diptych::coupling
