// diptych: continuous linear elements on the triangles of a mesh
// SPDX-License-Identifier: LGPL-2.1-or-later
#include "coupling/averaging/linear_elements.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include <Eigen/LU>

namespace diptych::coupling
{
  Unknowns number_unknowns(const TargetCells &target)
  {
    const std::vector<Eigen::Vector2d> &node = target.mesh.node;
    const double                        near = 1e-6 * std::sqrt(*std::min_element(target.area.begin(), target.area.end()));
    // The nodes are sorted by height, so that the search for a partner passes few of them.
    std::vector<unsigned int> by_height(node.size());
    std::iota(by_height.begin(), by_height.end(), 0);
    std::stable_sort(by_height.begin(), by_height.end(),
                     [&](const unsigned int a, const unsigned int b) { return node[a].y() < node[b].y(); });
    const auto partner = [&](const unsigned int a) {
      const Eigen::Vector2d x  = node[a] - Eigen::Vector2d(target.period, 0);
      auto                  at = std::lower_bound(by_height.begin(), by_height.end(), x.y() - near,
                                                  [&](const unsigned int b, const double y) { return node[b].y() < y; });
      for (; at != by_height.end() && node[*at].y() <= x.y() + near; ++at)
        if ((node[*at] - x).norm() <= near)
          return *at;
      return a;
    };

    Unknowns unknowns;
    unknowns.of_node.resize(node.size());
    for (unsigned int a = 0; a < node.size(); ++a)
      if (!(target.period > 0) || partner(a) == a)
        unknowns.of_node[a] = unknowns.n++;
    if (target.period > 0)
      for (unsigned int a = 0; a < node.size(); ++a)
        if (const unsigned int b = partner(a); b != a)
          unknowns.of_node[a] = unknowns.of_node[b];
    return unknowns;
  }

  Eigen::SparseMatrix<double> helmholtz_matrix(const QuadMesh &mesh, const Unknowns &unknowns, const double length)
  {
    std::vector<Eigen::Triplet<double>> entries;
    entries.reserve(9 * mesh.triangle.size());
    for (unsigned int t = 0; t < mesh.triangle.size(); ++t)
      {
        const double                      area     = triangle_area(mesh, t);
        const Eigen::Matrix<double, 2, 3> gradient = shape_gradients(mesh, t);
        const Eigen::Matrix3d             local    = area / 12 * (Eigen::Matrix3d::Identity() + Eigen::Matrix3d::Ones()) +
                                      length * length * area * gradient.transpose() * gradient;
        for (int a = 0; a < 3; ++a)
          for (int b = 0; b < 3; ++b)
            entries.emplace_back(unknowns.of_node[mesh.triangle[t].node[a]], unknowns.of_node[mesh.triangle[t].node[b]],
                                 local(a, b));
      }
    Eigen::SparseMatrix<double> matrix(unknowns.n, unknowns.n);
    matrix.setFromTriplets(entries.begin(), entries.end());
    return matrix;
  }

  Eigen::Vector3d shape_values(const TargetCells &target, const unsigned int triangle, const Eigen::Vector2d &x)
  {
    const auto     &corner = target.search.corners(triangle);
    Eigen::Matrix2d edges;
    edges << corner[1] - corner[0], corner[2] - corner[0];
    const Eigen::Vector2d inner = edges.inverse() * (x - corner[0]);
    const Eigen::Vector3d shape = Eigen::Vector3d(1 - inner.sum(), inner[0], inner[1]).cwiseMax(0.);
    return shape / shape.sum();
  }
} // namespace diptych::coupling
