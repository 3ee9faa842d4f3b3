// diptych: strain increment of a point, and the nodal forces of its stress
// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include "continuum/laws/law.h"

namespace diptych::continuum
{
  // Increment of the motion at a point, differentiated by the position at the START of the step: du_x/dx, du_x/dy, du_y/dx,
  // du_y/dy, then the Cosserat rotation omega and its gradient. A gradient element has its nonlocal hardening variable in place
  // of omega, with the gradient on the initial shape.
  constexpr unsigned int n_motions = 7, n_classical_motions = 4;
  using Motion = dealii::Tensor<1, n_motions>;

  // Work-conjugate to Motion, per area at the start of the step: the first Piola-Kirchhoff stress (row: component of the force;
  // column: normal at the start), minus twice the skew stress, and the couple stress. [pressure], couple stress x length
  using PiolaStress  = dealii::Tensor<1, n_motions>;
  using PiolaTangent = dealii::Tensor<2, n_motions>; // d PiolaStress / d Motion

  // Relates the motion of one step to the law's strain, and the law's stress to forces. With F = 1 + du/dx:
  //   finite: the strain is sym(du/dx_mid), differentiated on the shape at the middle of the step, F_mid = 1 + (F - 1)/2. It is
  //   turned back by half the rotation of the material, tan(angle/2) = spin/2 (Hughes & Winget, Int. J. Numer. Meth. Engng 15,
  //   1980). The law's stress is turned forward by the whole angle. Forces act on the shape at the END of the step. Strain and
  //   force are of second order in the step; a rigid rotation gives no strain.
  //   small: the strain is sym(du/dx) and forces act on the initial shape.
  // The nonlocal hardening variable, its gradient and what they are conjugate to pass through unchanged.
  class Increment
  {
  public:
    Increment(const Motion &motion, bool is_finite, bool is_gradient = false);

    const Strain &strain() const { return strain_; } // for the law
    double        angle() const { return angle_; }   // of the material, anticlockwise [radians]; small: 0
    bool          is_inverted() const { return !(determinant > 0); }

    // Nodal force of a stress that the law returned, and its tangent. The stress is not turned yet.
    PiolaStress  force(const Stress &stress) const;
    PiolaTangent tangent(const Stress &stress, const Tangent &law) const;

  private:
    void   find_strain(const Motion &motion);
    Strain change_of_strain(unsigned int motion, double &d_angle) const;

    Strain strain_;
    bool   is_finite, is_gradient;
    double angle_ = 0, cosine = 1, sine = 0; // of the angle
    double half_cosine = 1, half_sine = 0;   // of half the angle
    double angle_by_spin = 1;
    double to_mid[2][2]  = {{1, 0}, {0, 1}};  // inverse of F_mid
    double mid_gradient[2]{};                 // of omega, on the shape at the middle
    double cofactor[2][2] = {{1, 0}, {0, 1}}; // det F times the inverse transpose of F
    double determinant    = 1;
  };
} // namespace diptych::continuum
