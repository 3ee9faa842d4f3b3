// diptych: motion, nodal force and stiffness of one element
// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <array>

#include "continuum/elements/discretisation.h"
#include "continuum/elements/increment.h"

namespace diptych::continuum
{
  template <class Element> using ElementVector = std::array<double, Element::n_dofs>;
  // Rows padded to a whole number of vector registers.
  template <class Element> constexpr unsigned int row_length = (Element::n_dofs + 3) / 4 * 4;
  template <class Element> using ElementMatrix               = std::array<double, Element::n_dofs * row_length<Element>>;

  // Number of entries of Motion that an element has.
  template <class Element> constexpr unsigned int motions_of = Element::n_rotations > 0 ? n_motions : n_classical_motions;

  // Mean dilation adds d . u to du_x/dx and du_y/dy, d = (mean gradient - gradient)/2, so that their sum is the element's mean.
  inline dealii::Tensor<1, 2> dilation_excess(const CellGeometry &cell, const unsigned int q, const unsigned int node)
  {
    return 0.5 * (cell.mean_gradient[node] - cell.points[q].gradient[node]);
  }

  template <class Element>
  Motion motion_at(const ReferenceElement       &reference,
                   const CellGeometry           &cell,
                   const unsigned int            q,
                   const ElementVector<Element> &u)
  {
    const auto &point = cell.points[q];
    double      ux_x = 0, ux_y = 0, uy_x = 0, uy_y = 0, excess = 0;
    for (unsigned int node = 0; node < Element::n_nodes; ++node)
      {
        const auto &g = point.gradient[node];
        ux_x += g[0] * u[2 * node];
        ux_y += g[1] * u[2 * node];
        uy_x += g[0] * u[2 * node + 1];
        uy_y += g[1] * u[2 * node + 1];
        if constexpr (Element::mean_dilation)
          {
            const auto d = dilation_excess(cell, q, node);
            excess += d[0] * u[2 * node] + d[1] * u[2 * node + 1];
          }
      }
    Motion m;
    m[0] = ux_x + excess;
    m[1] = ux_y;
    m[2] = uy_x;
    m[3] = uy_y + excess;
    for (unsigned int corner = 0; corner < Element::n_rotations; ++corner)
      {
        const double omega = u[2 * Element::n_nodes + corner];
        m[4] += reference.rotation_shape[q][corner] * omega;
        m[5] += point.rotation_gradient[corner][0] * omega;
        m[6] += point.rotation_gradient[corner][1] * omega;
      }
    return m;
  }

  // force += (d motion / d u)^T stress area
  template <class Element>
  void add_force(const ReferenceElement &reference,
                 const CellGeometry     &cell,
                 const unsigned int      q,
                 const PiolaStress      &stress,
                 ElementVector<Element> &force)
  {
    const auto       &point = cell.points[q];
    const PiolaStress s     = point.area * stress;
    for (unsigned int node = 0; node < Element::n_nodes; ++node)
      {
        const auto &g = point.gradient[node];
        force[2 * node] += g[0] * s[0] + g[1] * s[1];
        force[2 * node + 1] += g[0] * s[2] + g[1] * s[3];
        if constexpr (Element::mean_dilation)
          {
            const auto d = dilation_excess(cell, q, node);
            force[2 * node] += d[0] * (s[0] + s[3]);
            force[2 * node + 1] += d[1] * (s[0] + s[3]);
          }
      }
    for (unsigned int corner = 0; corner < Element::n_rotations; ++corner)
      force[2 * Element::n_nodes + corner] += reference.rotation_shape[q][corner] * s[4] +
                                              point.rotation_gradient[corner][0] * s[5] +
                                              point.rotation_gradient[corner][1] * s[6];
  }

  // K += (d motion / d u)^T tangent (d motion / d u) area
  template <class Element>
  void add_stiffness(const ReferenceElement &reference,
                     const CellGeometry     &cell,
                     const unsigned int      q,
                     const PiolaTangent     &tangent,
                     ElementMatrix<Element> &K)
  {
    constexpr unsigned int n = motions_of<Element>, length = row_length<Element>;
    const auto            &point         = cell.points[q];
    double                 DB[n][length] = {}; // tangent (d motion / d u) area
    for (unsigned int k = 0; k < n; ++k)
      {
        const auto &D = tangent[k];
        for (unsigned int node = 0; node < Element::n_nodes; ++node)
          {
            const double gx = point.area * point.gradient[node][0], gy = point.area * point.gradient[node][1];
            DB[k][2 * node]     = D[0] * gx + D[1] * gy;
            DB[k][2 * node + 1] = D[2] * gx + D[3] * gy;
            if constexpr (Element::mean_dilation)
              {
                const auto d = point.area * dilation_excess(cell, q, node);
                DB[k][2 * node] += (D[0] + D[3]) * d[0];
                DB[k][2 * node + 1] += (D[0] + D[3]) * d[1];
              }
          }
        for (unsigned int corner = 0; corner < Element::n_rotations; ++corner)
          DB[k][2 * Element::n_nodes + corner] = point.area * (reference.rotation_shape[q][corner] * D[4] +
                                                               point.rotation_gradient[corner][0] * D[5] +
                                                               point.rotation_gradient[corner][1] * D[6]);
      }
    for (unsigned int node = 0; node < Element::n_nodes; ++node)
      {
        const double gx = point.gradient[node][0], gy = point.gradient[node][1];
        double      *row_x = &K[2 * node * length], *row_y = row_x + length;
        for (unsigned int j = 0; j < length; ++j)
          {
            row_x[j] += gx * DB[0][j] + gy * DB[1][j];
            row_y[j] += gx * DB[2][j] + gy * DB[3][j];
          }
        if constexpr (Element::mean_dilation)
          {
            const auto d = dilation_excess(cell, q, node);
            for (unsigned int j = 0; j < length; ++j)
              {
                row_x[j] += d[0] * (DB[0][j] + DB[3][j]);
                row_y[j] += d[1] * (DB[0][j] + DB[3][j]);
              }
          }
      }
    if constexpr (n > n_classical_motions)
      for (unsigned int corner = 0; corner < Element::n_rotations; ++corner)
        {
          double      *row = &K[(2 * Element::n_nodes + corner) * length];
          const double wx = point.rotation_gradient[corner][0], wy = point.rotation_gradient[corner][1],
                       w = reference.rotation_shape[q][corner];
          for (unsigned int j = 0; j < length; ++j)
            row[j] += w * DB[4][j] + wx * DB[5][j] + wy * DB[6][j];
        }
  }
} // namespace diptych::continuum
