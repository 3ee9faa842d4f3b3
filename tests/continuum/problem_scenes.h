// diptych: parts of boundary-value problems for tests: increments, refined meshes, fields
// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include "continuum/equilibrium/driver.h"
#include "continuum/equilibrium/refinement.h"
#include "tests/continuum/continuum_scenes.h"

namespace diptych::continuum::tests
{
  // Divides the cells whose lower left corner lies within `radius` of `at`, and the cells around them that refine() also
  // divides.
  inline void refine_around(BoundaryValueProblem &problem, const Eigen::Vector2d &at, const double radius)
  {
    const auto         &mesh = problem.discretisation();
    std::vector<double> wish;
    for (const Cell &cell : mesh.cells)
      wish.push_back((mesh.nodes[cell.nodes[0]].initial - at).norm() < radius ? 1 : 0);
    const std::vector<double> zero(mesh.relevant.n_elements(), 0.);
    LastMotion                last{zero, zero};
    ASSERT_TRUE(refine(problem, {1, 0.5}, wish, last));
  }

  // Steps up to `progress`. Returns an empty text, or the reason why it was not reached.
  inline std::string advance(const BoundaryValueProblem &problem, LoadDriver &driver, const double progress)
  {
    while (problem.progress() < progress)
      if (const auto why = driver.step_towards(progress); !why.empty())
        return why;
    return {};
  }

  // Every component lies between -size and size. The generator is seeded.
  inline DistributedVector random_increment(const BoundaryValueProblem &problem, const double size, const unsigned int seed)
  {
    std::mt19937 random(seed);
    auto         increment = problem.zero_vector();
    for (const auto dof : problem.discretisation().owned)
      increment[dof] = size * (2. * double(random()) / double(random.max()) - 1);
    increment.compress(dealii::VectorOperation::insert);
    return increment;
  }

  // Displacement A x and its rotation.
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

  // A structured mesh of n x m cells. Inner vertices are displaced by up to 0.2 of a cell. The outline is the rectangle [0, n]
  // x [0, m]; its sides match.
  inline QuadMesh distorted_mesh(const unsigned int n, const unsigned int m)
  {
    QuadMesh   mesh;
    const auto id = [&](const unsigned int i, const unsigned int j) { return i + (n + 1) * j; };
    for (unsigned int j = 0; j <= m; ++j)
      for (unsigned int i = 0; i <= n; ++i)
        {
          const bool inside = i > 0 && i < n && j > 0 && j < m;
          mesh.vertices.emplace_back(i + (inside ? 0.2 * std::sin(3. * i + 5. * j) : 0.),
                                     j + (inside ? 0.2 * std::cos(7. * i + 2. * j) : 0.));
        }
    for (unsigned int j = 0; j < m; ++j)
      for (unsigned int i = 0; i < n; ++i)
        mesh.cells.push_back({id(i, j), id(i + 1, j), id(i + 1, j + 1), id(i, j + 1)});
    for (unsigned int i = 0; i < n; ++i)
      {
        mesh.boundary.push_back({{id(i, 0), id(i + 1, 0)}, lower_platen});
        mesh.boundary.push_back({{id(i, m), id(i + 1, m)}, upper_platen});
      }
    for (unsigned int j = 0; j < m; ++j)
      {
        mesh.boundary.push_back({{id(0, j), id(0, j + 1)}, left_side});
        mesh.boundary.push_back({{id(n, j), id(n, j + 1)}, right_side});
      }
    return mesh;
  }
} // namespace diptych::continuum::tests
