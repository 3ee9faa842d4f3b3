// diptych: isotropic linear elasticity in plane strain
// SPDX-License-Identifier: LGPL-2.1-or-later
#include "continuum/laws/linear_elastic.h"

#include <sstream>
#include <stdexcept>

namespace diptych::continuum
{
  void validate(const ElasticOptions &options)
  {
    std::ostringstream wrong;
    if (!(options.youngs_modulus > 0))
      wrong << "youngs_modulus = " << options.youngs_modulus << " must be positive";
    else if (!(options.poisson_ratio >= 0 && options.poisson_ratio < 0.5))
      wrong << "poisson_ratio = " << options.poisson_ratio << " must lie in [0, 0.5)";
    if (!wrong.str().empty())
      throw std::invalid_argument(wrong.str());
  }

  PlaneModuli plane_moduli(const ElasticOptions &options)
  {
    const double shear = options.youngs_modulus / (2 * (1 + options.poisson_ratio));
    const double bulk  = options.youngs_modulus / (3 * (1 - 2 * options.poisson_ratio));
    return {shear, bulk + shear / 3, bulk - 2 * shear / 3};
  }

  dealii::SymmetricTensor<4, 2> elastic_tangent(const PlaneModuli &moduli)
  {
    const auto one = dealii::unit_symmetric_tensor<2>();
    return moduli.bulk * outer_product(one, one) + 2 * moduli.shear * dealii::deviator_tensor<2>();
  }

  LinearElastic::LinearElastic(const ElasticOptions &options)
      : moduli(plane_moduli(options)),
        tangent(elastic_tangent(moduli))
  {
    validate(options);
  }

  MaterialUpdate LinearElastic::update(const MaterialState &s0, const dealii::SymmetricTensor<2, 2> &d_strain) const
  {
    MaterialUpdate answer{s0, tangent};
    answer.state.stress += tangent * d_strain;
    answer.state.stress_zz += moduli.lateral * trace(d_strain);
    return answer;
  }
} // namespace diptych::continuum
