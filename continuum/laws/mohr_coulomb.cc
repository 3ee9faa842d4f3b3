// diptych: Mohr-Coulomb plasticity in plane strain
// SPDX-License-Identifier: LGPL-2.1-or-later
#include "continuum/laws/mohr_coulomb.h"

#include <algorithm>
#include <cmath>

namespace diptych::continuum
{
  namespace
  {
    // Outer two of the in-plane principal stresses -s + t, -s - t and sigma_zz.
    struct Outer
    {
      double major, minor;

      double shear() const { return (major - minor) / 2; }
      double pressure() const { return -(major + minor) / 2; }
    };

    Outer outer(const double shear, const double pressure, const double stress_zz)
    {
      return {std::max(shear - pressure, stress_zz), std::min(-shear - pressure, stress_zz)};
    }

    Outer outer(const MaterialState &state)
    {
      const Stress &s = state.stress;
      return outer(shear_radius(s), -(s[xx] + s[yy]) / 2, state.stress_zz);
    }

    // Positions of the in-plane major stress, the in-plane minor stress and sigma_zz among the sorted three.
    struct Places
    {
      unsigned int major, minor, zz;
    };

    Places places(const double shear, const double pressure, const double stress_zz)
    {
      if (stress_zz > shear - pressure)
        return {1, 2, 0};
      if (stress_zz < -shear - pressure)
        return {0, 1, 2};
      return {0, 2, 1};
    }
  } // namespace

  double MohrCoulomb::shear_strength(const MaterialState &state) const
  {
    const Cone c = cone.at(hardening_state(state));
    return outer(state).pressure() * c.slope.value + c.intercept.value;
  }

  double MohrCoulomb::yield_function(const MaterialState &state) const
  {
    return outer(state).shear() - shear_strength(state);
  }

  MaterialUpdate MohrCoulomb::update(const MaterialState &s0, const Strain &d_strain, const double d_time) const
  {
    const Trial     trial = elastic_trial(s0, d_strain);
    const ConeStart start = start_of(s0);
    const double    zz    = trial.state.stress_zz;
    const Outer     o     = outer(trial.shear, trial.pressure, zz);
    const double    scale = o.shear() + std::abs(o.pressure()) + start.cone.intercept.value;
    const double    yield = o.shear() - o.pressure() * start.cone.slope.value - start.cone.intercept.value;
    if (!std::isfinite(scale) || yield <= 1e-12 * scale)
      return elastic_answer(trial);

    const Places p       = places(trial.shear, trial.pressure, zz);
    const bool   between = p.zz == 1;
    if (between)
      {
        const ConeReturn r = radial_return(trial, start, d_time);
        if (r.verdict != Verdict::failed && r.regime == Regime::plastic)
          {
            const MaterialUpdate answer = plastic_answer(trial, r);
            if (places(r.shear, r.pressure, answer.state.stress_zz).zz == 1)
              return answer;
          }
      }
    Principal sorted;
    sorted[p.major]          = trial.shear - trial.pressure;
    sorted[p.minor]          = -trial.shear - trial.pressure;
    sorted[p.zz]             = zz;
    const auto     principal = return_in_principal_space(cone, moduli_, start, sorted, viscous_modulus(d_time));
    MaterialUpdate answer    = plastic_answer(trial, plane_part(trial, principal));
    answer.state.stress_zz   = principal.stress[p.zz];
    return answer;
  }

  // Computes the in-plane shear and pressure with their derivatives. A trial shear separates the in-plane trial stresses; a
  // trial pressure lowers both, and sigma_zz by lateral/plane_bulk of that. If they are equal, sigma_zz is an outer stress, and
  // the final ones are equal too. The limit of final shear / trial shear is then 0.
  ConeReturn MohrCoulomb::plane_part(const Trial &trial, const PrincipalReturn &principal) const
  {
    const Places    p = places(trial.shear, trial.pressure, trial.state.stress_zz);
    const Principal a = principal.stress;
    Principal       by_shear{}, by_pressure{};
    for (unsigned int i = 0; i < 3; ++i)
      {
        const Principal &row = principal.jacobian[i];
        by_shear[i]          = row[p.major] - row[p.minor];
        by_pressure[i]       = -row[p.major] - row[p.minor] - moduli_.lateral / moduli_.plane_bulk * row[p.zz];
      }
    ConeReturn r;
    r.multiplier           = principal.multiplier;
    r.overstress           = principal.overstress;
    r.regime               = principal.regime;
    r.verdict              = principal.verdict;
    r.shear                = (a[p.major] - a[p.minor]) / 2;
    r.shear_by_shear       = (by_shear[p.major] - by_shear[p.minor]) / 2;
    r.shear_by_pressure    = (by_pressure[p.major] - by_pressure[p.minor]) / 2;
    r.pressure             = -(a[p.major] + a[p.minor]) / 2;
    r.pressure_by_shear    = -(by_shear[p.major] + by_shear[p.minor]) / 2;
    r.pressure_by_pressure = -(by_pressure[p.major] + by_pressure[p.minor]) / 2;
    return r;
  }
} // namespace diptych::continuum
