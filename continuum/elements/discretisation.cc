// diptych: unknowns, nodes and edges of a quadrilateral mesh that may be distributed and refined
// SPDX-License-Identifier: LGPL-2.1-or-later
#include "continuum/elements/discretisation.h"

#include <cmath>
#include <limits>
#include <map>

#include <deal.II/base/mpi.h>
#include <deal.II/dofs/dof_tools.h>
#include <deal.II/fe/fe_q.h>
#include <deal.II/fe/mapping_q1.h>
#include <deal.II/grid/grid_tools.h>

namespace diptych::continuum
{
  using namespace dealii;

  namespace
  {
    // Nodes on the four edges of a cell (left, right, lower, upper): lower or left end, upper or right end, midpoint.
    constexpr unsigned int edge_nodes[4][3] = {{0, 2, 4}, {1, 3, 5}, {0, 1, 6}, {2, 3, 7}};

    FESystem<2> make_element(const ElementKind kind)
    {
      return with_element(kind, [](const auto chosen) {
        if constexpr (chosen.n_rotations > 0)
          return FESystem<2>(FE_Q<2>(chosen.degree), 2, FE_Q<2>(1), 1);
        else
          return FESystem<2>(FE_Q<2>(chosen.degree), 2);
      });
    }

    // Creates the triangulation as deal.II's reader of mesh files does.
    void create(const QuadMesh &mesh, Triangulation<2> &triangulation)
    {
      std::vector<Point<2>> vertices;
      for (const Eigen::Vector2d &p : mesh.vertices)
        vertices.emplace_back(p.x(), p.y());
      std::vector<CellData<2>> cells;
      for (const auto &cell : mesh.cells)
        {
          cells.emplace_back();
          for (unsigned int k = 0; k < 4; ++k)
            cells.back().vertices[GeometryInfo<2>::ucd_to_deal[k]] = cell[k];
        }
      SubCellData lines;
      for (const auto &edge : mesh.boundary)
        {
          lines.boundary_lines.emplace_back();
          lines.boundary_lines.back().vertices    = {edge.vertices[0], edge.vertices[1]};
          lines.boundary_lines.back().boundary_id = edge.id;
        }
      GridTools::consistently_order_cells(cells);
      triangulation.create_triangulation(vertices, cells, lines);
    }

    // `position_of` a node of the mesh, by its number.
    template <class Position>
    Tensor<2, 2> jacobian(const ReferenceElement &reference, const unsigned int q, const Cell &cell, const Position &position_of)
    {
      Tensor<2, 2> J;
      for (unsigned int node = 0; node < reference.n_nodes; ++node)
        for (unsigned int i = 0; i < 2; ++i)
          J[i] += position_of(cell.nodes[node])[i] * reference.gradient[q][node];
      return J;
    }

    CellGeometry cell_geometry(const Discretisation &mesh, const Cell &cell, const std::vector<Eigen::Vector2d> &x)
    {
      const auto  &reference = mesh.reference;
      const auto   now       = [&](const unsigned int node) -> const Eigen::Vector2d         &{ return x[node]; };
      const auto   initial   = [&](const unsigned int node) -> const Eigen::Vector2d     &{ return mesh.nodes[node].initial; };
      CellGeometry geometry;
      double       area = 0;
      for (unsigned int q = 0; q < reference.n_points; ++q)
        {
          auto              &point     = geometry.points[q];
          const Tensor<2, 2> J         = jacobian(reference, q, cell, now);
          const Tensor<2, 2> inverse_t = transpose(invert(J));
          // Helmholtz's equation of a gradient law stays on the initial shape, where its length is that of the material.
          const Tensor<2, 2> corner_inverse_t = mesh.kind == ElementKind::q2_gradient
                                                  ? transpose(invert(jacobian(reference, q, cell, initial)))
                                                  : inverse_t;
          point.area                          = determinant(J) * reference.weights[q];
          area += point.area;
          for (unsigned int node = 0; node < reference.n_nodes; ++node)
            {
              point.gradient[node] = inverse_t * reference.gradient[q][node];
              geometry.mean_gradient[node] += point.area * point.gradient[node];
            }
          for (unsigned int corner = 0; corner < reference.n_rotations; ++corner)
            point.rotation_gradient[corner] = corner_inverse_t * reference.rotation_gradient[q][corner];
        }
      for (auto &gradient : geometry.mean_gradient)
        gradient /= area;
      return geometry;
    }
  } // namespace

  Discretisation::Discretisation(const QuadMesh   &mesh,
                                 const ElementKind kind,
                                 const MPI_Comm    communicator,
                                 const CheckStop  &check_stop)
      : triangulation(communicator),
        kind(kind),
        reference(kind),
        element(make_element(kind)),
        dof_handler(triangulation)
  {
    create(mesh, triangulation);
    call(check_stop);
    distribute(check_stop);
    measure();
  }

  void Discretisation::distribute(const CheckStop &check_stop)
  {
    dof_handler.distribute_dofs(element);
    call(check_stop);
    owned = dof_handler.locally_owned_dofs();
    DoFTools::extract_locally_relevant_dofs(dof_handler, relevant);
    cells.clear();
    nodes.clear();
    edges.clear();
    number_nodes();
    call(check_stop);
    number_locally();
    collect_edges();
  }

  void Discretisation::add_relevant(const std::vector<types::global_dof_index> &dofs)
  {
    for (const auto dof : dofs)
      relevant.add_index(dof);
    relevant.compress();
    number_locally();
  }

  void Discretisation::number_locally()
  {
    for (auto &cell : cells)
      for (unsigned int i = 0; i < reference.n_dofs; ++i)
        cell.local[i] = relevant.index_within_set(cell.dofs[i]);
    for (auto &node : nodes)
      {
        for (unsigned int c = 0; c < 2; ++c)
          node.local[c] = relevant.index_within_set(node.dofs[c]);
        if (node.rotation != numbers::invalid_dof_index)
          node.local_rotation = relevant.index_within_set(node.rotation);
      }
  }

  void Discretisation::number_nodes()
  {
    std::vector<types::global_dof_index>            dofs(reference.n_dofs);
    std::map<types::global_dof_index, unsigned int> node_of_dof; // key: dof of the x component
    const Mapping<2>                               &mapping = get_default_linear_mapping(triangulation);
    for (const auto &active : dof_handler.active_cell_iterators())
      if (active->is_locally_owned())
        {
          active->get_dof_indices(dofs);
          Cell cell;
          for (unsigned int node = 0; node < reference.n_nodes; ++node)
            for (unsigned int c = 0; c < 2; ++c)
              cell.dofs[2 * node + c] = dofs[element.component_to_system_index(c, node)];
          for (unsigned int corner = 0; corner < reference.n_rotations; ++corner)
            cell.dofs[2 * reference.n_nodes + corner] = dofs[element.component_to_system_index(2, corner)];
          for (unsigned int node = 0; node < reference.n_nodes; ++node)
            {
              const auto [entry, is_new] = node_of_dof.try_emplace(cell.dofs[2 * node], nodes.size());
              cell.nodes[node]           = entry->second;
              if (!is_new)
                continue;
              const Point<2> p = mapping.transform_unit_to_real_cell(active, reference.nodes[node]);
              nodes.push_back({{p[0], p[1]}, {cell.dofs[2 * node], cell.dofs[2 * node + 1]}});
              if (node < reference.n_rotations)
                nodes.back().rotation = cell.dofs[2 * reference.n_nodes + node];
            }
          cells.push_back(cell);
        }
  }

  void Discretisation::collect_edges()
  {
    auto cell = cells.begin();
    for (const auto &active : dof_handler.active_cell_iterators())
      if (active->is_locally_owned())
        {
          for (const unsigned int face : active->face_indices())
            if (active->face(face)->at_boundary())
              {
                const auto  &n = edge_nodes[face];
                BoundaryEdge edge{active->face(face)->boundary_id(),
                                  {cell->nodes[n[0]], cell->nodes[n[1]], 0},
                                  std::size_t(cell - cells.begin()),
                                  {n[0], n[1], n[2]}};
                if (reference.n_nodes > 4)
                  edge.nodes[2] = cell->nodes[n[2]];
                const Eigen::Vector2d along = nodes[edge.nodes[1]].initial - nodes[edge.nodes[0]].initial;
                // Cells from gmsh have any orientation.
                if (std::abs(along.y()) > std::abs(along.x()) ? along.y() < 0 : along.x() < 0)
                  {
                    std::swap(edge.nodes[0], edge.nodes[1]);
                    std::swap(edge.in_cell[0], edge.in_cell[1]);
                  }
                edges.push_back(edge);
              }
          ++cell;
        }
  }

  void Discretisation::measure()
  {
    constexpr double huge = std::numeric_limits<double>::max();
    Eigen::Vector2d  low(huge, huge), high(-huge, -huge);
    for (const auto &node : nodes)
      {
        low  = low.cwiseMin(node.initial);
        high = high.cwiseMax(node.initial);
      }
    for (unsigned int c = 0; c < 2; ++c)
      {
        origin[c] = Utilities::MPI::min(low[c], communicator());
        extent[c] = Utilities::MPI::max(high[c], communicator()) - origin[c];
      }
  }

  std::vector<Node> Discretisation::boundary_nodes(const unsigned int id) const
  {
    return boundary_nodes(id, std::vector<double>(relevant.n_elements(), 0.), [](const Eigen::Vector2d &) { return true; });
  }

  std::vector<Node> Discretisation::boundary_nodes(const unsigned int                                  id,
                                                   const std::vector<double>                          &displacement,
                                                   const std::function<bool(const Eigen::Vector2d &)> &is_there) const
  {
    std::vector<double> mine; // dof x, dof y, dof of rotation or -1, x, y; a double holds dofs exactly up to 2^53
    for (const auto &edge : edges)
      if (edge.id == id)
        for (unsigned int k = 0; k < (reference.n_nodes > 4 ? 3u : 2u); ++k)
          {
            const Node &node = nodes[edge.nodes[k]];
            if (!is_there(node.initial + Eigen::Vector2d(displacement[node.local[0]], displacement[node.local[1]])))
              continue;
            const double rotation = node.rotation == numbers::invalid_dof_index ? -1. : double(node.rotation);
            mine.insert(mine.end(), {double(node.dofs[0]), double(node.dofs[1]), rotation, node.initial.x(), node.initial.y()});
          }
    std::map<types::global_dof_index, Node> all;
    for (const auto &part : Utilities::MPI::all_gather(communicator(), mine))
      for (std::size_t k = 0; k < part.size(); k += 5)
        {
          const types::global_dof_index x = part[k], y = part[k + 1];
          Node                         &node = all[x];
          node                               = {{part[k + 3], part[k + 4]}, {x, y}};
          if (part[k + 2] >= 0)
            node.rotation = part[k + 2];
        }
    std::vector<Node> result;
    for (const auto &[dof, node] : all)
      result.push_back(node);
    return result;
  }

  std::vector<Eigen::Vector2d> positions(const Discretisation &mesh, const std::vector<double> &displacement)
  {
    std::vector<Eigen::Vector2d> result;
    result.reserve(mesh.nodes.size());
    for (const auto &node : mesh.nodes)
      result.emplace_back(node.initial.x() + displacement[node.local[0]], node.initial.y() + displacement[node.local[1]]);
    return result;
  }

  Geometry geometry_at(const Discretisation &mesh, const std::vector<Eigen::Vector2d> &node_position)
  {
    Geometry geometry;
    geometry.cells.reserve(mesh.cells.size());
    for (const auto &cell : mesh.cells)
      {
        geometry.cells.push_back(cell_geometry(mesh, cell, node_position));
        for (unsigned int q = 0; q < mesh.reference.n_points; ++q)
          {
            const double area = geometry.cells.back().points[q].area;
            geometry.area += area;
            geometry.is_regular = geometry.is_regular && area > 0;
          }
      }
    return geometry;
  }
} // namespace diptych::continuum
