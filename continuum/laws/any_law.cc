// diptych: the constitutive laws that a scene can choose
// SPDX-License-Identifier: LGPL-2.1-or-later
#include "continuum/laws/any_law.h"

#include <stdexcept>

namespace diptych::continuum
{
  namespace
  {
    // A library has no strength of its own; whether it is a Cosserat law is known when it is opened (continuum/options.h).
    template <class AnyLaw> constexpr bool are_traits_of(const LawKind law)
    {
      if constexpr (std::is_same_v<AnyLaw, LibraryLaw>)
        return !traits(law).is_cosserat && !traits(law).is_gradient && !traits(law).is_plastic;
      else
        return traits(law).is_cosserat == AnyLaw::is_cosserat &&
               traits(law).is_gradient == std::is_base_of_v<GradientLaw, AnyLaw> &&
               traits(law).is_plastic == std::is_base_of_v<ConeLaw, AnyLaw>;
    }

    static_assert(choices(LawKind()).size() == 8);
    static_assert(are_traits_of<CosseratMohrCoulomb>(LawKind::cosserat_mohr_coulomb));
    static_assert(are_traits_of<CosseratDruckerPrager>(LawKind::cosserat_drucker_prager));
    static_assert(are_traits_of<GradientMohrCoulomb>(LawKind::gradient_mohr_coulomb));
    static_assert(are_traits_of<GradientDruckerPrager>(LawKind::gradient_drucker_prager));
    static_assert(are_traits_of<MohrCoulomb>(LawKind::mohr_coulomb));
    static_assert(are_traits_of<DruckerPrager>(LawKind::drucker_prager));
    static_assert(are_traits_of<LinearElastic>(LawKind::linear_elastic));
    static_assert(are_traits_of<LibraryLaw>(LawKind::library));
  } // namespace

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
