// diptych: up to where panels count as equivalent, as a scene says it
// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

namespace diptych::coupling
{
  // How far the continuum may be from the grains and still count as equivalent. Chosen by the user, before looking at results.
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
            "ensembles of seeds: inclinations of the bands that differ by less count as equivalent");
    visitor("margin_thickness", o.thickness, "-", {1e-6, 10.},
            "likewise 10-90 % widths of the bands, relative to the mean of the grains");
    visitor("margin_peak_stress_ratio", o.peak_stress_ratio, "-", {1e-6, 10.},
            "likewise peak stress ratios and strengths (T/S beyond 0.3 % strain), relative to the mean of the grains");
    visitor("margin_volumetric_strain", o.volumetric_strain, "-", {1e-9, 1.},
            "likewise volumetric strains at the end, as they are");
  }
} // namespace diptych::coupling
