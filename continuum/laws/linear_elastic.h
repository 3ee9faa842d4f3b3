// diptych: isotropic linear elasticity in plane strain
// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <limits>

#include "continuum/laws/elasticity.h"
#include "continuum/laws/hardening.h"

namespace diptych::continuum
{
  // Every law has these members with the same meaning (Law in any_law.h).
  class LinearElastic
  {
  public:
    // Options of every law but LibraryLaw: valid for the law (validate), as stresses and lengths (in_units).
    explicit LinearElastic(const LawOptions &options);

    // Returns the end state of the strain increment `d_strain` (tension positive) from the committed state `s0`, with the
    // consistent tangent. `d_time` is the length of the step along the loading. Only viscosity uses it; zero means rate
    // independent.
    MaterialUpdate update(const MaterialState &s0, const Strain &d_strain, double d_time) const;

    // Yield function of a state without its viscous part [pressure]. It is positive outside the elastic range.
    double yield_function(const MaterialState &) const { return -std::numeric_limits<double>::infinity(); }

    // Radius of the yield surface at the state's pressure and hardening variable [pressure]; infinite here.
    double shear_strength(const MaterialState &) const { return std::numeric_limits<double>::infinity(); }

    // Hardening of the law; nullptr if it has no strength.
    const Hardening *hardening() const { return nullptr; }

    const ElasticModuli &moduli() const { return moduli_; }
    const Tangent       &elastic_tangent() const { return tangent; }

  private:
    ElasticModuli moduli_;
    Tangent       tangent;
  };
} // namespace diptych::continuum
