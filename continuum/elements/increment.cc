// diptych: strain increment of a point, and the nodal forces of its stress
// SPDX-License-Identifier: LGPL-2.1-or-later
#include "continuum/elements/increment.h"

#include <cmath>

namespace diptych::continuum
{
  namespace
  {
    enum
    {
      ux_x,
      ux_y,
      uy_x,
      uy_y,
      omega,
      omega_x,
      omega_y
    };

    // Force per area: symmetric part and skew part act on the displacement, twice the skew part against the rotation.
    PiolaStress unturned(const Stress &s)
    {
      PiolaStress p;
      p[ux_x]    = s[xx];
      p[ux_y]    = s[xy] - s[relative_rotation];
      p[uy_x]    = s[xy] + s[relative_rotation];
      p[uy_y]    = s[yy];
      p[omega]   = -2 * s[relative_rotation];
      p[omega_x] = s[curvature_x];
      p[omega_y] = s[curvature_y];
      return p;
    }

    Strain small_strain(const Motion &m)
    {
      Strain e;
      e[xx]                = m[ux_x];
      e[yy]                = m[uy_y];
      e[xy]                = m[ux_y] + m[uy_x];
      e[relative_rotation] = m[uy_x] - m[ux_y] - 2 * m[omega];
      e[curvature_x]       = m[omega_x];
      e[curvature_y]       = m[omega_y];
      return e;
    }
  } // namespace

  Increment::Increment(const Motion &motion, const bool is_finite, const bool is_gradient)
      : strain_(small_strain(motion)),
        is_finite(is_finite),
        is_gradient(is_gradient)
  {
    if (is_finite)
      find_strain(motion);
    if (is_gradient)
      for (unsigned int k = 0; k < n_components - nonlocal; ++k)
        strain_[nonlocal + k] = motion[omega + k];
  }

  // The part that acts on the displacement.
  Stress Increment::classical(const Stress &stress) const
  {
    Stress s = stress;
    if (is_gradient)
      s[nonlocal] = s[nonlocal_x] = s[nonlocal_y] = 0;
    return s;
  }

  void Increment::add_nonlocal(PiolaStress &force, const Stress &stress) const
  {
    if (is_gradient)
      for (unsigned int k = 0; k < n_components - nonlocal; ++k)
        force[omega + k] = stress[nonlocal + k];
  }

  void Increment::find_strain(const Motion &m)
  {
    const double F[2][2] = {{1 + m[ux_x], m[ux_y]}, {m[uy_x], 1 + m[uy_y]}};
    cofactor[0][0] = F[1][1], cofactor[0][1] = -F[1][0], cofactor[1][0] = -F[0][1], cofactor[1][1] = F[0][0];
    determinant = F[0][0] * F[1][1] - F[0][1] * F[1][0];

    const double mid[2][2] = {{1 + m[ux_x] / 2, m[ux_y] / 2}, {m[uy_x] / 2, 1 + m[uy_y] / 2}};
    const double det       = mid[0][0] * mid[1][1] - mid[0][1] * mid[1][0];
    to_mid[0][0] = mid[1][1] / det, to_mid[0][1] = -mid[0][1] / det;
    to_mid[1][0] = -mid[1][0] / det, to_mid[1][1] = mid[0][0] / det;
    const auto by_mid = [&](const double x, const double y, const unsigned int k) { return x * to_mid[0][k] + y * to_mid[1][k]; };
    const double exx = by_mid(m[ux_x], m[ux_y], 0), eyy = by_mid(m[uy_x], m[uy_y], 1);
    const double xy_part = by_mid(m[ux_x], m[ux_y], 1), yx_part = by_mid(m[uy_x], m[uy_y], 0);
    mid_gradient[0] = by_mid(m[omega_x], m[omega_y], 0), mid_gradient[1] = by_mid(m[omega_x], m[omega_y], 1);

    const double t = (yx_part - xy_part) / 4; // tan(angle/2)
    angle_by_spin  = 1 / (1 + t * t);
    cosine         = (1 - t * t) * angle_by_spin;
    sine           = 2 * t * angle_by_spin;
    half_cosine    = std::sqrt(angle_by_spin);
    half_sine      = t * half_cosine;
    angle_         = 2 * std::atan(t);

    const double mean = (exx + eyy) / 2, a = (exx - eyy) / 2, b = (xy_part + yx_part) / 2;
    strain_[xx]                = mean + cosine * a + sine * b;
    strain_[yy]                = mean - cosine * a - sine * b;
    strain_[xy]                = 2 * (cosine * b - sine * a);
    strain_[relative_rotation] = 2 * (angle_ - m[omega]);
    strain_[curvature_x]       = half_cosine * mid_gradient[0] + half_sine * mid_gradient[1];
    strain_[curvature_y]       = half_cosine * mid_gradient[1] - half_sine * mid_gradient[0];
  }

  // The skew part does not depend on the frame.
  Stress Increment::turned(const Stress &stress) const
  {
    const Stress s    = classical(stress);
    const double mean = (s[xx] + s[yy]) / 2, a = (s[xx] - s[yy]) / 2, cos2 = cosine * cosine - sine * sine,
                 sin2 = 2 * cosine * sine;
    Stress t          = s;
    t[xx]             = mean + a * cos2 - s[xy] * sin2;
    t[yy]             = mean - a * cos2 + s[xy] * sin2;
    t[xy]             = a * sin2 + s[xy] * cos2;
    t[curvature_x]    = cosine * s[curvature_x] - sine * s[curvature_y];
    t[curvature_y]    = sine * s[curvature_x] + cosine * s[curvature_y];
    return t;
  }

  namespace
  {
    // From the force per area at the end to that at the start.
    void pull_back(PiolaStress &p, const double (&cofactor)[2][2], const double determinant)
    {
      for (const unsigned int row : {unsigned(ux_x), unsigned(uy_x), unsigned(omega_x)})
        {
          const double x = p[row], y = p[row + 1];
          p[row]     = x * cofactor[0][0] + y * cofactor[1][0];
          p[row + 1] = x * cofactor[0][1] + y * cofactor[1][1];
        }
      p[omega] *= determinant;
    }
  } // namespace

  PiolaStress Increment::force(const Stress &stress) const
  {
    PiolaStress p = unturned(is_finite ? turned(stress) : classical(stress));
    if (is_finite)
      pull_back(p, cofactor, determinant);
    add_nonlocal(p, stress);
    return p;
  }

  // d strain / d motion[k]. With B = to_mid, the gradient on the middle shape changes by B dF B.
  Strain Increment::change_of_strain(const unsigned int k, double &d_angle) const
  {
    Strain d;
    double d_gradient[2] = {0, 0};
    d_angle              = 0;
    if (k == omega)
      d[relative_rotation] = -2;
    else if (k >= omega_x)
      d_gradient[0] = to_mid[k - omega_x][0], d_gradient[1] = to_mid[k - omega_x][1];
    else
      {
        const unsigned int i = k / 2, j = k % 2;
        const double       exx = to_mid[0][i] * to_mid[j][0], eyy = to_mid[1][i] * to_mid[j][1];
        const double       xy_part = to_mid[0][i] * to_mid[j][1], yx_part = to_mid[1][i] * to_mid[j][0];
        d_angle           = angle_by_spin * (yx_part - xy_part) / 2;
        const double mean = (exx + eyy) / 2, a = (exx - eyy) / 2, b = (xy_part + yx_part) / 2;
        const double d_a     = cosine * a + sine * b + d_angle * strain_[xy] / 2;
        d[xx]                = mean + d_a;
        d[yy]                = mean - d_a;
        d[xy]                = 2 * (cosine * b - sine * a) - d_angle * (strain_[xx] - strain_[yy]);
        d[relative_rotation] = 2 * d_angle;
        for (const unsigned int c : {0u, 1u})
          d_gradient[c] = -mid_gradient[i] * to_mid[j][c] / 2;
      }
    d[curvature_x] = half_cosine * d_gradient[0] + half_sine * d_gradient[1] + d_angle / 2 * strain_[curvature_y];
    d[curvature_y] = half_cosine * d_gradient[1] - half_sine * d_gradient[0] - d_angle / 2 * strain_[curvature_x];
    if (is_gradient)
      {
        d = classical(d);
        if (k >= omega)
          d[nonlocal + k - omega] = 1;
      }
    return d;
  }

  PiolaTangent Increment::small_tangent(const Tangent &law) const
  {
    PiolaTangent result;
    for (unsigned int k = 0; k < n_motions; ++k)
      {
        Motion unit;
        unit[k]               = 1;
        const Stress d_stress = law * Increment(unit, false, is_gradient).strain();
        PiolaStress  p        = unturned(classical(d_stress));
        add_nonlocal(p, d_stress);
        for (unsigned int row = 0; row < n_motions; ++row)
          result[row][k] = p[row];
      }
    return result;
  }

  PiolaTangent Increment::tangent(const Stress &stress, const Tangent &law, const unsigned int n_columns) const
  {
    if (!is_finite)
      return small_tangent(law);
    const Stress      t    = turned(stress);
    const PiolaStress full = unturned(t);
    PiolaTangent      result;
    for (unsigned int k = 0; k < n_columns; ++k)
      {
        double       d_angle  = 0;
        const Strain d_strain = change_of_strain(k, d_angle);
        const Stress in_law   = law * d_strain;
        Stress       d_stress = turned(in_law);
        d_stress[xx] -= 2 * d_angle * t[xy];
        d_stress[yy] += 2 * d_angle * t[xy];
        d_stress[xy] += d_angle * (t[xx] - t[yy]);
        d_stress[curvature_x] -= d_angle * t[curvature_y];
        d_stress[curvature_y] += d_angle * t[curvature_x];
        PiolaStress d_force = unturned(d_stress);
        pull_back(d_force, cofactor, determinant);
        if (k < n_classical_motions)
          {
            // d cofactor is +-1 in the entry opposite to the changed one of F.
            const unsigned int i = 1 - k / 2, j = 1 - k % 2;
            const double       sign = k == ux_x || k == uy_y ? 1 : -1;
            for (const unsigned int row : {unsigned(ux_x), unsigned(uy_x), unsigned(omega_x)})
              d_force[row + j] += sign * full[row + i];
            d_force[omega] += full[omega] * cofactor[k / 2][k % 2];
          }
        add_nonlocal(d_force, in_law);
        for (unsigned int row = 0; row < n_motions; ++row)
          result[row][k] = d_force[row];
      }
    return result;
  }
} // namespace diptych::continuum
