// diptych: repetition of a sample along x or along two lattice vectors
// SPDX-License-Identifier: LGPL-2.1-or-later
#include "coupling/cells/period.h"

#include <algorithm>
#include <numeric>

namespace diptych::coupling
{
  std::vector<Eigen::Vector2d> Period::neighbours() const
  {
    std::vector<Eigen::Vector2d> shifts;
    for (const int upward : {0, -1, 1})
      for (const int along : {0, -1, 1})
        if ((along != 0 || upward != 0) && any() && (both() || upward == 0))
          shifts.emplace_back(vectors * Eigen::Vector2d(along, upward));
    return shifts;
  }

  std::vector<Eigen::Vector2d> Period::images_in(const Eigen::Vector2d &x,
                                                 const Eigen::Vector2d &lower,
                                                 const Eigen::Vector2d &upper) const
  {
    if (!any())
      return {x};
    Eigen::Vector2d low = fractions(lower - x), high = low;
    for (const Eigen::Vector2d &corner : {upper, Eigen::Vector2d(upper.x(), lower.y()), Eigen::Vector2d(lower.x(), upper.y())})
      {
        low  = low.cwiseMin(fractions(corner - x));
        high = high.cwiseMax(fractions(corner - x));
      }
    std::vector<Eigen::Vector2d> images;
    for (double upward = std::ceil(low.y()); upward <= high.y(); ++upward)
      for (double along = std::ceil(low.x()); along <= high.x(); ++along)
        if (const Eigen::Vector2d image = x + vectors * Eigen::Vector2d(along, upward);
            (image.array() >= lower.array()).all() && (image.array() <= upper.array()).all())
          images.push_back(image);
    return images;
  }

  std::vector<Eigen::Vector2d> Period::wrap(const Eigen::Vector2d &corner, std::vector<Eigen::Vector2d> &places) const
  {
    std::vector<Eigen::Vector2d> moves;
    for (Eigen::Vector2d &x : places)
      {
        moves.emplace_back(-vectors * fractions(x - corner).array().floor().matrix());
        x += moves.back();
      }
    return moves;
  }

  Period period_of(const discrete::Snapshot &grains)
  {
    return grains.cell_vectors.isZero(0) ? Period(grains.cell_width) : Period(grains.cell_vectors);
  }

  void follow_grains(const std::vector<Eigen::Vector2d> &moves, std::vector<discrete::ContactForce> &contacts)
  {
    for (discrete::ContactForce &contact : contacts)
      {
        const Eigen::Vector2d &of_i = moves.at(contact.i);
        contact.point += of_i;
        if (contact.j < static_cast<int>(moves.size()))
          {
            contact.shift += of_i.x() - moves[contact.j].x();
            contact.shift_y += of_i.y() - moves[contact.j].y();
          }
      }
  }

  QuadMesh tiled(const QuadMesh &mesh, const Period &period)
  {
    QuadMesh   result = mesh;
    const auto add    = [&](const Eigen::Vector2d &shift) {
      const unsigned int first = result.node.size(), first_cell = result.cell.size();
      for (const Eigen::Vector2d &x : mesh.node)
        result.node.emplace_back(x + shift);
      for (auto cell : mesh.cell)
        {
          for (unsigned int &node : cell)
            node += first;
          result.cell.push_back(cell);
        }
      for (auto triangle : mesh.triangle)
        {
          for (unsigned int &node : triangle.node)
            node += first;
          triangle.cell += first_cell;
          result.triangle.push_back(triangle);
        }
    };
    for (const Eigen::Vector2d &shift : period.neighbours())
      add(shift);
    return result;
  }

  std::vector<unsigned int> same_nodes(const QuadMesh &mesh, const Period &period, const double near)
  {
    const std::vector<Eigen::Vector2d> &node = mesh.node;
    std::vector<unsigned int>           same(node.size());
    std::iota(same.begin(), same.end(), 0);
    // The nodes are sorted by height, so that the search for a partner passes few of them.
    std::vector<unsigned int> by_height = same;
    std::stable_sort(by_height.begin(), by_height.end(),
                     [&](const unsigned int a, const unsigned int b) { return node[a].y() < node[b].y(); });
    const auto before = [&](const unsigned int a, const Eigen::Vector2d &along) {
      const Eigen::Vector2d x  = node[a] - along;
      auto                  at = std::lower_bound(by_height.begin(), by_height.end(), x.y() - near,
                                                  [&](const unsigned int b, const double y) { return node[b].y() < y; });
      for (; at != by_height.end() && node[*at].y() <= x.y() + near; ++at)
        if ((node[*at] - x).norm() <= near)
          return *at;
      return a;
    };
    for (unsigned int &a : same)
      for (const int k : {0, 1})
        if (!period.vectors.col(k).isZero(0))
          a = before(a, period.vectors.col(k));
    return same;
  }
} // namespace diptych::coupling
