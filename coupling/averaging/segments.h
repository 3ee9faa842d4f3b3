// diptych: maps contact forces onto cells conservatively, by cutting the branches at the mesh's edges
// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <vector>

#include <Eigen/Core>

#include "coupling/cells/mesh_cells.h"
#include "coupling/cells/triangle_search.h"
#include "discrete/snapshot.h"

namespace diptych::coupling
{
  // Moments |K| sigma_K of the triangles of a mesh, unsymmetric. Row index = force, positive in compression [pressure *
  // length^2].
  struct MappedMoment
  {
    std::vector<Eigen::Matrix2d> triangle_moment;                 // one per triangle
    Eigen::Matrix2d              total = Eigen::Matrix2d::Zero(); // -sum over contacts of f (x) branch, computed without the mesh
    double                       outside_share = 0;               // share of sum |f| * length of segment outside the mesh
    std::vector<double>          triangle_weight;    // sum of |f| * length of the segments inside [pressure * length^2]
    double                       outside_weight = 0; // the same sum for the segments outside the mesh
  };

  // |K| sigma_K = -sum_c f (x) (segment in K). The triangles K cut the branch x_i - contact point - x_j of each contact. The
  // force on i is f. The segment points from x_i to x_j, or to the image of x_j that touches i. A body j >= position.size() is
  // a platen, with x_i - contact point only. Parts outside the mesh go to the nearest boundary cell, so that sum_K |K| sigma_K
  // = total to round-off. `position`: grain centres [length].
  MappedMoment map_segments(const QuadMesh                            &mesh,
                            const TriangleSearch                      &search,
                            const std::vector<Eigen::Vector2d>        &position,
                            const std::vector<discrete::ContactForce> &contacts);

  double outside_share(const MappedMoment &mapped);

  // Adds the dynamic part of the internal moments, -spin_term * 1 at each grain's centre, to the triangles and to the total. Here
  // spin_term = mean of (1/2) J omega^2 >= 0 [pressure * length^2].
  void add_spin_term(const TriangleSearch               &search,
                     const std::vector<Eigen::Vector2d> &position,
                     const std::vector<double>          &mean_spin_term,
                     MappedMoment                       &mapped);

  // |sum over triangles - expected| / |expected| of the symmetric parts (Frobenius norm). `expected`: the sum of the grains'
  // internal moments, or mapped.total.
  double total_relative_error(const MappedMoment &mapped, const Eigen::Matrix2d &expected);

  // Unsymmetric stress of the cells [pressure]: the moments of a cell's triangles over its area.
  std::vector<Eigen::Matrix2d> cell_stress(const QuadMesh &mesh, const MappedMoment &mapped);

  // sum_K |K| sigma_K grad N_a at every node of the mesh [pressure * length], N_a linear on the triangles.
  std::vector<Eigen::Vector2d> nodal_forces(const QuadMesh &mesh, const MappedMoment &mapped);

  void add_at_nodes(const QuadMesh               &mesh,
                    const TriangleSearch         &search,
                    const Eigen::Vector2d        &force,
                    const Eigen::Vector2d        &point,
                    std::vector<Eigen::Vector2d> &nodal);

  // Nodal forces without cutting branches; every branch must lie inside the mesh. Sums N_a at the grain centres times the contact
  // forces on the grains. Subtracts N_a at the platens' contact points times their forces.
  std::vector<Eigen::Vector2d> nodal_contact_forces(const QuadMesh                            &mesh,
                                                    const TriangleSearch                      &search,
                                                    const std::vector<Eigen::Vector2d>        &position,
                                                    const std::vector<discrete::ContactForce> &contacts);

  // Nodal forces from the accelerations of the last step: sum_i N_a(x_i) (m_i a_i - F_i) - sum_platens N_a(x_c) f. F_i is the
  // containing action plus gravity, f the force of the last step (Snapshot::contacts). `acceleration`: a_i = change of the
  // velocity in this step / step [length/time^2]. A fixed grain enters with its contact forces.
  std::vector<Eigen::Vector2d> nodal_applied_forces(const QuadMesh                     &mesh,
                                                    const TriangleSearch               &search,
                                                    const discrete::Snapshot           &grains,
                                                    const std::vector<Eigen::Vector2d> &acceleration);
} // namespace diptych::coupling
