// diptych: unknowns, nodes and edges of a quadrilateral mesh that may be distributed and refined
// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <array>
#include <functional>
#include <vector>

#include <Eigen/Core>

#include <deal.II/base/index_set.h>
#include <deal.II/distributed/tria.h>
#include <deal.II/dofs/dof_handler.h>
#include <deal.II/fe/fe_system.h>

#include "continuum/elements/reference_element.h"
#include "continuum/mesh/quad_mesh.h"
#include "continuum/stopping.h"

namespace diptych::continuum
{
  // One locally owned cell. Its dofs are ordered 2 * node + component, followed by the rotations of the four corners. Nodes are
  // numbered as in ReferenceElement. `local` is the index among the locally relevant dofs, the order of this process's vectors.
  struct Cell
  {
    std::array<unsigned int, max_nodes>                   nodes;
    std::array<dealii::types::global_dof_index, max_dofs> dofs;
    std::array<unsigned int, max_dofs>                    local;
  };

  // An element edge on the outer boundary.
  struct BoundaryEdge
  {
    unsigned int                id;      // BoundaryId
    std::array<unsigned int, 3> nodes;   // lower (or left) end, upper (or right) end, middle (unused by four-node elements)
    std::size_t                 cell;    // that has the edge
    std::array<unsigned int, 3> in_cell; // numbers of these nodes in the cell
  };

  struct Node
  {
    Eigen::Vector2d                                initial; // position [length]
    std::array<dealii::types::global_dof_index, 2> dofs;    // of displacement; the first identifies the node
    dealii::types::global_dof_index                rotation = dealii::numbers::invalid_dof_index; // dof, if any
    std::array<unsigned int, 2>                    local{}; // the same dofs, as indices among the relevant ones
    unsigned int                                   local_rotation = 0;
  };

  class Discretisation
  {
  public:
    // Distributes a mesh that check() has accepted over the processes of `communicator`. Calls `check_stop` between its phases.
    Discretisation(const QuadMesh &mesh, ElementKind kind, MPI_Comm communicator, const CheckStop &check_stop = {});

    MPI_Comm communicator() const { return triangulation.get_communicator(); }

    void distribute(const CheckStop &check_stop = {});

    // Adds dofs of other processes that this one reads. Local indices change.
    void add_relevant(const std::vector<dealii::types::global_dof_index> &dofs);

    dealii::parallel::distributed::Triangulation<2> triangulation;
    ElementKind                                     kind;
    ReferenceElement                                reference;
    dealii::FESystem<2>                             element;
    dealii::DoFHandler<2>                           dof_handler;
    dealii::IndexSet                                owned, relevant;

    std::vector<Cell>         cells; // in the order of deal.II's locally owned active cells
    std::vector<Node>         nodes; // nodes of those cells
    std::vector<BoundaryEdge> edges;

    // Bounding box of the unloaded sample: lower left corner and extents.
    Eigen::Vector2d origin = Eigen::Vector2d::Zero(), extent = Eigen::Vector2d::Zero();

    // All nodes of a boundary on every process, in ascending order of their dofs. Collective.
    std::vector<Node> boundary_nodes(unsigned int id) const;

    // The nodes of a boundary whose displaced position satisfies `is_there`. `displacement`: on the relevant dofs. Collective.
    std::vector<Node> boundary_nodes(unsigned int                                        id,
                                     const std::vector<double>                          &displacement,
                                     const std::function<bool(const Eigen::Vector2d &)> &is_there) const;

  private:
    void number_nodes();
    void number_locally();
    void collect_edges();
    void measure();
  };

  // Positions of all nodes, for a displacement on the relevant dofs [length].
  std::vector<Eigen::Vector2d> positions(const Discretisation &mesh, const std::vector<double> &displacement);

  // Data of one point at one geometry: gradients of the shape functions [1/length] and the area of the point.
  struct PointGeometry
  {
    std::array<dealii::Tensor<1, 2>, max_nodes> gradient;
    std::array<dealii::Tensor<1, 2>, 4>         rotation_gradient;
    double                                      area = 0;
  };
  struct CellGeometry
  {
    std::array<PointGeometry, max_points>       points;
    std::array<dealii::Tensor<1, 2>, max_nodes> mean_gradient; // over the element, for mean dilation
  };

  struct Geometry
  {
    std::vector<CellGeometry> cells;
    double                    area       = 0;    // area of this process's cells [length^2]
    bool                      is_regular = true; // no element of this process is inverted
  };
  Geometry geometry_at(const Discretisation &mesh, const std::vector<Eigen::Vector2d> &node_position);
} // namespace diptych::continuum
