// diptych: Q2 displacement on a quadrilateral mesh, what assembly reads precomputed
// SPDX-License-Identifier: LGPL-2.1-or-later
#include "continuum/discretisation.h"

#include <algorithm>
#include <cmath>
#include <fstream>
#include <limits>
#include <map>
#include <stdexcept>

#include <deal.II/base/quadrature_lib.h>
#include <deal.II/dofs/dof_tools.h>
#include <deal.II/fe/fe_q.h>
#include <deal.II/fe/fe_values.h>
#include <deal.II/fe/mapping_q1.h>
#include <deal.II/grid/grid_in.h>

#include "continuum/mesh.h"

namespace diptych::continuum
{
  using namespace dealii;

  namespace
  {
    // FE_Q(2)'s nodes on the cell's four edges (left, right, bottom, top): lower or left end, upper or right end, middle.
    constexpr unsigned int edge_nodes[4][3] = {{0, 2, 4}, {1, 3, 5}, {0, 1, 6}, {2, 3, 7}};

    bool is_platen(const types::boundary_id id)
    {
      return id == lower_platen || id == upper_platen;
    }

    // Calls action(cell's index in `cells`, cell, edge number) for every edge on the outer boundary of a locally owned cell.
    template <class Action> void for_boundary_edges(const DoFHandler<2> &dof_handler, Action &&action)
    {
      unsigned int index = 0;
      for (const auto &cell : dof_handler.active_cell_iterators())
        if (cell->is_locally_owned())
          {
            for (const unsigned int face : cell->face_indices())
              if (cell->face(face)->at_boundary())
                action(index, cell, face);
            ++index;
          }
    }
  } // namespace

  Discretisation::Discretisation(const std::string &msh_file, const bool rough)
      : triangulation(MPI_COMM_WORLD),
        element(FE_Q<2>(2), 2),
        dof_handler(triangulation)
  {
    GridIn<2> reader;
    reader.attach_triangulation(triangulation);
    std::ifstream file(msh_file);
    if (!file)
      throw std::runtime_error("cannot read mesh file " + msh_file);
    reader.read_msh(file);

    distribute_dofs(rough);
  }

  void Discretisation::distribute_dofs(const bool rough)
  {
    dof_handler.distribute_dofs(element);
    owned = dof_handler.locally_owned_dofs();
    DoFTools::extract_locally_relevant_dofs(dof_handler, relevant);
    number_nodes();
    compute_cell_geometry();
    collect_platens(rough);
    collect_sides();

    constraints.reinit(relevant);
    for (const auto &entry : platen_dofs)
      if (entry.prescribed)
        constraints.add_line(entry.dof);
    constraints.close();
  }

  void Discretisation::number_nodes()
  {
    std::vector<types::global_dof_index>            dofs(dofs_per_cell);
    std::map<types::global_dof_index, unsigned int> node_of_dof; // keyed by the x component
    const auto                                     &points  = element.base_element(0).get_unit_support_points();
    const Mapping<2>                               &mapping = get_default_linear_mapping(triangulation);
    for (const auto &cell : dof_handler.active_cell_iterators())
      if (cell->is_locally_owned())
        {
          cell->get_dof_indices(dofs);
          CellGeometry geometry;
          for (unsigned int node = 0; node < nodes_per_cell; ++node)
            {
              for (unsigned int c = 0; c < 2; ++c)
                {
                  geometry.dofs[2 * node + c]       = dofs[element.component_to_system_index(c, node)];
                  geometry.local_dofs[2 * node + c] = relevant.index_within_set(geometry.dofs[2 * node + c]);
                }
              const auto [entry, is_new] = node_of_dof.try_emplace(geometry.dofs[2 * node], node_position.size());
              geometry.nodes[node]       = entry->second;
              if (!is_new)
                continue;
              const Point<2> p = mapping.transform_unit_to_real_cell(cell, points[node]);
              node_position.emplace_back(p[0], p[1]);
              node_local_dofs.push_back({geometry.local_dofs[2 * node], geometry.local_dofs[2 * node + 1]});
            }
          cells.push_back(geometry);
        }
    const auto [low, high] = std::minmax_element(node_position.begin(), node_position.end(),
                                                 [](const auto &a, const auto &b) { return a.y() < b.y(); });
    height                 = high->y() - low->y();
  }

  void Discretisation::compute_cell_geometry()
  {
    const QGauss<2> quadrature(3);
    FEValues<2>     fe_values(element, quadrature, update_gradients | update_values | update_JxW_values);
    auto            geometry = cells.begin();
    for (const auto &cell : dof_handler.active_cell_iterators())
      if (cell->is_locally_owned())
        {
          fe_values.reinit(cell);
          for (unsigned int q = 0; q < points_per_cell; ++q)
            {
              geometry->weights[q] = fe_values.JxW(q);
              area += fe_values.JxW(q);
              for (unsigned int node = 0; node < nodes_per_cell; ++node)
                {
                  const unsigned int i         = element.component_to_system_index(0, node);
                  geometry->gradients[q][node] = fe_values.shape_grad_component(i, q, 0);
                  shape_values[q][node]        = fe_values.shape_value_component(i, q, 0);
                }
            }
          ++geometry;
        }
  }

  void Discretisation::collect_platens(const bool rough)
  {
    std::map<unsigned int, bool> platen_nodes; // node -> upper
    for_boundary_edges(dof_handler, [&](const unsigned int index, const auto &cell, const unsigned int face) {
      if (is_platen(cell->face(face)->boundary_id()))
        for (const unsigned int node : edge_nodes[face])
          platen_nodes[cells[index].nodes[node]] = cell->face(face)->boundary_id() == upper_platen;
    });

    // A smooth sample could slide as a rigid body: one node, near the middle of the lower platen, is held.
    double left = std::numeric_limits<double>::max(), right = -left;
    for (const auto &[node, upper] : platen_nodes)
      if (!upper)
        {
          left  = std::min(left, node_position[node].x());
          right = std::max(right, node_position[node].x());
        }
    unsigned int pinned = numbers::invalid_unsigned_int;
    double       best   = std::numeric_limits<double>::max();
    for (const auto &[node, upper] : platen_nodes)
      if (const double distance = std::abs(node_position[node].x() - (left + right) / 2); !upper && distance < best)
        {
          best   = distance;
          pinned = node;
        }

    for (const auto &[node, upper] : platen_nodes)
      for (unsigned int c = 0; c < 2; ++c)
        {
          const unsigned int local = node_local_dofs[node][c];
          const bool         moves = rough || c == 1;
          platen_dofs.push_back({relevant.nth_index_in_set(local), local, c, upper, moves || node == pinned, moves});
        }
  }

  void Discretisation::collect_sides()
  {
    for_boundary_edges(dof_handler, [&](const unsigned int index, const auto &cell, const unsigned int face) {
      const auto id = cell->face(face)->boundary_id();
      if (id != left_side && id != right_side)
        return;
      const auto &nodes = cells[index].nodes;
      SideEdge    edge{{nodes[edge_nodes[face][0]], nodes[edge_nodes[face][1]], nodes[edge_nodes[face][2]]},
                    id == left_side ? 1. : -1.};
      if (node_position[edge.nodes[0]].y() > node_position[edge.nodes[1]].y())
        std::swap(edge.nodes[0], edge.nodes[1]);
      sides.push_back(edge);
    });
  }
} // namespace diptych::continuum
