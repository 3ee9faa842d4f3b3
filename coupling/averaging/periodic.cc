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
    constexpr int images[] = {0, -1, 1};

    struct Network
    {
      std::vector<Eigen::Vector2d>        position;
      std::vector<discrete::ContactForce> contacts;
    };

    double left_end(const QuadMesh &mesh)
    {
      double left = std::numeric_limits<double>::infinity();
      for (const Eigen::Vector2d &x : mesh.node)
        left = std::min(left, x.x());
      return left;
    }

    // Moves every grain and its contacts by whole periods to within one period of the mesh's left end.
    Network wrapped(Network network, const double period, const double left)
    {
      std::vector<double> move(network.position.size());
      for (std::size_t i = 0; i < move.size(); ++i)
        {
          move[i] = -period * std::floor((network.position[i].x() - left) / period);
          network.position[i].x() += move[i];
        }
      for (discrete::ContactForce &c : network.contacts)
        {
          c.point.x() += move.at(c.i);
          if (std::size_t(c.j) < move.size())
            c.shift += move[c.i] - move[c.j];
        }
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
      Ground(const QuadMesh &mesh, const double period, const Network &network)
          : Ground(mesh,
                   period,
                   period > 0 ? with_periodic_collar(mesh, period, branch_ends(network))
                              : with_collar(mesh, branch_ends(network)))
      {}

      CollaredMesh   cells;
      bool           has_collar;
      TriangleSearch search;

    private:
      Ground(const QuadMesh &mesh, const double period, std::optional<CollaredMesh> collared)
          : cells(collared ? *std::move(collared) : without_collar(mesh, period)),
            has_collar(cells.n_inner < cells.mesh.triangle.size()),
            search(cells.mesh)
      {}
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

  QuadMesh tiled(const QuadMesh &mesh, const double period)
  {
    QuadMesh result;
    for (const int image : images)
      {
        const unsigned int first = result.node.size(), first_cell = result.cell.size();
        for (const Eigen::Vector2d &x : mesh.node)
          result.node.emplace_back(x.x() + image * period, x.y());
        for (auto cell : mesh.cell)
          {
            for (unsigned int &node : cell)
              node += first;
            result.cell.push_back(cell);
          }
        for (auto triangle : mesh.triangle)
          {
            for (unsigned int &node : triangle.node)
              node += first;
            triangle.cell += first_cell;
            result.triangle.push_back(triangle);
          }
      }
    return result;
  }

  MappedGrains map_grains(const QuadMesh &mesh, const discrete::Snapshot &grains)
  {
    const double period = grains.cell_width;
    Network      network{grains.position, grains.window_forces};
    if (period > 0)
      network = wrapped(std::move(network), period, left_end(mesh));
    const Ground ground(mesh, period, network);
    const auto  &cells = ground.cells.mesh;
    MappedGrains result{map_segments(cells, ground.search, network.position, network.contacts), NAN, false};

    result.has_collar = ground.has_collar && result.moment.outside_weight == 0;
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
    const double period = grains.cell_width;
    Network      network{grains.position, grains.contacts};
    if (period > 0)
      network = wrapped(std::move(network), period, left_end(mesh));
    const Ground       ground(mesh, period, network);
    discrete::Snapshot last = grains;
    last.position           = std::move(network.position);
    last.contacts           = std::move(network.contacts);

    const MappedMoment mapped = map_segments(ground.cells.mesh, ground.search, last.position, last.contacts);
    if (!ground.has_collar || mapped.outside_weight > 0)
      return NAN;
    return relative_difference(ground, nodal_forces(ground.cells.mesh, mapped),
                               nodal_applied_forces(ground.cells.mesh, ground.search, last, acceleration), last.contacts);
  }

  CellCover grain_cover(const QuadMesh &mesh, const discrete::Snapshot &grains)
  {
    if (!(grains.cell_width > 0))
      return cell_cover(mesh, TriangleSearch(mesh), grains.position, grains.radius);
    const std::vector<Eigen::Vector2d> own = wrapped({grains.position, {}}, grains.cell_width, left_end(mesh)).position;
    std::vector<Eigen::Vector2d>       position;
    std::vector<double>                radius;
    for (const int image : images)
      {
        for (const Eigen::Vector2d &x : own)
          position.emplace_back(x.x() + image * grains.cell_width, x.y());
        radius.insert(radius.end(), grains.radius.begin(), grains.radius.end());
      }
    return cell_cover(mesh, TriangleSearch(mesh), position, radius);
  }
} // namespace diptych::coupling
