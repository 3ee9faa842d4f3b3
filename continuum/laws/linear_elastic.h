// diptych: isotropic linear elasticity in plane strain
// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include "continuum/laws/elasticity.h"
#include "continuum/laws/hardening.h"

namespace diptych::continuum
{
  // Every law has these members with these meanings; see also Law in any_law.h.
  class LinearElastic
  {
  public:
    static constexpr bool is_cosserat = false;

    // Throws std::invalid_argument where the elastic options are out of range; reads no others.
    explicit LinearElastic(const LawOptions &options, const Units &units = {});

    // End state of the strain increment `d_strain` (tension positive) from the committed state `s0`, with the consistent
    // tangent. `d_time` is the axial strain of the step; only viscosity asks for it, zero means rate independent.
    MaterialUpdate update(const MaterialState &s0, const Strain &d_strain, double d_time) const;

    // Yield function of a state without its viscous part [pressure]: positive outside the elastic range.
    double yield_function(const MaterialState &state) const;

    // Radius of the yield surface at the state's pressure and hardening variable [pressure]; here infinite.
    double shear_strength(const MaterialState &state) const;

    // How strength changes with the state; none where there is none.
    const Hardening *hardening() const { return nullptr; }

    const ElasticModuli &moduli() const { return moduli_; }
    const Tangent       &elastic_tangent() const { return tangent; }

  private:
    ElasticModuli moduli_;
    Tangent       tangent;
  };
} // namespace diptych::continuum
