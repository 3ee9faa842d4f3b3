// diptych: conservative mapping of contact forces onto cells: branches cut by the mesh
// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <vector>

#include <Eigen/Core>

#include "coupling/mesh_cells.h"
#include "discrete/snapshot.h"

namespace diptych::coupling
{
  // Moments |K| sigma_K on the triangles of a mesh, raw (unsymmetric): row index = force, positive in compression
  // [pressure * length^2].
  struct MappedMoment
  {
    std::vector<Eigen::Matrix2d> triangle_moment;                 // 2 * n_cells
    Eigen::Matrix2d              total = Eigen::Matrix2d::Zero(); // -sum over contacts of f (x) branch, not through the mesh
    double                       outside_share = 0;               // of sum |f| * length of segment, what lay outside the mesh
  };

  // |K| sigma_K = -sum_c f (x) (segment in K): the branch x_i - contact point - x_j of each contact cut by the triangles, f the
  // force on i, segment directed from x_i to x_j, or to the image of it that touches i. A body j >= position.size() is a
  // platen: only x_i - contact point. What lies outside the mesh goes to the nearest boundary cell, so that
  // sum_K |K| sigma_K = total to round-off.
  // position: grain centres [length].
  MappedMoment map_segments(const QuadMesh                            &mesh,
                            const TriangleSearch                      &search,
                            const std::vector<Eigen::Vector2d>        &position,
                            const std::vector<discrete::ContactForce> &contacts);

  // Adds the dynamic part of the internal moments, -spin_term * 1 at each grain's centre, with
  // spin_term = mean of (1/2) omega^2 I >= 0 [pressure * length^2], to the triangles and to the total.
  void add_spin_term(const TriangleSearch               &search,
                     const std::vector<Eigen::Vector2d> &position,
                     const std::vector<double>          &mean_spin_term,
                     MappedMoment                       &mapped);

  // |sum over triangles - expected| / |expected|, the symmetric parts compared (Frobenius norm). expected: the sum of the grains'
  // internal moments, or mapped.total.
  double total_relative_error(const MappedMoment &mapped, const Eigen::Matrix2d &expected);

  // Stress of the cells [pressure]: the moments of their two triangles over the cell's area; unsymmetric.
  std::vector<Eigen::Matrix2d> cell_stress(const QuadMesh &mesh, const MappedMoment &mapped);

  // sum_K |K| sigma_K grad N_a at every node of the mesh [pressure * length], N_a linear on the triangles.
  std::vector<Eigen::Vector2d> nodal_forces(const QuadMesh &mesh, const MappedMoment &mapped);

  // What nodal_forces() gives when every branch lies inside the mesh, computed without cutting: N_a at the grain centres times
  // the contact forces on the grains, minus N_a at the contact points times the forces from the platens.
  std::vector<Eigen::Vector2d> nodal_contact_forces(const QuadMesh                            &mesh,
                                                    const TriangleSearch                      &search,
                                                    const std::vector<Eigen::Vector2d>        &position,
                                                    const std::vector<discrete::ContactForce> &contacts);
} // namespace diptych::coupling
