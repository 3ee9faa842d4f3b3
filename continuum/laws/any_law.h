// diptych: the constitutive laws a scene can choose from
// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <string>
#include <variant>
#include <vector>

#include "continuum/laws/cosserat_drucker_prager.h"
#include "continuum/laws/cosserat_mohr_coulomb.h"
#include "continuum/laws/drucker_prager.h"
#include "continuum/laws/linear_elastic.h"
#include "continuum/laws/mohr_coulomb.h"

namespace diptych::continuum
{
  using Law = std::variant<LinearElastic, MohrCoulomb, DruckerPrager, CosseratMohrCoulomb, CosseratDruckerPrager>;

  // Names that make_law knows, in the order of the variant.
  const std::vector<std::string> &law_names();

  // Throws std::invalid_argument for an unknown name, listing the known ones, and as validate(options) does.
  Law make_law(const std::string &name, const LawOptions &options);
} // namespace diptych::continuum
