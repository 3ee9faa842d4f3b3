// diptych: example of a law in a library: perfectly plastic Mohr-Coulomb in plane strain
// SPDX-License-Identifier: LGPL-2.1-or-later
//
//     c++ -std=c++17 -shared -fPIC -O2 -I/usr/include/diptych -o mohr_coulomb.so mohr_coulomb.cc
//
// Tension is positive, s1 >= s2 >= s3 are the principal stresses. F = (s1 - s3)/2 + (s1 + s3)/2 sin(phi) - c cos(phi), flow by
// the same function with psi. The trial stress returns to one plane, an edge of two planes or the tip (Koiter 1953).
#include <array>
#include <cmath>
#include <utility>
#include <vector>

#include "diptych_law.h"

namespace
{
  using Vector = std::array<double, 3>; // of the sorted principal values

  enum
  {
    youngs_modulus,
    poisson_ratio,
    friction_angle,
    dilatancy_angle,
    cohesion,
    n_parameters
  };

  const diptych_parameter parameters[n_parameters] = {{"youngs_modulus", DIPTYCH_STRESS, "Young's modulus", 500, 1e-3, 1e12},
                                                      {"poisson_ratio", "-", "Poisson's ratio", 0.2, 0, 0.49},
                                                      {"friction_angle", "degrees", "friction angle", 20.5, 0, 60},
                                                      {"dilatancy_angle", "degrees", "dilatancy angle", 12, 0, 60},
                                                      {"cohesion", DIPTYCH_STRESS, "cohesion", 0.01, 1e-9, 1e12}};

  const diptych_law law = {DIPTYCH_LAW_INTERFACE, 3, n_parameters, parameters, 0, nullptr};

  double dot(const Vector &a, const Vector &b)
  {
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
  }

  struct Material
  {
    double shear, lame, sin_phi, sin_psi, cos_phi, cohesion;

    explicit Material(const double *p)
    {
      const double degree = std::acos(-1.) / 180, E = p[youngs_modulus], nu = p[poisson_ratio];
      shear    = E / (2 * (1 + nu));
      lame     = E * nu / ((1 + nu) * (1 - 2 * nu));
      sin_phi  = std::sin(p[friction_angle] * degree);
      cos_phi  = std::cos(p[friction_angle] * degree);
      sin_psi  = std::sin(p[dilatancy_angle] * degree);
      cohesion = p[::cohesion];
    }
    Vector stiff(const Vector &e) const
    {
      const double mean = lame * (e[0] + e[1] + e[2]);
      return {mean + 2 * shear * e[0], mean + 2 * shear * e[1], mean + 2 * shear * e[2]};
    }
    double yield(const Vector &s, int i, int k) const
    {
      return (s[i] - s[k]) / 2 + (s[i] + s[k]) / 2 * sin_phi - cohesion * cos_phi;
    }
  };

  struct Return
  {
    Vector         stress, plastic = {};
    double         jacobian[3][3] = {}; // d stress / d trial stress
    double         multiplier = 0, least = 0;
    diptych_branch branch = DIPTYCH_PLASTIC;
  };

  Vector normal(int i, int k, double sine)
  {
    Vector v = {};
    v[i] = (1 + sine) / 2, v[k] = (sine - 1) / 2;
    return v;
  }

  // Return to one or two planes, each given by its major and minor stress.
  Return to_planes(const Material &m, const Vector &trial, const std::vector<std::pair<int, int>> &planes)
  {
    const std::size_t n       = planes.size();
    double            M[2][2] = {{0, 0}, {0, 1}}, F[2] = {};
    Vector            a[2] = {}, b[2] = {}, Db[2] = {};
    for (std::size_t i = 0; i < n; ++i)
      {
        a[i]  = normal(planes[i].first, planes[i].second, m.sin_phi);
        b[i]  = normal(planes[i].first, planes[i].second, m.sin_psi);
        Db[i] = m.stiff(b[i]);
        F[i]  = m.yield(trial, planes[i].first, planes[i].second);
      }
    for (std::size_t i = 0; i < n; ++i)
      for (std::size_t k = 0; k < n; ++k)
        M[i][k] = dot(a[i], Db[k]);
    const double det           = M[0][0] * M[1][1] - M[0][1] * M[1][0];
    const double inverse[2][2] = {{M[1][1] / det, -M[0][1] / det}, {-M[1][0] / det, M[0][0] / det}};
    Return       r;
    r.stress = trial;
    r.least  = 1e300;
    for (int i = 0; i < 3; ++i)
      r.jacobian[i][i] = 1;
    for (std::size_t i = 0; i < n; ++i)
      {
        const double lambda = inverse[i][0] * F[0] + inverse[i][1] * F[1];
        r.multiplier += lambda;
        r.least = std::fmin(r.least, lambda);
        for (int c = 0; c < 3; ++c)
          {
            r.stress[c] -= lambda * Db[i][c];
            r.plastic[c] += lambda * b[i][c];
            for (int d = 0; d < 3; ++d)
              r.jacobian[c][d] -= Db[i][c] * (inverse[i][0] * a[0][d] + inverse[i][1] * a[1][d]);
          }
      }
    return r;
  }

  Return returned(const Material &m, const Vector &trial)
  {
    const double round_off = 1e-12 * (std::fabs(trial[0]) + std::fabs(trial[2]) + m.cohesion);
    Return       r         = to_planes(m, trial, {{0, 2}});
    if (r.stress[0] >= r.stress[1] - round_off && r.stress[1] >= r.stress[2] - round_off)
      return r;
    r = to_planes(m, trial, {{0, 2}, r.stress[1] > r.stress[0] ? std::pair{1, 2} : std::pair{0, 1}});
    if (m.sin_phi == 0 || (r.least >= 0 && r.stress[0] >= r.stress[2]))
      return r;
    Return tip; // all stresses c cot(phi)
    tip.stress.fill(m.cohesion * m.cos_phi / m.sin_phi);
    const double mean = (trial[0] + trial[1] + trial[2]) / 3, bulk = m.lame + 2 * m.shear / 3;
    for (int i = 0; i < 3; ++i)
      tip.plastic[i] = (trial[i] - mean) / (2 * m.shear) + (mean - tip.stress[0]) / (3 * bulk);
    tip.multiplier = tip.plastic[0] - tip.plastic[2];
    tip.branch     = DIPTYCH_TIP;
    return tip;
  }
} // namespace

const diptych_law *diptych_law_describe()
{
  return &law;
}

diptych_verdict diptych_law_update(const diptych_step *step, diptych_answer *answer)
{
  const Material m(step->parameters);
  const double  *e = step->strain, *s = step->stress, volume = e[0] + e[1];
  const double   mean = (s[0] + s[1]) / 2 + (m.lame + m.shear) * volume, zz = step->stress_zz + m.lame * volume;
  const double   q[2] = {(s[0] - s[1]) / 2 + m.shear * (e[0] - e[1]), s[2] + m.shear * e[2]}, t = std::hypot(q[0], q[1]);
  const double   n[2] = {t > 0 ? q[0] / t : 0, t > 0 ? q[1] / t : 0}; // direction of the larger in-plane stress
  // Places of the in-plane major and minor stress and of zz among the sorted three.
  const std::array<int, 3> place = zz > mean + t   ? std::array<int, 3>{1, 2, 0}
                                   : zz < mean - t ? std::array<int, 3>{0, 1, 2}
                                                   : std::array<int, 3>{0, 2, 1};
  Vector                   trial;
  trial[place[0]] = mean + t, trial[place[1]] = mean - t, trial[place[2]] = zz;

  Return r;
  r.stress = trial;
  for (int i = 0; i < 3; ++i)
    r.jacobian[i][i] = 1;
  r.branch = DIPTYCH_ELASTIC;
  if (m.yield(trial, 0, 2) > 1e-12 * (std::fabs(trial[0]) + std::fabs(trial[2]) + m.cohesion))
    r = returned(m, trial);

  const auto in_plane = [&](const Vector &v) {
    return std::pair{(v[place[0]] + v[place[1]]) / 2, (v[place[0]] - v[place[1]]) / 2};
  };
  const auto [end_mean, end_t] = in_plane(r.stress);
  const auto [p_mean, p_t]     = in_plane(r.plastic);
  answer->stress[0]            = end_mean + end_t * n[0];
  answer->stress[1]            = end_mean - end_t * n[0];
  answer->stress[2]            = end_t * n[1];
  answer->stress_zz            = r.stress[place[2]];
  answer->hardening += r.multiplier;
  const double plastic[4] = {p_mean + p_t * n[0], p_mean - p_t * n[0], r.plastic[place[2]], 2 * p_t * n[1]};
  for (int i = 0; i < 4; ++i)
    answer->plastic_strain[i] = plastic[i];
  answer->dissipation = dot(r.stress, r.plastic);
  answer->branch      = r.branch;

  // Column k: the strain has volume and g = (e_xx - e_yy, gamma), the trial stress the changes d. The direction n turns, too.
  const double volumes[3] = {1, 1, 0}, g[3][2] = {{1, 0}, {-1, 0}, {0, 1}};
  const double ratio = r.branch == DIPTYCH_ELASTIC ? 1 : t > 0 ? end_t / t : 0;
  for (int k = 0; k < 3; ++k)
    {
      const double along = n[0] * g[k][0] + n[1] * g[k][1], d_mean = (m.lame + m.shear) * volumes[k];
      Vector       d, change                                       = {};
      d[place[0]] = d_mean + m.shear * along, d[place[1]] = d_mean - m.shear * along, d[place[2]] = m.lame * volumes[k];
      for (int i = 0; i < 3; ++i)
        for (int j = 0; j < 3; ++j)
          change[i] += r.jacobian[i][j] * d[j];
      const auto [c_mean, c_t] = in_plane(change);
      const double c_q[2]      = {n[0] * c_t + ratio * m.shear * (g[k][0] - n[0] * along),
                                  n[1] * c_t + ratio * m.shear * (g[k][1] - n[1] * along)};
      answer->tangent[k]       = c_mean + c_q[0];
      answer->tangent[3 + k]   = c_mean - c_q[0];
      answer->tangent[6 + k]   = c_q[1];
    }
  return DIPTYCH_RELIABLE;
}
