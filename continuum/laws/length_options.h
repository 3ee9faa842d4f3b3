// diptych: parameters of the laws with an internal length
// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

namespace diptych::continuum
{
  struct LengthOptions
  {
    double internal_length = 1; // [Units::length]
  };

  template <class Visitor> void visit_parameters(LengthOptions &o, Visitor &&visitor)
  {
    visitor("internal_length", o.internal_length, "mean diameters", {1e-6, 1e6},
            "Cosserat laws: couple modulus = 2 G length^2; gradient laws: the hardening variable is averaged over this length; "
            "sets the thickness of the band");
  }

  struct CosseratOptions : virtual LengthOptions
  {
    double couple_shear_ratio = 0.5; // skew modulus / shear modulus [-]
  };

  template <class Visitor> void visit_parameters(CosseratOptions &o, Visitor &&visitor)
  {
    visitor("couple_shear_ratio", o.couple_shear_ratio, "-", {1e-6, 1e6}, "Cosserat laws: skew modulus / shear modulus");
  }

  struct GradientOptions : virtual LengthOptions
  {
    double nonlocal_weight = 4; // of the nonlocal hardening variable [-]
  };

  template <class Visitor> void visit_parameters(GradientOptions &o, Visitor &&visitor)
  {
    visitor(
      "nonlocal_weight", o.nonlocal_weight, "-", {1., 10.},
      "gradient laws: weight m of the averaged hardening variable, the local one has 1 - m; with 1 the mesh sets the band's "
      "thickness");
  }
} // namespace diptych::continuum
