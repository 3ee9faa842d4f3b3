// diptych: strain increment of a point, and the nodal forces of its stress
// SPDX-License-Identifier: LGPL-2.1-or-later
#include "continuum/elements/increment.h"

#include <algorithm>
#include <array>
#include <cmath>

#include <Eigen/Core>

#include <deal.II/base/array_view.h>

#include "continuum/laws/rotation.h"

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

    // Numbers, or rows with one entry per motion: derivatives by all of them at once.
    template <class V> using Stresses = std::array<V, n_components>;
    template <class V> using Forces   = std::array<V, n_motions>;
    using Row                         = Eigen::Array<double, 1, 8>;

    // Symmetric and skew part act on the displacement, twice the skew part against the rotation.
    template <class V> Forces<V> forces(const Stresses<V> &s)
    {
      const V &a = s[relative_rotation];
      return {s[xx], s[xy] - a, s[xy] + a, s[yy], -2 * a, s[curvature_x], s[curvature_y]};
    }

    constexpr unsigned int n_nonlocal = 3; // the nonlocal hardening variable and its gradient

    // Takes the nonlocal part out of a stress. It has no skew part and does not turn.
    template <class V> std::array<V, n_nonlocal> separated(Stresses<V> &s)
    {
      const std::array<V, n_nonlocal> part = {s[nonlocal], s[nonlocal_x], s[nonlocal_y]};
      for (unsigned int k = 0; k < n_nonlocal; ++k)
        s[nonlocal + k] = V(0 * part[k]);
      return part;
    }

    template <class V> Forces<V> forces(Stresses<V> s, const bool is_gradient)
    {
      if (!is_gradient)
        return forces(s);
      const auto part = separated(s);
      Forces<V>  p    = forces(s);
      std::copy(part.begin(), part.end(), p.begin() + omega);
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

    template <class V> Stresses<V> turned(Stresses<V> s, const double cosine, const double sine)
    {
      turn_tensor(s[xx], s[yy], s[xy], cosine, sine);
      turn_vector(s[curvature_x], s[curvature_y], cosine, sine);
      return s;
    }

    // Converts a force per area at the end of the step to one per area at its start.
    template <class V> void pull_back(Forces<V> &p, const double (&cofactor)[2][2], const double determinant)
    {
      for (const unsigned int k : {unsigned(ux_x), unsigned(uy_x), unsigned(omega_x)})
        {
          const V x = p[k], y = p[k + 1];
          p[k]     = x * cofactor[0][0] + y * cofactor[1][0];
          p[k + 1] = x * cofactor[0][1] + y * cofactor[1][1];
        }
      p[omega] *= determinant;
    }

    Stresses<double> entries(const Stress &s)
    {
      return {s[0], s[1], s[2], s[3], s[4], s[5]};
    }

    Stresses<Row> product(const Tangent &law, const Stresses<Row> &d_strain)
    {
      Stresses<Row> d_stress;
      for (unsigned int i = 0; i < n_components; ++i)
        {
          d_stress[i] = law[i][0] * d_strain[0];
          for (unsigned int j = 1; j < n_components; ++j)
            d_stress[i] += law[i][j] * d_strain[j];
        }
      return d_stress;
    }

    PiolaTangent table(const Forces<Row> &rows)
    {
      PiolaTangent result;
      for (unsigned int i = 0; i < n_motions; ++i)
        for (unsigned int k = 0; k < n_motions; ++k)
          result[i][k] = rows[i][k];
      return result;
    }

    // The strain is linear in the motion, by the transpose of forces().
    PiolaTangent small_tangent(const Tangent &law, const bool is_gradient)
    {
      Stresses<Row> d_stress;
      for (unsigned int i = 0; i < n_components; ++i)
        {
          const Forces<double> by_motion = forces(entries(law[i]), is_gradient);
          d_stress[i].setZero();
          std::copy(by_motion.begin(), by_motion.end(), d_stress[i].data());
        }
      return table(forces(d_stress, is_gradient));
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
      for (unsigned int k = 0; k < n_nonlocal; ++k)
        strain_[nonlocal + k] = motion[omega + k];
  }

  void Increment::find_strain(const Motion &m)
  {
    const double F[2][2] = {{1 + m[ux_x], m[ux_y]}, {m[uy_x], 1 + m[uy_y]}};
    cofactor[0][0]       = F[1][1];
    cofactor[0][1]       = -F[1][0];
    cofactor[1][0]       = -F[0][1];
    cofactor[1][1]       = F[0][0];
    determinant          = F[0][0] * F[1][1] - F[0][1] * F[1][0];

    const double mid[2][2] = {{1 + m[ux_x] / 2, m[ux_y] / 2}, {m[uy_x] / 2, 1 + m[uy_y] / 2}};
    const double det       = mid[0][0] * mid[1][1] - mid[0][1] * mid[1][0];
    to_mid[0][0]           = mid[1][1] / det;
    to_mid[0][1]           = -mid[0][1] / det;
    to_mid[1][0]           = -mid[1][0] / det;
    to_mid[1][1]           = mid[0][0] / det;
    const auto by_mid = [&](const double x, const double y, const unsigned int k) { return x * to_mid[0][k] + y * to_mid[1][k]; };
    const double exx = by_mid(m[ux_x], m[ux_y], 0), eyy = by_mid(m[uy_x], m[uy_y], 1);
    const double xy_part = by_mid(m[ux_x], m[ux_y], 1), yx_part = by_mid(m[uy_x], m[uy_y], 0);
    mid_gradient[0] = by_mid(m[omega_x], m[omega_y], 0);
    mid_gradient[1] = by_mid(m[omega_x], m[omega_y], 1);

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

  PiolaStress Increment::force(const Stress &stress) const
  {
    Stresses<double> s    = entries(stress);
    const auto       part = is_gradient ? separated(s) : std::array<double, n_nonlocal>();
    Forces<double>   p    = forces(is_finite ? turned(s, cosine, sine) : s);
    if (is_finite)
      pull_back(p, cofactor, determinant);
    if (is_gradient)
      std::copy(part.begin(), part.end(), p.begin() + omega);
    return PiolaStress(dealii::ArrayView<const double>(p.data(), n_motions));
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
      std::copy(to_mid[k - omega_x], to_mid[k - omega_x] + 2, d_gradient);
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
      for (unsigned int i = 0; i < n_nonlocal; ++i)
        d[nonlocal + i] = k == omega + i;
    return d;
  }

  PiolaTangent Increment::tangent(const Stress &stress, const Tangent &law) const
  {
    if (!is_finite)
      return small_tangent(law, is_gradient);
    Stresses<Row> d_strain;
    d_strain.fill(Row::Zero());
    Row d_angle = Row::Zero();
    for (unsigned int k = 0; k < n_motions; ++k)
      {
        const Strain d = change_of_strain(k, d_angle[k]);
        for (unsigned int i = 0; i < n_components; ++i)
          d_strain[i][k] = d[i];
      }
    Stresses<double>            t        = entries(stress);
    Stresses<Row>               d_stress = product(law, d_strain);
    std::array<Row, n_nonlocal> part;
    if (is_gradient)
      {
        part = separated(d_stress);
        separated(t);
      }
    t        = turned(t, cosine, sine);
    d_stress = turned(d_stress, cosine, sine);
    d_stress[xx] -= 2 * t[xy] * d_angle;
    d_stress[yy] += 2 * t[xy] * d_angle;
    d_stress[xy] += (t[xx] - t[yy]) * d_angle;
    d_stress[curvature_x] -= t[curvature_y] * d_angle;
    d_stress[curvature_y] += t[curvature_x] * d_angle;

    Forces<Row>          d_force = forces(d_stress);
    const Forces<double> full    = forces(t);
    pull_back(d_force, cofactor, determinant);
    for (unsigned int k = 0; k < n_classical_motions; ++k)
      {
        // d cofactor is +-1 in the entry opposite to the changed one of F.
        const unsigned int i = 1 - k / 2, j = 1 - k % 2;
        const double       sign = k == ux_x || k == uy_y ? 1 : -1;
        for (const unsigned int row : {unsigned(ux_x), unsigned(uy_x), unsigned(omega_x)})
          d_force[row + j][k] += sign * full[row + i];
        d_force[omega][k] += full[omega] * cofactor[k / 2][k % 2];
      }
    if (is_gradient)
      std::copy(part.begin(), part.end(), d_force.begin() + omega);
    return table(d_force);
  }
} // namespace diptych::continuum
