// diptych: plasticity with a nonlocal hardening variable and hence an internal length
// SPDX-License-Identifier: LGPL-2.1-or-later
#include "continuum/laws/gradient_law.h"

namespace diptych::continuum
{
  GradientLaw::GradientLaw(const LawOptions &options, const ConeShape shape)
      : ConeLaw(options, shape, false)
  {
    const double length = options.internal_length;
    cone.hardening      = Hardening(options, options.nonlocal_weight);
    moduli_.skew        = moduli_.shear;
    moduli_.couple      = moduli_.shear * length * length;
    elastic             = continuum::elastic_tangent(moduli_);
  }

  MaterialUpdate GradientLaw::update(const MaterialState &s0, const Strain &d_strain, const double d_time) const
  {
    MaterialState start = s0;
    own_part<NonlocalState>(start).plastic_strain += d_strain[nonlocal];
    const Trial     trial    = elastic_trial(start, d_strain);
    const ConeStart at_start = start_of(trial.state);
    if (!is_outside(trial, at_start.cone))
      return elastic_answer(trial);
    const ConeReturn end    = radial_return(trial, at_start, d_time);
    MaterialUpdate   answer = plastic_answer(trial, end);
    add_nonlocal_part(trial, end, answer);
    return answer;
  }

  // A rate with _k is a derivative by kbar at a constant strain. From dF = 0 at the end of the return,
  //   F_k = -(B lambda d_k f + s f_k + g_k),  lambda_k = F_k dlambda/dt0,  t_k = -G lambda_k,  s_k = F_k ds/dt0 + B lambda d_k,
  // with slope f, intercept g and dilation d of the cone. At its tip t = lambda_k = 0 and s_k = -(s f_k + g_k)/f.
  void GradientLaw::add_nonlocal_part(const Trial &trial, const ConeReturn &end, MaterialUpdate &answer) const
  {
    const Cone   c = cone.by_nonlocal(hardening_state(answer.state));
    const double G = moduli_.shear, B = pressure_modulus, scale = moduli_.skew;
    const double falls = -(end.pressure * c.slope.rate + c.intercept.rate), volume = B * end.multiplier * c.dilation.rate;
    const bool   tip = end.regime == Regime::apex;
    const double F_k = falls - volume * c.slope.value, multiplier_k = tip ? 0 : F_k * end.multiplier_by_shear;
    const double pressure_k = tip ? falls / c.slope.value : F_k * end.pressure_by_shear + volume;

    const Stress n = conjugate(trial.direction);
    Stress       one;
    one[xx] = one[yy]          = 1;
    const Stress by_nonlocal   = -G * multiplier_k * n - pressure_k * one;
    const Stress multiplier_by = end.multiplier_by_shear * G * n - end.multiplier_by_pressure * B * one;
    Tangent     &D             = answer.tangent;
    for (const Component k : {xx, yy, xy})
      {
        D[k][nonlocal] = by_nonlocal[k];
        D[nonlocal][k] = -scale * multiplier_by[k];
      }
    D[nonlocal][nonlocal]     = scale * (1 - multiplier_k);
    D[nonlocal_x][nonlocal_x] = D[nonlocal_y][nonlocal_y] = moduli_.couple;

    Stress &s     = answer.state.stress;
    s[nonlocal]   = trial.state.stress[nonlocal] - scale * end.multiplier;
    s[nonlocal_x] = trial.state.stress[nonlocal_x];
    s[nonlocal_y] = trial.state.stress[nonlocal_y];
  }

  Tangent uniform_tangent(const Tangent &tangent)
  {
    Tangent D = tangent;
    for (const Component i : {xx, yy, xy})
      for (const Component j : {xx, yy, xy})
        D[i][j] -= tangent[i][nonlocal] * tangent[nonlocal][j] / tangent[nonlocal][nonlocal];
    return D;
  }
} // namespace diptych::continuum
