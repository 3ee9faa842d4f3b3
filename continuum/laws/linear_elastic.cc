// diptych: isotropic linear elasticity in plane strain
// SPDX-License-Identifier: LGPL-2.1-or-later
#include "continuum/laws/linear_elastic.h"

#include <cmath>

namespace diptych::continuum
{
  LinearElastic::LinearElastic(const LawOptions &options)
      : moduli_(elastic_moduli(options, false)),
        tangent(continuum::elastic_tangent(moduli_))
  {}

  MaterialUpdate LinearElastic::update(const MaterialState &s0, const Strain &d_strain, double) const
  {
    MaterialUpdate answer{s0, tangent};
    answer.state.stress += tangent * d_strain;
    answer.state.stress_zz += moduli_.lateral * (d_strain[xx] + d_strain[yy]);
    answer.state.overstress = 0;
    if (!std::isfinite(answer.state.stress.norm()))
      answer.verdict = Verdict::failed;
    return answer;
  }
} // namespace diptych::continuum
