// diptych: the constitutive laws a scene can choose from
// SPDX-License-Identifier: LGPL-2.1-or-later
#include "continuum/laws/any_law.h"

#include <stdexcept>

namespace diptych::continuum
{
  const std::vector<std::string> &law_names()
  {
    static const std::vector<std::string> names = {"linear_elastic", "mohr_coulomb", "drucker_prager", "cosserat_mohr_coulomb",
                                                   "cosserat_drucker_prager"};
    return names;
  }

  Law make_law(const std::string &name, const LawOptions &options)
  {
    if (name == "linear_elastic")
      return LinearElastic(options);
    if (name == "mohr_coulomb")
      return MohrCoulomb(options);
    if (name == "drucker_prager")
      return DruckerPrager(options);
    if (name == "cosserat_mohr_coulomb")
      return CosseratMohrCoulomb(options);
    if (name == "cosserat_drucker_prager")
      return CosseratDruckerPrager(options);
    std::string known;
    for (const std::string &one : law_names())
      known += (known.empty() ? "" : ", ") + one;
    throw std::invalid_argument("law = " + name + " must be one of " + known);
  }
} // namespace diptych::continuum
