// diptych: the constitutive laws that a scene can choose
// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <variant>

#include "continuum/laws/gradient_law.h"
#include "continuum/laws/kinematic_cone.h"
#include "continuum/laws/library_law.h"
#include "continuum/laws/linear_elastic.h"
#include "continuum/laws/mohr_coulomb.h"

namespace diptych::continuum
{
  using Law = std::variant<LinearElastic, MohrCoulomb, ConeLaw, KinematicCone, GradientLaw, LibraryLaw>;

  // Throws WrongKeys as validate(law, options) does.
  Law make_law(LawKind law, const LawOptions &options, const Units &units = {});

  // The law of a point in a uniform deformation without rotation, where a nonlocal hardening variable equals the local one.
  Law make_uniform_law(LawKind law, const LawOptions &options, const Units &units = {});

  // Sets the state variables of a law from a library at the initial stress. Other laws have none.
  template <class AnyLaw> void start(const AnyLaw &law, MaterialState &state)
  {
    if constexpr (std::is_same_v<AnyLaw, LibraryLaw>)
      law.start(state);
  }
} // namespace diptych::continuum
