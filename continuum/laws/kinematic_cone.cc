// diptych: critical-state plasticity that unloads and reverses, classical and Cosserat
// SPDX-License-Identifier: LGPL-2.1-or-later
#include "continuum/laws/kinematic_cone.h"

#include <cmath>

namespace diptych::continuum
{
  KinematicCone::KinematicCone(const LawOptions &options, const ConeShape shape, const bool is_cosserat)
      : ConeLaw(options, shape, is_cosserat),
        kinematic(std::get<KinematicHardening>(cone.hardening.form()))
  {
    for (unsigned int k = 0; k < unit.size(); ++k)
      {
        Deviatoric q;
        q[k]    = 1;
        unit[k] = conjugate(q);
      }
  }

  ConeLaw::Deviatoric KinematicCone::back_ratio(const MaterialState &state) const
  {
    MaterialState back;
    back.stress    = part_of<KinematicState>(state).back_stress_ratio;
    back.stress_zz = -(back.stress[xx] + back.stress[yy]);
    return deviatoric(back);
  }

  double KinematicCone::yield_function(const MaterialState &state) const
  {
    const double p = pressure(state) + kinematic.tension;
    return (deviatoric(state) - p * back_ratio(state)).norm() - p * kinematic.radius(state.equivalent_plastic_strain);
  }

  // |a m - R| = r with the unit vector m of q, or any if q is zero.
  double KinematicCone::shear_strength(const MaterialState &state) const
  {
    const Deviatoric q = deviatoric(state), back = back_ratio(state);
    const double     size = q.norm(), along = size > 0 ? q * back / size : 0;
    const double     r = kinematic.radius(state.equivalent_plastic_strain), across = back.norm_square() - along * along;
    return (pressure(state) + kinematic.tension) * (along + std::sqrt(std::max(0., r * r - across)));
  }

  MaterialUpdate KinematicCone::update(const MaterialState &s0, const Strain &d_strain, const double d_time) const
  {
    const Trial      trial = elastic_trial(s0, d_strain);
    const Deviatoric q     = deviatoric(trial.state);
    if (!(yield_function(trial.state) > 1e-12 * (trial.shear + std::abs(trial.pressure) + kinematic.tension)))
      return elastic_answer(trial);

    const KinematicReturn end = moving_return(trial, q, d_time);
    MaterialUpdate        answer{trial.state, tangent_of(end), end.regime, end.verdict};
    MaterialState        &state = answer.state;
    const double          s     = end.pressure - kinematic.tension;
    state.stress                = conjugate(end.q);
    state.stress_zz             = cone.shape == ConeShape::mohr_coulomb
                                    ? trial.state.stress_zz - moduli_.lateral / pressure_modulus * (s - trial.pressure)
                                    : -s - (state.stress[xx] + state.stress[yy]);
    state.stress[xx] -= s;
    state.stress[yy] -= s;
    state.stress[relative_rotation] = trial.state.stress[relative_rotation];
    state.equivalent_plastic_strain += end.multiplier;
    KinematicState &own = own_part<KinematicState>(state);
    own.densification -= end.multiplier * end.dilation;
    own.back_stress_ratio = conjugate(end.back);
    own.stress_ratio_gain = end.back.norm() + kinematic.radius(state.equivalent_plastic_strain) - kinematic.start;
    state.overstress      = viscous_modulus(d_time) * end.multiplier;
    return answer;
  }

  KinematicReturn KinematicCone::moving_return(const Trial &trial, const Deviatoric &q, const double d_time) const
  {
    KinematicTrial t;
    t.q                         = q;
    t.pressure                  = trial.pressure + kinematic.tension;
    t.back                      = back_ratio(trial.state);
    t.equivalent_plastic_strain = trial.state.equivalent_plastic_strain;
    t.densification             = part_of<KinematicState>(trial.state).densification;
    t.shear_modulus             = moduli_.shear;
    t.pressure_modulus          = pressure_modulus;
    t.viscous_modulus           = viscous_modulus(d_time);
    return return_to_moving_cone(kinematic, t);
  }

  // sigma = sum over k of q_k unit_k - s 1 + skew part, with dq0_k = G unit_k.de and ds0 = -B 1.de.
  Tangent KinematicCone::tangent_of(const KinematicReturn &end) const
  {
    Stress one;
    one[xx] = one[yy] = 1;
    const double G = moduli_.shear, B = pressure_modulus;
    Stress       pressure_rate = -B * end.pressure_by_pressure * one;
    Tangent      tangent;
    for (unsigned int k = 0; k < unit.size(); ++k)
      {
        Stress rate = -B * end.q_by_pressure[k] * one;
        for (unsigned int l = 0; l < unit.size(); ++l)
          rate += G * end.q_by_q[k][l] * unit[l];
        tangent += outer_product(unit[k], rate);
        pressure_rate += G * end.pressure_by_q[k] * unit[k];
      }
    tangent -= outer_product(one, pressure_rate);
    tangent[relative_rotation][relative_rotation] = moduli_.skew;
    return tangent;
  }
} // namespace diptych::continuum
