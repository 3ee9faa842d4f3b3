// diptych: isotropic linear elasticity in plane strain
// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include "continuum/laws/law.h"

namespace diptych::continuum
{
  struct ElasticOptions
  {
    // A packing of rigid discs has no modulus of its own: E/P sets only how steep the curve rises before the peak.
    double youngs_modulus = 500; // [pressure]; in units of the lateral pressure where the scene has P = 1
    // 0.1-0.25 is measured on dense granular packings at small strain (fabric, not grain, elasticity); 0.2 puts the
    // plane-strain K0 at nu/(1-nu) = 0.25, clearly inside the elastic range of any sand-like friction angle.
    double poisson_ratio = 0.2; // [-]
  };

  template <class Visitor> void visit_parameters(ElasticOptions &o, Visitor &&visitor)
  {
    visitor("youngs_modulus", o.youngs_modulus, "P", {1e-3, 1e12}, "Young's modulus; steepness of the curve before the peak");
    visitor("poisson_ratio", o.poisson_ratio, "-", {0., 0.49}, "Poisson's ratio");
  }

  // Moduli of the plane problem: stress = bulk tr(strain) 1 + 2 shear dev(strain), dev in two dimensions, so that
  // bulk = K + G/3; d sigma_zz = (K - 2 G/3) tr(strain).
  struct PlaneModuli
  {
    double shear   = 0; // G [pressure]
    double bulk    = 0; // K + G/3 [pressure]
    double lateral = 0; // K - 2 G/3 [pressure]
  };

  PlaneModuli                   plane_moduli(const ElasticOptions &options);
  dealii::SymmetricTensor<4, 2> elastic_tangent(const PlaneModuli &moduli);

  // Throws std::invalid_argument naming the value and its range.
  void validate(const ElasticOptions &options);

  class LinearElastic
  {
  public:
    explicit LinearElastic(const ElasticOptions &options);

    // End state of the strain increment `d_strain` (tension positive) from the committed state `s0`.
    MaterialUpdate update(const MaterialState &s0, const dealii::SymmetricTensor<2, 2> &d_strain) const;

  private:
    PlaneModuli                   moduli;
    dealii::SymmetricTensor<4, 2> tangent;
  };
} // namespace diptych::continuum
