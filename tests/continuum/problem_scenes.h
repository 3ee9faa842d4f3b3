// diptych: boundary-value problems taken apart: increments, refined meshes, columns of the tangent
// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <filesystem>
#include <fstream>
#include <random>
#include <string>
#include <vector>

#include "continuum/driver.h"
#include "continuum/refinement.h"
#include "tests/continuum/continuum_scenes.h"

namespace diptych::continuum::tests
{
  // Divides the cells whose lower left corner lies within `radius` of `at`, and what refine() divides around them.
  inline void refine_around(BoundaryValueProblem &problem, const Eigen::Vector2d &at, const double radius)
  {
    const auto         &mesh = problem.discretisation();
    std::vector<double> wish;
    for (const Cell &cell : mesh.cells)
      wish.push_back((mesh.nodes[cell.nodes[0]].initial - at).norm() < radius ? 1 : 0);
    std::vector<double> last(mesh.relevant.n_elements(), 0.);
    ASSERT_TRUE(refine(problem, {1, 0.5}, wish, last));
  }

  // Every component between -size and size; the generator is seeded.
  inline DistributedVector random_increment(const BoundaryValueProblem &problem, const double size, const unsigned int seed)
  {
    std::mt19937 random(seed);
    auto         increment = problem.zero_vector();
    for (const auto dof : problem.discretisation().owned)
      increment[dof] = size * (2. * double(random()) / double(random.max()) - 1);
    increment.compress(dealii::VectorOperation::insert);
    return increment;
  }

  // Displacement A x, and its rotation.
  inline DistributedVector linear_field(const BoundaryValueProblem &problem, const Eigen::Matrix2d &A)
  {
    auto field = problem.zero_vector();
    for (const Node &node : problem.discretisation().nodes)
      {
        const Eigen::Vector2d u = A * node.initial;
        for (unsigned int c = 0; c < 2; ++c)
          field[node.dofs[c]] = u[c];
        if (node.rotation != dealii::numbers::invalid_dof_index)
          field[node.rotation] = (A(1, 0) - A(0, 1)) / 2;
      }
    field.compress(dealii::VectorOperation::insert);
    return field;
  }

  // A structured mesh of n x m cells whose inner vertices are pushed about by a tenth or two of a cell; the outline is the
  // rectangle [0, n] x [0, m], its sides match.
  struct DistortedMesh
  {
    std::string path = temporary_path(".msh");

    DistortedMesh(const int n, const int m)
    {
      std::ofstream out(path);
      out.precision(17);
      const auto id = [&](const int i, const int j) { return 1 + i + (n + 1) * j; };
      out << "$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$Nodes\n" << (n + 1) * (m + 1) << "\n";
      for (int j = 0; j <= m; ++j)
        for (int i = 0; i <= n; ++i)
          {
            const bool inside = i > 0 && i < n && j > 0 && j < m;
            out << id(i, j) << ' ' << i + (inside ? 0.2 * std::sin(3. * i + 5. * j) : 0.) << ' '
                << j + (inside ? 0.2 * std::cos(7. * i + 2. * j) : 0.) << " 0\n";
          }
      out << "$EndNodes\n$Elements\n" << 2 * (n + m) + n * m << "\n";
      int        k    = 0;
      const auto line = [&](const BoundaryId boundary, const int a, const int b) {
        out << ++k << " 1 2 " << boundary << ' ' << boundary << ' ' << a << ' ' << b << "\n";
      };
      for (int i = 0; i < n; ++i)
        {
          line(lower_platen, id(i, 0), id(i + 1, 0));
          line(upper_platen, id(i, m), id(i + 1, m));
        }
      for (int j = 0; j < m; ++j)
        {
          line(left_side, id(0, j), id(0, j + 1));
          line(right_side, id(n, j), id(n, j + 1));
        }
      for (int j = 0; j < m; ++j)
        for (int i = 0; i < n; ++i)
          out << ++k << " 3 2 1 1 " << id(i, j) << ' ' << id(i + 1, j) << ' ' << id(i + 1, j + 1) << ' ' << id(i, j + 1) << "\n";
      out << "$EndElements\n";
    }
    DistortedMesh(const DistortedMesh &)            = delete;
    DistortedMesh &operator=(const DistortedMesh &) = delete;
    ~DistortedMesh() { std::filesystem::remove(path); }
  };
} // namespace diptych::continuum::tests
