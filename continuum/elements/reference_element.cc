// diptych: elements of the continuum panel on the unit square
// SPDX-License-Identifier: LGPL-2.1-or-later
#include "continuum/elements/reference_element.h"

#include <deal.II/base/quadrature_lib.h>
#include <deal.II/fe/fe_dgq.h>
#include <deal.II/fe/fe_q.h>

namespace diptych::continuum
{
  using namespace dealii;

  namespace
  {
    std::vector<double> values_at(const FiniteElement<2> &element, const Point<2> &at)
    {
      std::vector<double> values;
      for (unsigned int i = 0; i < element.n_dofs_per_cell(); ++i)
        values.push_back(element.shape_value(i, at));
      return values;
    }

    std::vector<Tensor<1, 2>> gradients_at(const FiniteElement<2> &element, const Point<2> &at)
    {
      std::vector<Tensor<1, 2>> gradients;
      for (unsigned int i = 0; i < element.n_dofs_per_cell(); ++i)
        gradients.push_back(element.shape_grad(i, at));
      return gradients;
    }
  } // namespace

  ReferenceElement::ReferenceElement(const ElementKind kind)
  {
    with_element(kind, [&](const auto chosen) {
      n_nodes     = chosen.n_nodes;
      n_rotations = chosen.n_rotations;
      n_points    = chosen.n_points;
      n_dofs      = chosen.n_dofs;
      const FE_Q<2>   displacement(chosen.degree), rotation(1);
      const QGauss<2> quadrature(chosen.degree + 1);
      nodes   = displacement.get_unit_support_points();
      points  = quadrature.get_points();
      weights = quadrature.get_weights();
      for (const auto &point : points)
        {
          shape.push_back(values_at(displacement, point));
          gradient.push_back(gradients_at(displacement, point));
          rotation_shape.push_back(values_at(rotation, point));
          rotation_gradient.push_back(gradients_at(rotation, point));
        }
    });
  }

  std::vector<double> nodal_interpolation(const unsigned int degree, const Point<2> &at)
  {
    return values_at(FE_Q<2>(degree), at);
  }

  std::vector<double> gauss_interpolation(const unsigned int degree, const Point<2> &at)
  {
    return values_at(FE_DGQArbitraryNodes<2>(QGauss<1>(degree + 1)), at);
  }
} // namespace diptych::continuum
