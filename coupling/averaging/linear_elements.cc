// diptych: continuous linear elements on the triangles of a mesh
// SPDX-License-Identifier: LGPL-2.1-or-later
#include "coupling/averaging/linear_elements.h"

#include <algorithm>
#include <cmath>

#include <Eigen/LU>

namespace diptych::coupling
{
  Unknowns number_unknowns(const TargetCells &target)
  {
    const double                    near = 1e-6 * std::sqrt(*std::min_element(target.area.begin(), target.area.end()));
    const std::vector<unsigned int> same = same_nodes(target.mesh, target.period, near);
    Unknowns                        unknowns;
    unknowns.of_node.resize(same.size());
    for (unsigned int a = 0; a < same.size(); ++a)
      if (same[a] == a)
        unknowns.of_node[a] = unknowns.n++;
    for (unsigned int a = 0; a < same.size(); ++a)
      unknowns.of_node[a] = unknowns.of_node[same[a]];
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
