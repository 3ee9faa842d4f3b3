// diptych: laws with a radial return mapping onto a cone over the pressure
// SPDX-License-Identifier: LGPL-2.1-or-later
#include "continuum/laws/cone_law.h"

#include <cmath>

namespace diptych::continuum
{
  namespace
  {
    enum
    {
      difference,
      shear_xy,
      out_of_plane,
      couple_x,
      couple_y
    };

    const double sqrt3 = std::sqrt(3.);
  } // namespace

  ConeLaw::ConeLaw(const LawOptions &options, const ConeShape shape, const bool is_cosserat)
      : cone{Hardening(options), shape},
        moduli_(elastic_moduli(options, is_cosserat)),
        pressure_modulus(shape == ConeShape::mohr_coulomb ? moduli_.plane_bulk : moduli_.bulk),
        elastic(continuum::elastic_tangent(moduli_)),
        viscosity(options.viscosity),
        couple_scale(is_cosserat ? std::sqrt(2.) * options.internal_length : 0)
  {
    // Sum over the unit vectors of g: the outer product of the conjugate stress with itself.
    for (unsigned int k = 0; k < Deviatoric::dimension; ++k)
      {
        Deviatoric unit;
        unit[k] = 1;
        metric += outer_product(conjugate(unit), conjugate(unit));
      }
  }

  ConeLaw::Deviatoric ConeLaw::deviatoric(const MaterialState &state) const
  {
    const Stress &s = state.stress;
    Deviatoric    q;
    q[difference] = (s[xx] - s[yy]) / 2;
    q[shear_xy]   = s[xy];
    if (cone.shape == ConeShape::drucker_prager)
      q[out_of_plane] = (2 * state.stress_zz - s[xx] - s[yy]) / (2 * sqrt3);
    if (couple_scale > 0)
      {
        q[couple_x] = s[curvature_x] / couple_scale;
        q[couple_y] = s[curvature_y] / couple_scale;
      }
    return q;
  }

  double ConeLaw::pressure(const MaterialState &state) const
  {
    const double in_plane = -(state.stress[xx] + state.stress[yy]);
    return cone.shape == ConeShape::mohr_coulomb ? in_plane / 2 : (in_plane - state.stress_zz) / 3;
  }

  Stress ConeLaw::conjugate(const Deviatoric &q) const
  {
    // The g of Mohr-Coulomb has no third entry.
    const double lateral = cone.shape == ConeShape::drucker_prager ? -q[out_of_plane] / sqrt3 : 0;
    Stress       s;
    s[xx]          = lateral + q[difference];
    s[yy]          = lateral - q[difference];
    s[xy]          = q[shear_xy];
    s[curvature_x] = couple_scale * q[couple_x];
    s[curvature_y] = couple_scale * q[couple_y];
    return s;
  }

  double ConeLaw::yield_function(const MaterialState &state) const
  {
    return deviatoric(state).norm() - shear_strength(state);
  }

  double ConeLaw::shear_strength(const MaterialState &state) const
  {
    const Cone c = cone.at(hardening_state(state));
    return pressure(state) * c.slope.value + c.intercept.value;
  }

  MaterialUpdate ConeLaw::update(const MaterialState &s0, const Strain &d_strain, const double d_time) const
  {
    const Trial     trial = elastic_trial(s0, d_strain);
    const ConeStart start = start_of(s0);
    return is_outside(trial, start.cone) ? plastic_answer(trial, radial_return(trial, start, d_time)) : elastic_answer(trial);
  }

  bool ConeLaw::is_outside(const Trial &trial, const Cone &c) const
  {
    const double yield = trial.shear - trial.pressure * c.slope.value - c.intercept.value;
    return !(yield <= 1e-12 * (trial.shear + std::abs(trial.pressure) + c.intercept.value));
  }

  ConeStart ConeLaw::start_of(const MaterialState &s0) const
  {
    const HardeningState state = hardening_state(s0);
    return {state, cone.at(state)};
  }

  ConeLaw::Trial ConeLaw::elastic_trial(const MaterialState &s0, const Strain &d_strain) const
  {
    Trial trial;
    trial.state = s0;
    trial.state.stress += elastic * d_strain;
    trial.state.stress_zz += moduli_.lateral * (d_strain[xx] + d_strain[yy]);
    const Deviatoric q = deviatoric(trial.state);
    trial.shear        = q.norm();
    trial.pressure     = pressure(trial.state);
    if (trial.shear > 0)
      trial.direction = q / trial.shear;
    return trial;
  }

  ConeReturn ConeLaw::radial_return(const Trial &trial, const ConeStart &start, const double d_time) const
  {
    ReturnPath path;
    path.shear                     = trial.shear;
    path.pressure                  = trial.pressure;
    path.shear_loss                = moduli_.shear;
    path.pressure_gain_by_dilation = pressure_modulus;
    return return_to_cone(cone, start, path, viscous_modulus(d_time), moduli_.shear);
  }

  MaterialUpdate ConeLaw::elastic_answer(const Trial &trial) const
  {
    MaterialUpdate answer{trial.state, elastic};
    answer.state.overstress = 0;
    if (!std::isfinite(trial.shear) || !std::isfinite(trial.pressure))
      answer.verdict = Verdict::failed;
    return answer;
  }

  // sigma = q . dg/de - s 1 + skew part, with q = t n. From dt0 = G n.dg, ds0 = -B tr(de) and dn = G (dg - n n.dg)/t0 follow
  //   dq = n (t_t dt0 + t_s ds0) + (t/t0) G (dg - n n.dg),   ds = s_t dt0 + s_s ds0.
  MaterialUpdate ConeLaw::plastic_answer(const Trial &trial, const ConeReturn &end) const
  {
    const double G = moduli_.shear, B = pressure_modulus, ratio = trial.shear > 0 ? end.shear / trial.shear : 0;
    const Stress n = conjugate(trial.direction);
    Stress       one;
    one[xx] = one[yy] = 1;

    MaterialUpdate answer{trial.state, {}, end.regime, end.verdict};
    MaterialState &state            = answer.state;
    state.stress                    = end.shear * n - end.pressure * one;
    state.stress[relative_rotation] = trial.state.stress[relative_rotation];
    state.stress_zz += cone.shape == ConeShape::mohr_coulomb
                         ? -moduli_.lateral / B * (end.pressure - trial.pressure)
                         : trial.pressure - end.pressure + 2 / sqrt3 * (end.shear - trial.shear) * trial.direction[out_of_plane];
    cone.hardening.write(cone.hardening.after(hardening_state(trial.state), end.multiplier), state);
    state.overstress = end.overstress;

    const Stress by_shear    = G * ((end.shear_by_shear - ratio) * n - end.pressure_by_shear * one); // coefficient of n.dg
    const Stress by_pressure = B * (end.pressure_by_pressure * one - end.shear_by_pressure * n);     // coefficient of tr(de)
    for (unsigned int i = 0; i < n_components; ++i)
      answer.tangent[i] = ratio * G * metric[i] + by_shear[i] * n + by_pressure[i] * one;
    answer.tangent[relative_rotation][relative_rotation] = moduli_.skew;
    return answer;
  }
} // namespace diptych::continuum
