// diptych: the constitutive laws that a scene can choose
// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <variant>

#include "continuum/laws/cosserat_drucker_prager.h"
#include "continuum/laws/cosserat_mohr_coulomb.h"
#include "continuum/laws/drucker_prager.h"
#include "continuum/laws/gradient_law.h"
#include "continuum/laws/kinematic_cone.h"
#include "continuum/laws/linear_elastic.h"
#include "continuum/laws/mohr_coulomb.h"

namespace diptych::continuum
{
  using Law = std::variant<LinearElastic,
                           MohrCoulomb,
                           DruckerPrager,
                           CosseratMohrCoulomb,
                           CosseratDruckerPrager,
                           KinematicLaw<false>,
                           KinematicLaw<true>,
                           GradientMohrCoulomb,
                           GradientDruckerPrager>;

  // Throws std::invalid_argument under the same conditions as validate(options), and if validate(law, options) does.
  Law make_law(LawKind law, const LawOptions &options, const Units &units = {});
} // namespace diptych::continuum
