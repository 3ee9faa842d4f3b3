// diptych: the constitutive laws a scene can choose from
// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <variant>

#include "continuum/laws/linear_elastic.h"
#include "continuum/laws/mohr_coulomb.h"

namespace diptych::continuum
{
  using Law = std::variant<LinearElastic, MohrCoulomb>;
} // namespace diptych::continuum
