// diptych: what every constitutive law takes and gives
// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <deal.II/base/symmetric_tensor.h>

namespace diptych::continuum
{
  // How far a law's answer can be trusted. `failed`: stress and tangent are meaningless, the step must be cut.
  // `unreliable`: the return converged, but softening was so fast that the answer may not be the only one.
  enum class Verdict
  {
    reliable,
    unreliable,
    failed
  };

  // Which branch of the law answered.
  enum class Regime
  {
    elastic,
    plastic,
    apex
  };

  // Committed state of one material point in plane strain. Mechanics sign: tension positive.
  struct MaterialState
  {
    dealii::SymmetricTensor<2, 2> stress;                        // in the plane [pressure]
    double                        stress_zz                 = 0; // [pressure]
    double                        equivalent_plastic_strain = 0; // integral of d(eps_1 - eps_3) plastic [-]
  };

  // Answer of a law to a strain increment: the end state, d(stress)/d(strain increment) in the plane, and the verdict.
  struct MaterialUpdate
  {
    MaterialState                 state;
    dealii::SymmetricTensor<4, 2> tangent;
    Regime                        regime  = Regime::elastic;
    Verdict                       verdict = Verdict::reliable;
  };
} // namespace diptych::continuum
