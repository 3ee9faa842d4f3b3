// diptych: options for the margins within which panels count as equivalent
// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

namespace diptych::coupling
{
  // The largest difference between continuum and grains that still counts as equivalent. Choose these before you look at results.
  struct EquivalenceMargins
  {
    double angle             = 3;
    double thickness         = 0.2;
    double peak_stress_ratio = 0.03;
    double volumetric_strain = 0.002;
  };

  template <class Visitor> void visit_parameters(EquivalenceMargins &o, Visitor &&visitor)
  {
    visitor("margin_angle", o.angle, "degrees", {1e-6, 90.},
            "largest difference of the bands' inclinations that counts as equivalent in an ensemble of seeds");
    visitor("margin_thickness", o.thickness, "-", {1e-6, 10.},
            "largest difference of the bands' 10-90 % widths that counts as equivalent in an ensemble of seeds, relative to the "
            "mean of the grains");
    visitor(
      "margin_peak_stress_ratio", o.peak_stress_ratio, "-", {1e-6, 10.},
      "largest difference of peak stress ratios, and of strengths (T/S beyond 0.3 % strain), that counts as equivalent in an "
      "ensemble of seeds, relative to the mean of the grains");
    visitor(
      "margin_volumetric_strain", o.volumetric_strain, "-", {1e-9, 1.},
      "largest difference of the volumetric strains at the end that counts as equivalent in an ensemble of seeds (absolute)");
  }
} // namespace diptych::coupling
