// diptych: the constitutive laws that a scene can choose
// SPDX-License-Identifier: LGPL-2.1-or-later
#include "continuum/laws/any_law.h"

namespace diptych::continuum
{
  Law make_law(const LawKind law, const LawOptions &options, const Units &units)
  {
    if (law == LawKind::library)
      return LibraryLaw(options.library, units);
    validate(law, options);
    const LawTraits  is = traits(law);
    const LawOptions o  = in_units(options, units);
    if (!is.is_plastic)
      return LinearElastic(o);
    if (is.has_edges())
      return MohrCoulomb(o);
    if (is.is_gradient)
      return GradientLaw(o, is.shape);
    if (o.hardening == kind_of<KinematicHardening>)
      return KinematicCone(o, is.shape, is.is_cosserat);
    return ConeLaw(o, is.shape, is.is_cosserat);
  }

  Law make_uniform_law(const LawKind law, const LawOptions &options, const Units &units)
  {
    if (!traits(law).is_gradient)
      return make_law(law, options, units);
    validate(law, options);
    return ConeLaw(in_units(options, units), traits(law).shape, false);
  }
} // namespace diptych::continuum
