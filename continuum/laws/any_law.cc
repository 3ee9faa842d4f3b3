// diptych: the constitutive laws that a scene can choose
// SPDX-License-Identifier: LGPL-2.1-or-later
#include "continuum/laws/any_law.h"

#include <stdexcept>

namespace diptych::continuum
{
  static_assert(traits(LawKind::linear_elastic).is_cosserat == LinearElastic::is_cosserat &&
                traits(LawKind::mohr_coulomb).is_cosserat == MohrCoulomb::is_cosserat &&
                traits(LawKind::drucker_prager).is_cosserat == DruckerPrager::is_cosserat &&
                traits(LawKind::cosserat_mohr_coulomb).is_cosserat == CosseratMohrCoulomb::is_cosserat &&
                traits(LawKind::cosserat_drucker_prager).is_cosserat == CosseratDruckerPrager::is_cosserat);

  Law make_law(const LawKind law, const LawOptions &options, const Units &units)
  {
    if (traits(law).is_plastic && options.hardening == HardeningKind::kinematic)
      {
        validate(law, options);
        if (law == LawKind::drucker_prager)
          return KinematicLaw<false>(options, ConeShape::drucker_prager, units);
        return KinematicLaw<true>(
          options, law == LawKind::cosserat_mohr_coulomb ? ConeShape::mohr_coulomb : ConeShape::drucker_prager, units);
      }
    switch (law)
      {
      case LawKind::linear_elastic:
        return LinearElastic(options, units);
      case LawKind::mohr_coulomb:
        return MohrCoulomb(options, units);
      case LawKind::drucker_prager:
        return DruckerPrager(options, units);
      case LawKind::cosserat_mohr_coulomb:
        return CosseratMohrCoulomb(options, units);
      case LawKind::cosserat_drucker_prager:
        return CosseratDruckerPrager(options, units);
      case LawKind::library:
        return LibraryLaw(options, units);
      case LawKind::gradient_mohr_coulomb:
        return GradientMohrCoulomb(options, units);
      case LawKind::gradient_drucker_prager:
        return GradientDruckerPrager(options, units);
      }
    throw std::logic_error("make_law: a law without a constructor");
  }
} // namespace diptych::continuum
