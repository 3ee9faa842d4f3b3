// diptych: laws with a radial return mapping onto a cone over the pressure
// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include "continuum/laws/cone_return.h"
#include "continuum/laws/elasticity.h"

namespace diptych::continuum
{
  // The stress is split into the pressure s and a deviatoric vector q. The elastic increment of q is G g, where g is the strain
  // conjugate to q:
  //   q = ((s_xx - s_yy)/2, s_xy, (sqrt3/2) s_zz', m_x/(sqrt2 l), m_y/(sqrt2 l)),
  //   g = (e_xx - e_yy, gamma_xy, -tr(e)/sqrt3, sqrt2 l kappa_x, sqrt2 l kappa_y).
  // Only Drucker-Prager uses the third entry, only Cosserat laws use the last two; unused entries are zero. The elastic
  // pressure increment is -B tr(e). Mohr-Coulomb has B = K + G/3 and s = -(s_xx + s_yy)/2, Drucker-Prager has B = K and s =
  // -I1/3. The couple stress enters the yield function through m.m/(2 l^2). The skew stress is elastic and does not enter it. The
  // hardening variable grows by the plastic multiplier, which is the norm of the plastic part of g; a plastic curvature
  // contributes to it.
  //
  // Drucker-Prager: F = sqrt(J2) + alpha I1 - k with alpha, k and the dilatancy matched to plane-strain flow (yield_cone.h). In
  // such flow it has the strength of Mohr-Coulomb for any dilatancy. sigma_zz flows plastically. The multiplier is then the
  // plastic d(eps_1 - eps_3) times sqrt(1 + sin^2(psi)/3), which is 0.7 % larger at psi = 12 degrees.
  //
  // Mohr-Coulomb: F = |q| - s sin(phi) - c cos(phi) in the plane. sigma_zz stays elastic and does not enter it. The law is
  // therefore Mohr-Coulomb only where sigma_zz is the intermediate principal stress. The panel reports the share of the area
  // where it is not. MohrCoulomb returns in three dimensions instead.
  class ConeLaw
  {
  public:
    // Members as in LinearElastic.
    ConeLaw(const LawOptions &options, ConeShape shape, bool is_cosserat);

    // Implicit: F = |q| - s f - g0 = overstress with f, g0 and dilation d at the END of the step. Over the step the hardening
    // variable grows by the multiplier lambda, |q| falls by G lambda and s rises by B lambda d. Perzyna: overstress =
    // (viscosity/d_time) lambda.
    MaterialUpdate update(const MaterialState &s0, const Strain &d_strain, double d_time) const;
    double         yield_function(const MaterialState &state) const;
    double         shear_strength(const MaterialState &state) const;

    const Hardening     *hardening() const { return &cone.hardening; }
    const ElasticModuli &moduli() const { return moduli_; }
    const Tangent       &elastic_tangent() const { return elastic; }

  protected:
    using Deviatoric = dealii::Tensor<1, 5>;

    // Elastic predictor. `direction` is the unit vector of q, or zero if q is zero.
    struct Trial
    {
      MaterialState state;
      Deviatoric    direction;
      double        shear = 0, pressure = 0; // |q|, s
    };

    Trial          elastic_trial(const MaterialState &s0, const Strain &d_strain) const;
    ConeStart      start_of(const MaterialState &s0) const;
    ConeReturn     radial_return(const Trial &trial, const ConeStart &start, double d_time) const;
    MaterialUpdate elastic_answer(const Trial &trial) const;
    MaterialUpdate plastic_answer(const Trial &trial, const ConeReturn &end) const;
    double         viscous_modulus(double d_time) const { return d_time > 0 ? viscosity / d_time : 0; }

    Stress conjugate(const Deviatoric &q) const; // q . dg/d(strain)
    bool   is_outside(const Trial &trial, const Cone &cone) const;

    YieldCone     cone;
    ElasticModuli moduli_;
    double        pressure_modulus; // B [pressure]
    Tangent       elastic;
    Deviatoric    deviatoric(const MaterialState &state) const;
    double        pressure(const MaterialState &state) const;

  private:
    double  viscosity;
    double  couple_scale; // sqrt2 l; zero for a law without couple stress
    Tangent metric;       // (dg/d strain)^T (dg/d strain)
  };
} // namespace diptych::continuum
