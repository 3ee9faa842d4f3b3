// diptych: maps contact forces onto cells conservatively, by cutting the branches at the mesh's edges
// SPDX-License-Identifier: LGPL-2.1-or-later
#include "coupling/averaging/segments.h"

#include <algorithm>
#include <limits>
#include <numeric>
#include <stdexcept>

namespace diptych::coupling
{
  namespace
  {
    bool joins_grains(const discrete::ContactForce &contact, const std::vector<Eigen::Vector2d> &position)
    {
      return contact.j < static_cast<int>(position.size());
    }

    std::vector<Eigen::Vector2d> weak_sum(const QuadMesh                            &mesh,
                                          const TriangleSearch                      &search,
                                          const std::vector<Eigen::Vector2d>        &position,
                                          const std::vector<Eigen::Vector2d>        &force,
                                          const std::vector<discrete::ContactForce> &contacts)
    {
      std::vector<Eigen::Vector2d> nodal(mesh.node.size(), Eigen::Vector2d::Zero());
      for (const auto &contact : contacts)
        if (!joins_grains(contact, position))
          add_at_nodes(mesh, search, -contact.force, contact.point, nodal);
      for (std::size_t i = 0; i < position.size(); ++i)
        if (!force[i].isZero(0))
          add_at_nodes(mesh, search, force[i], position[i], nodal);
      return nodal;
    }

    std::vector<Eigen::Vector2d> contact_sums(const std::size_t n_grains, const std::vector<discrete::ContactForce> &contacts)
    {
      std::vector<Eigen::Vector2d> on_grain(n_grains, Eigen::Vector2d::Zero());
      for (const auto &contact : contacts)
        {
          on_grain.at(contact.i) += contact.force;
          if (std::size_t(contact.j) < n_grains)
            on_grain[contact.j] -= contact.force;
        }
      return on_grain;
    }
  } // namespace

  void add_at_nodes(const QuadMesh               &mesh,
                    const TriangleSearch         &search,
                    const Eigen::Vector2d        &force,
                    const Eigen::Vector2d        &point,
                    std::vector<Eigen::Vector2d> &nodal)
  {
    const unsigned int triangle = search.locate(point).triangle;
    const auto         node     = triangle_nodes(mesh, triangle);
    const auto         value    = shape_values(mesh, triangle, point);
    for (unsigned int k = 0; k < 3; ++k)
      nodal[node[k]] += value[k] * force;
  }

  double outside_share(const MappedMoment &mapped)
  {
    const double inside = std::accumulate(mapped.triangle_weight.begin(), mapped.triangle_weight.end(), 0.);
    return mapped.outside_weight > 0 ? mapped.outside_weight / (inside + mapped.outside_weight) : 0;
  }

  MappedMoment map_segments(const QuadMesh                            &mesh,
                            const TriangleSearch                      &search,
                            const std::vector<Eigen::Vector2d>        &position,
                            const std::vector<discrete::ContactForce> &contacts)
  {
    MappedMoment mapped;
    mapped.triangle_moment.assign(mesh.triangle.size(), Eigen::Matrix2d::Zero());
    mapped.triangle_weight.assign(mesh.triangle.size(), 0.);

    std::vector<TriangleSearch::Piece> pieces;
    const auto add = [&](const Eigen::Vector2d &force, const Eigen::Vector2d &from, const Eigen::Vector2d &to) {
      const Eigen::Matrix2d moment = -force * (to - from).transpose();
      const double          size   = force.norm() * (to - from).norm();
      search.cut(from, to, pieces);
      for (const auto &piece : pieces)
        {
          mapped.triangle_moment[piece.triangle] += (piece.to - piece.from) * moment;
          (piece.inside ? mapped.triangle_weight[piece.triangle] : mapped.outside_weight) += (piece.to - piece.from) * size;
        }
    };

    // Contacts are visited in spatial order: in their own order the triangles would be loaded from memory again and again.
    std::vector<Eigen::Vector2d> points;
    for (const auto &contact : contacts)
      {
        if (contact.i < 0 || contact.i >= static_cast<int>(position.size()) || contact.j < 0)
          throw std::invalid_argument("a contact joins a grain that does not exist");
        points.push_back(contact.point);
      }
    for (const unsigned int k : search.in_spatial_order(points))
      {
        const discrete::ContactForce &contact = contacts[k];
        if (contact.force.isZero(0))
          continue;
        const Eigen::Vector2d &start = position[contact.i];
        const Eigen::Vector2d  image(contact.shift, contact.shift_y); // of j, across the edge of a periodic cell
        const Eigen::Vector2d  end = joins_grains(contact, position) ? position[contact.j] + image : contact.point;
        mapped.total -= contact.force * (end - start).transpose();
        add(contact.force, start, contact.point);
        if (joins_grains(contact, position))
          add(contact.force, contact.point, end);
      }
    mapped.outside_share = outside_share(mapped);
    return mapped;
  }

  void add_spin_term(const TriangleSearch               &search,
                     const std::vector<Eigen::Vector2d> &position,
                     const std::vector<double>          &mean_spin_term,
                     MappedMoment                       &mapped)
  {
    if (mean_spin_term.size() != position.size())
      throw std::invalid_argument("the mapping needs one spin term per grain");
    for (std::size_t i = 0; i < position.size(); ++i)
      if (mean_spin_term[i] != 0)
        {
          const Eigen::Matrix2d moment = -mean_spin_term[i] * Eigen::Matrix2d::Identity();
          mapped.triangle_moment[search.locate(position[i]).triangle] += moment;
          mapped.total += moment;
        }
  }

  double total_relative_error(const MappedMoment &mapped, const Eigen::Matrix2d &expected)
  {
    Eigen::Matrix2d difference = -expected;
    for (const auto &moment : mapped.triangle_moment)
      difference += moment;
    return (difference + difference.transpose()).norm() /
           std::max((expected + expected.transpose()).norm(), std::numeric_limits<double>::min());
  }

  std::vector<Eigen::Matrix2d> cell_stress(const QuadMesh &mesh, const MappedMoment &mapped)
  {
    const std::vector<double>    areas = cell_areas(mesh);
    std::vector<Eigen::Matrix2d> stress(areas.size(), Eigen::Matrix2d::Zero());
    for (std::size_t t = 0; t < mesh.triangle.size(); ++t)
      stress[mesh.triangle[t].cell] += mapped.triangle_moment[t];
    for (std::size_t c = 0; c < areas.size(); ++c)
      stress[c] /= areas[c];
    return stress;
  }

  std::vector<Eigen::Vector2d> nodal_forces(const QuadMesh &mesh, const MappedMoment &mapped)
  {
    std::vector<Eigen::Vector2d> force(mesh.node.size(), Eigen::Vector2d::Zero());
    for (unsigned int t = 0; t < mapped.triangle_moment.size(); ++t)
      {
        const auto node     = triangle_nodes(mesh, t);
        const auto gradient = shape_gradients(mesh, t);
        for (unsigned int k = 0; k < 3; ++k)
          force[node[k]] += mapped.triangle_moment[t] * gradient.col(k);
      }
    return force;
  }

  // Along a branch the sum of f (segment in K . grad N_a) telescopes to f (N_a(end) - N_a(start)).
  std::vector<Eigen::Vector2d> nodal_contact_forces(const QuadMesh                            &mesh,
                                                    const TriangleSearch                      &search,
                                                    const std::vector<Eigen::Vector2d>        &position,
                                                    const std::vector<discrete::ContactForce> &contacts)
  {
    return weak_sum(mesh, search, position, contact_sums(position.size(), contacts), contacts);
  }

  std::vector<Eigen::Vector2d> nodal_applied_forces(const QuadMesh                     &mesh,
                                                    const TriangleSearch               &search,
                                                    const discrete::Snapshot           &grains,
                                                    const std::vector<Eigen::Vector2d> &acceleration)
  {
    const std::size_t n = grains.position.size();
    if (acceleration.size() != n || grains.applied_force.size() != n)
      throw std::invalid_argument("the nodal forces need one acceleration and one applied force per grain");
    std::vector<Eigen::Vector2d> force = contact_sums(n, grains.contacts); // the sum of its contact forces is the only known
                                                                           // force that holds a fixed grain
    for (std::size_t i = 0; i < n; ++i)
      if (grains.fixed.empty() || !grains.fixed[i])
        force[i] = grains.mass[i] * acceleration[i] - grains.applied_force[i];
    return weak_sum(mesh, search, grains.position, force, grains.contacts);
  }
} // namespace diptych::coupling
