// diptych: strain, nodal force and stiffness of one element
// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <array>

#include "continuum/elements/discretisation.h"
#include "continuum/laws/law.h"

namespace diptych::continuum
{
  template <class Element> using ElementVector = std::array<double, Element::n_dofs>;
  // Rows padded to a whole number of vector registers.
  template <class Element> constexpr unsigned int row_length = (Element::n_dofs + 3) / 4 * 4;
  template <class Element> using ElementMatrix               = std::array<double, Element::n_dofs * row_length<Element>>;

  // The fourth strain is curl u - 2 omega for a rotation omega, but the unknown itself for a nonlocal hardening variable.
  template <class Element> constexpr bool   has_skew      = Element::n_rotations > 0 && !Element::is_gradient;
  template <class Element> constexpr double corner_factor = Element::is_gradient ? 1 : -2;

  // Mean dilation adds d . u to both normal strains, d = (mean gradient - gradient)/2, so that e_xx + e_yy is the element's
  // mean.
  inline dealii::Tensor<1, 2> dilation_excess(const CellGeometry &cell, const unsigned int q, const unsigned int node)
  {
    return 0.5 * (cell.mean_gradient[node] - cell.points[q].gradient[node]);
  }

  // Components as in Strain.
  template <class Element>
  Strain strain_at(const ReferenceElement       &reference,
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
    Strain strain;
    strain[xx]                = ux_x + excess;
    strain[yy]                = uy_y + excess;
    strain[xy]                = ux_y + uy_x;
    strain[relative_rotation] = Element::is_gradient ? 0 : uy_x - ux_y;
    for (unsigned int corner = 0; corner < Element::n_rotations; ++corner)
      {
        const double omega = u[2 * Element::n_nodes + corner];
        strain[relative_rotation] += corner_factor<Element> * reference.rotation_shape[q][corner] * omega;
        strain[curvature_x] += point.rotation_gradient[corner][0] * omega;
        strain[curvature_y] += point.rotation_gradient[corner][1] * omega;
      }
    return strain;
  }

  // force += B^T stress area
  template <class Element>
  void add_stress(const ReferenceElement &reference,
                  const CellGeometry     &cell,
                  const unsigned int      q,
                  const Stress           &stress,
                  ElementVector<Element> &force)
  {
    const auto  &point = cell.points[q];
    const Stress s     = point.area * stress;
    const double skew  = has_skew<Element> ? s[relative_rotation] : 0;
    for (unsigned int node = 0; node < Element::n_nodes; ++node)
      {
        const auto &g = point.gradient[node];
        force[2 * node] += g[0] * s[xx] + g[1] * (s[xy] - skew);
        force[2 * node + 1] += g[1] * s[yy] + g[0] * (s[xy] + skew);
        if constexpr (Element::mean_dilation)
          {
            const auto d = dilation_excess(cell, q, node);
            force[2 * node] += d[0] * (s[xx] + s[yy]);
            force[2 * node + 1] += d[1] * (s[xx] + s[yy]);
          }
      }
    for (unsigned int corner = 0; corner < Element::n_rotations; ++corner)
      force[2 * Element::n_nodes + corner] += point.rotation_gradient[corner][0] * s[curvature_x] +
                                              point.rotation_gradient[corner][1] * s[curvature_y] +
                                              corner_factor<Element> * reference.rotation_shape[q][corner] * s[relative_rotation];
  }

  // K += B^T D B area. Both products use that each column of B has at most four non-zero entries.
  template <class Element>
  void add_stiffness(const ReferenceElement &reference,
                     const CellGeometry     &cell,
                     const unsigned int      q,
                     const Tangent          &tangent,
                     ElementMatrix<Element> &K)
  {
    constexpr unsigned int n_strains             = Element::n_rotations > 0 ? n_components : n_classical;
    constexpr unsigned int length                = row_length<Element>;
    const auto            &point                 = cell.points[q];
    double                 DB[n_strains][length] = {};
    for (unsigned int k = 0; k < n_strains; ++k)
      {
        const auto  &D    = tangent[k];
        const double skew = has_skew<Element> ? D[relative_rotation] : 0;
        for (unsigned int node = 0; node < Element::n_nodes; ++node)
          {
            const double gx = point.area * point.gradient[node][0], gy = point.area * point.gradient[node][1];
            DB[k][2 * node]     = D[xx] * gx + (D[xy] - skew) * gy;
            DB[k][2 * node + 1] = D[yy] * gy + (D[xy] + skew) * gx;
            if constexpr (Element::mean_dilation)
              {
                const auto d = point.area * dilation_excess(cell, q, node);
                DB[k][2 * node] += (D[xx] + D[yy]) * d[0];
                DB[k][2 * node + 1] += (D[xx] + D[yy]) * d[1];
              }
          }
        for (unsigned int corner = 0; corner < Element::n_rotations; ++corner)
          DB[k][2 * Element::n_nodes + corner] = point.area * (point.rotation_gradient[corner][0] * D[curvature_x] +
                                                               point.rotation_gradient[corner][1] * D[curvature_y] +
                                                               corner_factor<Element> * reference.rotation_shape[q][corner] *
                                                                 D[relative_rotation]);
      }
    for (unsigned int node = 0; node < Element::n_nodes; ++node)
      {
        const double gx = point.gradient[node][0], gy = point.gradient[node][1];
        double      *row_x = &K[2 * node * length], *row_y = row_x + length;
        double       dx = 0, dy = 0;
        if constexpr (Element::mean_dilation)
          {
            const auto d = dilation_excess(cell, q, node);
            dx           = d[0];
            dy           = d[1];
          }
        for (unsigned int j = 0; j < length; ++j)
          {
            const double skew = has_skew<Element> ? DB[has_skew<Element> ? int(relative_rotation) : 0][j] : 0;
            row_x[j] += gx * DB[xx][j] + gy * (DB[xy][j] - skew);
            row_y[j] += gy * DB[yy][j] + gx * (DB[xy][j] + skew);
            if constexpr (Element::mean_dilation)
              {
                row_x[j] += dx * (DB[xx][j] + DB[yy][j]);
                row_y[j] += dy * (DB[xx][j] + DB[yy][j]);
              }
          }
      }
    if constexpr (n_strains > n_classical)
      for (unsigned int corner = 0; corner < Element::n_rotations; ++corner)
        {
          double      *row = &K[(2 * Element::n_nodes + corner) * length];
          const double wx = point.rotation_gradient[corner][0], wy = point.rotation_gradient[corner][1],
                       w = corner_factor<Element> * reference.rotation_shape[q][corner];
          for (unsigned int j = 0; j < length; ++j)
            row[j] += wx * DB[curvature_x][j] + wy * DB[curvature_y][j] + w * DB[relative_rotation][j];
        }
  }
} // namespace diptych::continuum
