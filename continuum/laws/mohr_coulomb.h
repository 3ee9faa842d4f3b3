// diptych: Mohr-Coulomb plasticity in the plane of deformation, softening, dilatancy that fades
// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include "continuum/laws/law.h"
#include "continuum/laws/linear_elastic.h"

namespace diptych::continuum
{
  struct MohrCoulombOptions
  {
    ElasticOptions elastic;
    double         friction_angle_peak      = 20.5;  // [degrees]
    double         friction_angle_residual  = 13.5;  // [degrees]
    double         dilatancy_angle_peak     = 12;    // [degrees]
    double         dilatancy_angle_residual = 0;     // [degrees]; a constant positive value inflates the band for ever
    double         cohesion                 = 0.01;  // [pressure]; small, keeps free corners from losing all stiffness
    double         softening_strain         = 0.075; // equivalent plastic strain of a decay by 1/e [-]
  };

  template <class Visitor> void visit_parameters(MohrCoulombOptions &o, Visitor &&visitor)
  {
    visit_parameters(o.elastic, visitor);
    visitor("friction_angle_peak", o.friction_angle_peak, "degrees", {0., 60.}, "friction angle before any plastic strain");
    visitor("friction_angle_residual", o.friction_angle_residual, "degrees", {0., 60.},
            "friction angle after long shear; at most the peak angle");
    visitor("dilatancy_angle_peak", o.dilatancy_angle_peak, "degrees", {0., 60.},
            "dilatancy angle before any plastic strain; at most the friction angle");
    visitor("dilatancy_angle_residual", o.dilatancy_angle_residual, "degrees", {0., 60.},
            "dilatancy angle after long shear; above zero the band dilates for ever");
    visitor("cohesion", o.cohesion, "P", {0., 1e12}, "cohesion, constant");
    visitor("softening_strain", o.softening_strain, "-", {1e-6, 1e6},
            "equivalent plastic strain over which both angles decay by 1/e");
  }

  // Throws std::invalid_argument where one value is out of range or two contradict each other (dilatancy above friction).
  void validate(const MohrCoulombOptions &options);

  // Friction and dilatancy angles at one value of the hardening variable, with their derivatives by it. [radians]
  struct Angles
  {
    double friction, friction_rate, dilatancy, dilatancy_rate;
  };

  class MohrCoulomb
  {
  public:
    explicit MohrCoulomb(const MohrCoulombOptions &options);

    // End state of the strain increment `d_strain` (tension positive) from the committed state `s0`, by an implicit
    // return to F = t - s sin(phi) - c cos(phi) = 0 with s = -(sigma_1 + sigma_2)/2 and t = (sigma_1 - sigma_2)/2 in the
    // plane (sigma_zz intermediate), potential g = t - s sin(psi), both angles at the END of the step.
    MaterialUpdate update(const MaterialState &s0, const dealii::SymmetricTensor<2, 2> &d_strain) const;

    Angles angles(double equivalent_plastic_strain) const;

    // F of a stress at a hardening variable [pressure]; positive outside the elastic range.
    double yield_function(const dealii::SymmetricTensor<2, 2> &stress, double equivalent_plastic_strain) const;

  private:
    struct Trial;
    struct PlasticMultiplier;

    PlasticMultiplier solve_multiplier(const Trial &trial) const;
    MaterialUpdate    return_to_flank(const Trial &trial, const PlasticMultiplier &multiplier) const;
    MaterialUpdate    return_to_apex(const Trial &trial) const;

    PlaneModuli                   moduli;
    dealii::SymmetricTensor<4, 2> elastic;
    double                        friction_residual, friction_excess;   // [radians]
    double                        dilatancy_residual, dilatancy_excess; // [radians]
    double                        cohesion, softening_strain;
  };
} // namespace diptych::continuum
