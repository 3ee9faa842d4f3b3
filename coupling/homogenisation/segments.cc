// diptych: conservative mapping of contact forces onto cells: branches cut by the mesh
// SPDX-License-Identifier: LGPL-2.1-or-later
#include "coupling/homogenisation/segments.h"

#include <algorithm>
#include <limits>
#include <stdexcept>

#include <Eigen/LU>

namespace diptych::coupling
{
  namespace
  {
    bool joins_grains(const discrete::ContactForce &contact, const std::vector<Eigen::Vector2d> &position)
    {
      return contact.j < static_cast<int>(position.size());
    }

    // Linear shape functions of the triangle that holds a point.
    Eigen::Vector3d shape_values(const std::array<Eigen::Vector2d, 3> &corner, const Eigen::Vector2d &point)
    {
      Eigen::Matrix2d edges;
      edges << corner[1] - corner[0], corner[2] - corner[0];
      const Eigen::Vector2d values = edges.inverse() * (point - corner[0]);
      return {1 - values.sum(), values[0], values[1]};
    }
  } // namespace

  MappedMoment map_segments(const QuadMesh                            &mesh,
                            const TriangleSearch                      &search,
                            const std::vector<Eigen::Vector2d>        &position,
                            const std::vector<discrete::ContactForce> &contacts)
  {
    MappedMoment mapped;
    mapped.triangle_moment.assign(2 * mesh.cell.size(), Eigen::Matrix2d::Zero());

    double                             inside = 0, outside = 0;
    std::vector<TriangleSearch::Piece> pieces;
    const auto add = [&](const Eigen::Vector2d &force, const Eigen::Vector2d &from, const Eigen::Vector2d &to) {
      const Eigen::Matrix2d moment = -force * (to - from).transpose();
      const double          size   = force.norm() * (to - from).norm();
      search.cut(from, to, pieces);
      for (const auto &piece : pieces)
        {
          mapped.triangle_moment[piece.triangle] += (piece.to - piece.from) * moment;
          (piece.inside ? inside : outside) += (piece.to - piece.from) * size;
        }
    };

    for (const auto &contact : contacts)
      {
        if (contact.i < 0 || contact.i >= static_cast<int>(position.size()) || contact.j < 0)
          throw std::invalid_argument("a contact names a grain that does not exist");
        if (contact.force.isZero(0))
          continue;
        const Eigen::Vector2d &start = position[contact.i];
        const Eigen::Vector2d  image(contact.shift, 0); // of j, across the edge of a periodic cell
        const Eigen::Vector2d  end = joins_grains(contact, position) ? position[contact.j] + image : contact.point;
        mapped.total -= contact.force * (end - start).transpose();
        add(contact.force, start, contact.point);
        if (joins_grains(contact, position))
          add(contact.force, contact.point, end);
      }
    if (inside + outside > 0)
      mapped.outside_share = outside / (inside + outside);
    return mapped;
  }

  void add_spin_term(const TriangleSearch               &search,
                     const std::vector<Eigen::Vector2d> &position,
                     const std::vector<double>          &mean_spin_term,
                     MappedMoment                       &mapped)
  {
    if (mean_spin_term.size() != position.size())
      throw std::invalid_argument("one spin term a grain is needed");
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
    std::vector<Eigen::Matrix2d> stress(areas.size());
    for (std::size_t c = 0; c < areas.size(); ++c)
      stress[c] = (mapped.triangle_moment[2 * c] + mapped.triangle_moment[2 * c + 1]) / areas[c];
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
    std::vector<Eigen::Vector2d> nodal(mesh.node.size(), Eigen::Vector2d::Zero());
    const auto                   add = [&](const Eigen::Vector2d &force, const Eigen::Vector2d &point) {
      const unsigned int triangle = search.locate(point).triangle;
      const auto         node     = triangle_nodes(mesh, triangle);
      const auto         value    = shape_values(search.corners(triangle), point);
      for (unsigned int k = 0; k < 3; ++k)
        nodal[node[k]] += value[k] * force;
    };

    std::vector<Eigen::Vector2d> on_grain(position.size(), Eigen::Vector2d::Zero());
    for (const auto &contact : contacts)
      {
        on_grain.at(contact.i) += contact.force;
        if (joins_grains(contact, position))
          on_grain[contact.j] -= contact.force;
        else
          add(-contact.force, contact.point);
      }
    for (std::size_t i = 0; i < position.size(); ++i)
      add(on_grain[i], position[i]);
    return nodal;
  }
} // namespace diptych::coupling
