// diptych: isotropic elasticity in plane strain, classical and Cosserat
// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include "continuum/laws/law.h"
#include "continuum/laws/options.h"

namespace diptych::continuum
{
  // In the plane: stress = plane_bulk tr(strain) 1 + 2 shear dev(strain) with the two-dimensional deviator.
  struct ElasticModuli
  {
    double shear      = 0; // G [pressure]
    double bulk       = 0; // K, three-dimensional [pressure]
    double plane_bulk = 0; // K + G/3 [pressure]
    double lateral    = 0; // K - 2 G/3, d sigma_zz / d tr(strain) [pressure]
    double couple = 0; // M = 2 G l^2: m = M curvature [pressure * length^2]; zero for a classical law; s l^2 for a gradient law
    double skew   = 0; // Gc: a = Gc * relative rotation [pressure]; zero for a classical law; s for a gradient law
  };

  // Options as stresses and lengths (in_units). The Cosserat part follows de Borst, Eng. Comput. 8 (1991). The relative
  // rotation chi has the energy Gc chi^2 / 2.
  ElasticModuli elastic_moduli(const LawOptions &options, bool is_cosserat);
  Tangent       elastic_tangent(const ElasticModuli &moduli);
} // namespace diptych::continuum
