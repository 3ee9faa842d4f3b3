// diptych: nodal forces of side pressure and weight
// SPDX-License-Identifier: LGPL-2.1-or-later
#include "continuum/equilibrium/loads.h"

#include <array>
#include <cmath>

#include "continuum/mesh/mesh.h"

namespace diptych::continuum
{
  namespace
  {
    // Shape functions of an edge's nodes (ends, middle) and their slopes at xi in [-1, 1].
    struct EdgeShape
    {
      std::array<double, 3> value, slope;
      unsigned int          n;
    };

    EdgeShape edge_shape(const double xi, const bool has_middle)
    {
      if (has_middle)
        return {{xi * (xi - 1) / 2, xi * (xi + 1) / 2, 1 - xi * xi}, {xi - 0.5, xi + 0.5, -2 * xi}, 3};
      return {{(1 - xi) / 2, (1 + xi) / 2, 0}, {-0.5, 0.5, 0}, 2};
    }

    // Two Gauss points are exact, because the integrand is cubic in the coordinate along the edge.
    const std::array<double, 2> gauss_points = {-1 / std::sqrt(3.), 1 / std::sqrt(3.)};

    double inwards(const BoundaryEdge &edge)
    {
      return edge.id == left_side ? 1 : edge.id == right_side ? -1 : 0;
    }
  } // namespace

  void add_side_pressure(const Discretisation               &mesh,
                         const std::vector<Eigen::Vector2d> &node_position,
                         const double                        pressure,
                         std::vector<double>                &force)
  {
    for (const auto &edge : mesh.edges)
      if (inwards(edge) != 0)
        for (const double xi : gauss_points)
          {
            const auto shape = edge_shape(xi, mesh.reference.n_nodes > 4);
            double     dy    = 0;
            for (unsigned int k = 0; k < shape.n; ++k)
              dy += shape.slope[k] * node_position[edge.nodes[k]].y();
            for (unsigned int k = 0; k < shape.n; ++k)
              force[mesh.nodes[edge.nodes[k]].local[0]] += inwards(edge) * pressure * shape.value[k] * dy;
          }
  }

  void add_side_stiffness(const BoundaryEdge &edge,
                          const bool          has_middle,
                          const double        pressure,
                          const unsigned int  row_length,
                          double             *K)
  {
    for (const double xi : gauss_points)
      {
        const auto shape = edge_shape(xi, has_middle);
        for (unsigned int a = 0; a < shape.n; ++a)
          for (unsigned int b = 0; b < shape.n; ++b)
            K[2 * edge.in_cell[a] * row_length + 2 * edge.in_cell[b] + 1] += inwards(edge) * pressure * shape.value[a] *
                                                                             shape.slope[b];
      }
  }

  void add_body_force(const Discretisation  &mesh,
                      const Geometry        &geometry,
                      const Eigen::Vector2d &body_force,
                      std::vector<double>   &force)
  {
    for (std::size_t c = 0; c < mesh.cells.size(); ++c)
      for (unsigned int q = 0; q < mesh.reference.n_points; ++q)
        for (unsigned int node = 0; node < mesh.reference.n_nodes; ++node)
          for (unsigned int component = 0; component < 2; ++component)
            force[mesh.cells[c].local[2 * node + component]] += geometry.cells[c].points[q].area * mesh.reference.shape[q][node] *
                                                                body_force[component];
  }
} // namespace diptych::continuum
