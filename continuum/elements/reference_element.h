// diptych: elements of the continuum panel on the unit square
// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <array>
#include <utility>
#include <vector>

#include <deal.II/base/point.h>
#include <deal.II/base/tensor.h>

namespace diptych::continuum
{
  // Compile-time counts, so that loops over them unroll. Every element is isoparametric: the nodes of the displacement also
  // carry the shape. With `mean_dilation` the volumetric strain is the mean over the element (B-bar).
  struct Q2
  {
    static constexpr unsigned int n_nodes = 9, n_rotations = 0, n_points = 9, n_dofs = 18, degree = 2;
    static constexpr bool         mean_dilation = false, is_gradient = false;
  };
  struct Q1MeanDilation
  {
    static constexpr unsigned int n_nodes = 4, n_rotations = 0, n_points = 4, n_dofs = 8, degree = 1;
    static constexpr bool         mean_dilation = true, is_gradient = false;
  };
  struct Q2Cosserat // biquadratic displacement, bilinear rotation
  {
    static constexpr unsigned int n_nodes = 9, n_rotations = 4, n_points = 9, n_dofs = 22, degree = 2;
    static constexpr bool         mean_dilation = false, is_gradient = false;
  };
  struct Q2Gradient : Q2Cosserat // the bilinear unknown is the nonlocal hardening variable in place of the rotation
  {
    static constexpr bool is_gradient = true;
  };
  constexpr unsigned int max_nodes = 9, max_points = 9, max_dofs = 22;

  enum class ElementKind
  {
    q2,
    q1_mean_dilation,
    q2_cosserat,
    q2_gradient
  };

  template <class Action> decltype(auto) with_element(const ElementKind kind, Action &&action)
  {
    switch (kind)
      {
      case ElementKind::q2:
        return std::forward<Action>(action)(Q2());
      case ElementKind::q1_mean_dilation:
        return std::forward<Action>(action)(Q1MeanDilation());
      case ElementKind::q2_gradient:
        return std::forward<Action>(action)(Q2Gradient());
      default:
        return std::forward<Action>(action)(Q2Cosserat());
      }
  }

  // Shape functions at the Gauss points of the unit square. Nodes have the order of deal.II's FE_Q: corners in lexicographic
  // order, then the midpoints of the left, right, lower and upper edge, then the centre.
  struct ReferenceElement
  {
    explicit ReferenceElement(ElementKind kind);

    unsigned int                                   n_nodes, n_rotations, n_points, n_dofs;
    std::vector<dealii::Point<2>>                  nodes, points;
    std::vector<double>                            weights;           // weights of the points; sum 1
    std::vector<std::vector<double>>               shape;             // [point][node]
    std::vector<std::vector<dealii::Tensor<1, 2>>> gradient;          // [point][node], derivative by the unit coordinates
    std::vector<std::vector<double>>               rotation_shape;    // [point][corner]
    std::vector<std::vector<dealii::Tensor<1, 2>>> rotation_gradient; // [point][corner]
  };

  // Values of Lagrange polynomials at a point of the unit square. The first function uses the nodes of FE_Q(degree), the second
  // the (degree + 1)^2 Gauss points in the order of the element's points.
  std::vector<double> nodal_interpolation(unsigned int degree, const dealii::Point<2> &at);
  std::vector<double> gauss_interpolation(unsigned int degree, const dealii::Point<2> &at);
} // namespace diptych::continuum
