// diptych: values of an earlier mesh at the nodes and cells of a later, refined mesh
// SPDX-License-Identifier: LGPL-2.1-or-later
#include "coupling/fields/node_transfer.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>
#include <stdexcept>
#include <string>

#include <Eigen/LU>

#include "coupling/cells/triangle_search.h"

namespace diptych::coupling
{
  namespace
  {
    // Reference coordinates (xi, eta) in [-1, 1]^2 of the corners, in the order of Snapshot::cells.
    constexpr std::array<std::array<int, 2>, 9> corner_of = {
      {{{-1, -1}}, {{1, -1}}, {{1, 1}}, {{-1, 1}}, {{0, -1}}, {{1, 0}}, {{0, 1}}, {{-1, 0}}, {{0, 0}}}};

    // Quadratic Lagrange polynomial that is 1 at `node` (-1, 0 or 1) and 0 at the two others.
    double quadratic(const int node, const double x)
    {
      return node == 0 ? 1 - x * x : 0.5 * x * (x + node);
    }

    std::vector<Eigen::Vector2d> initial_places(const continuum::Snapshot &s)
    {
      std::vector<Eigen::Vector2d> places;
      for (std::size_t k = 0; k < s.position.size(); ++k)
        places.emplace_back(s.position[k] - s.displacement[k]);
      return places;
    }

    // Newton's iteration for x = sum_a (1 + xi xi_a)(1 + eta eta_a)/4 x_a. Edges are straight in the initial shape, also those of
    // divided cells.
    Eigen::Vector2d reference_place(const std::array<Eigen::Vector2d, 4> &corner, const Eigen::Vector2d &x)
    {
      Eigen::Vector2d r = Eigen::Vector2d::Zero();
      for (int iteration = 0; iteration < 20; ++iteration)
        {
          Eigen::Vector2d residual = x;
          Eigen::Matrix2d slope    = Eigen::Matrix2d::Zero();
          for (std::size_t a = 0; a < 4; ++a)
            {
              const auto [xi, eta] = corner_of[a];
              residual -= 0.25 * (1 + r.x() * xi) * (1 + r.y() * eta) * corner[a];
              slope.col(0) += 0.25 * xi * (1 + r.y() * eta) * corner[a];
              slope.col(1) += 0.25 * eta * (1 + r.x() * xi) * corner[a];
            }
          const Eigen::Vector2d step = slope.inverse() * residual;
          r += step;
          if (step.norm() < 1e-13)
            break;
        }
      return r;
    }

    bool same_places(const std::vector<Eigen::Vector2d> &a, const std::vector<Eigen::Vector2d> &b)
    {
      if (a.size() != b.size())
        return false;
      double size = 0, difference = 0;
      for (std::size_t k = 0; k < a.size(); ++k)
        {
          size       = std::max(size, b[k].cwiseAbs().maxCoeff());
          difference = std::max(difference, (a[k] - b[k]).norm());
        }
      return difference <= 1e-9 * size;
    }

    class InitialCells
    {
    public:
      InitialCells(const continuum::Snapshot &s, const std::vector<Eigen::Vector2d> &places)
          : mesh(initial_mesh(s, places)),
            search(mesh)
      {}

      unsigned int cell_at(const Eigen::Vector2d &x) const { return mesh.triangle[search.locate(x).triangle].cell; }

    private:
      static QuadMesh initial_mesh(const continuum::Snapshot &s, const std::vector<Eigen::Vector2d> &places)
      {
        continuum::Snapshot initial;
        initial.position = places;
        initial.cells    = s.cells;
        return quad_mesh(initial);
      }

      QuadMesh       mesh;
      TriangleSearch search;
    };

    // For each node of `to`, the nodes of `from` whose values it combines, with their weights.
    struct Interpolation
    {
      std::vector<std::array<unsigned int, 9>> node;
      std::vector<std::array<double, 9>>       weight;
    };

    Interpolation interpolation(const continuum::Snapshot &from, const std::vector<Eigen::Vector2d> &places)
    {
      const std::vector<Eigen::Vector2d> old_places = initial_places(from);
      const InitialCells                 initial(from, old_places);
      Interpolation                      result;
      for (const Eigen::Vector2d &x : places)
        {
          const auto           &cell = from.cells[initial.cell_at(x)];
          const Eigen::Vector2d r    = reference_place(
               {{old_places[cell[0]], old_places[cell[1]], old_places[cell[2]], old_places[cell[3]]}}, x);
          if (!(r.cwiseAbs().maxCoeff() < 1 + 1e-6))
            throw std::invalid_argument("a node of the later mesh, initially at (" + std::to_string(x.x()) + ", " +
                                        std::to_string(x.y()) + "), lies in no cell of the earlier mesh");
          result.node.push_back(cell);
          result.weight.emplace_back();
          for (std::size_t a = 0; a < 9; ++a)
            result.weight.back()[a] = quadratic(corner_of[a][0], r.x()) * quadratic(corner_of[a][1], r.y());
        }
      return result;
    }

    template <class Value>
    std::vector<Value> at_nodes_of(const continuum::Snapshot &from,
                                   const continuum::Snapshot &to,
                                   const std::vector<Value>  &values,
                                   const Value               &zero)
    {
      const std::vector<Eigen::Vector2d> places = initial_places(to);
      if (same_places(initial_places(from), places))
        return values;
      const Interpolation from_nodes = interpolation(from, places);
      std::vector<Value>  result(places.size(), zero);
      for (std::size_t k = 0; k < places.size(); ++k)
        for (std::size_t a = 0; a < 9; ++a)
          result[k] += from_nodes.weight[k][a] * values[from_nodes.node[k][a]];
      return result;
    }
  } // namespace

  std::vector<Eigen::Vector2d> displacement_at_nodes_of(const continuum::Snapshot &from, const continuum::Snapshot &to)
  {
    return at_nodes_of<Eigen::Vector2d>(from, to, from.displacement, Eigen::Vector2d::Zero());
  }

  std::vector<double> rotation_at_nodes_of(const continuum::Snapshot &from, const continuum::Snapshot &to)
  {
    return at_nodes_of<double>(from, to, from.rotation, 0);
  }

  std::vector<unsigned int> cells_of(const continuum::Snapshot &from, const continuum::Snapshot &to)
  {
    const std::vector<Eigen::Vector2d> old_places = initial_places(from), places = initial_places(to);
    std::vector<unsigned int>          cells(to.cells.size());
    if (same_places(old_places, places) && from.cells == to.cells)
      {
        std::iota(cells.begin(), cells.end(), 0);
        return cells;
      }
    const InitialCells initial(from, old_places);
    for (std::size_t k = 0; k < cells.size(); ++k)
      cells[k] = initial.cell_at(
        0.25 * (places[to.cells[k][0]] + places[to.cells[k][1]] + places[to.cells[k][2]] + places[to.cells[k][3]]));
    return cells;
  }
} // namespace diptych::coupling
