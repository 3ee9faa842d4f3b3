// diptych: Q2 displacement on a quadrilateral mesh, what assembly reads precomputed
// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <array>
#include <string>
#include <vector>

#include <deal.II/base/index_set.h>
#include <deal.II/base/mpi.h>
#include <deal.II/base/tensor.h>
#include <deal.II/distributed/tria.h>
#include <deal.II/dofs/dof_handler.h>
#include <deal.II/fe/fe_system.h>
#include <deal.II/lac/affine_constraints.h>

#include <Eigen/Core>

namespace diptych::continuum
{
  constexpr unsigned int nodes_per_cell = 9, dofs_per_cell = 18, points_per_cell = 9;

  // Geometry of one cell, computed once: gradients in the initial configuration and weights of its 3x3 Gauss points.
  // Its dofs are ordered 2 * node + component; nodes in deal.II's order of FE_Q(2).
  struct CellGeometry
  {
    std::array<unsigned int, nodes_per_cell>                                      nodes;
    std::array<dealii::types::global_dof_index, dofs_per_cell>                    dofs;
    std::array<unsigned int, dofs_per_cell>                                       local_dofs; // among the relevant ones
    std::array<std::array<dealii::Tensor<1, 2>, nodes_per_cell>, points_per_cell> gradients;  // [point][node], 1/length
    std::array<double, points_per_cell>                                           weights;    // JxW [length^2]
  };

  // One element edge on a lateral side, from its lower to its upper end: nodes (lower, upper, middle).
  struct SideEdge
  {
    std::array<unsigned int, 3> nodes;
    double                      inward; // +1 on the left side, -1 on the right
  };

  // One displacement component of a platen node.
  struct PlatenDof
  {
    dealii::types::global_dof_index dof;
    unsigned int                    local_dof, component;
    bool                            upper;
    bool                            prescribed; // by the platen's motion (or the pin that keeps a smooth sample in place)
    bool                            moves;      // with the platen; a pin does not
  };

  struct Discretisation
  {
    // Reads the mesh, which check_mesh() must have accepted. `rough`: both components of the platens' nodes are
    // prescribed; otherwise only the vertical one, and the lower platen's node nearest to its middle is pinned.
    Discretisation(const std::string &msh_file, bool rough);

    dealii::parallel::distributed::Triangulation<2> triangulation;
    dealii::FESystem<2>                             element;
    dealii::DoFHandler<2>                           dof_handler;
    dealii::IndexSet                                owned, relevant;
    dealii::AffineConstraints<double> constraints; // homogeneous: Newton corrections vanish where motion is prescribed

    std::vector<CellGeometry>                                       cells; // locally owned
    std::vector<SideEdge>                                           sides;
    std::vector<PlatenDof>                                          platen_dofs;
    std::vector<Eigen::Vector2d>                                    node_position;   // initial
    std::vector<std::array<unsigned int, 2>>                        node_local_dofs; // per component, among the relevant ones
    double                                                          height = 0, area = 0; // initial
    std::array<std::array<double, nodes_per_cell>, points_per_cell> shape_values;         // [point][node]

  private:
    void distribute_dofs(bool rough);
    void number_nodes();
    void collect_platens(bool rough);
    void collect_sides();
    void compute_cell_geometry();
  };
} // namespace diptych::continuum
