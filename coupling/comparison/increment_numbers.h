// diptych: list of the numbers of an increment: bands, strips, and their differences
// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <algorithm>

#include "coupling/comparison/band_difference.h"
#include "coupling/comparison/increment.h"
#include "coupling/numbers/number_entry.h"

namespace diptych::coupling
{
  // See number_entry.h. Lengths are in mean diameters if the unit is mean diameters, stresses in the scene's unit and positive in
  // compression. Angles are anticlockwise from the horizontal.

  template <class Visitor> void list_numbers(const Band &b, Visitor &v)
  {
    const BandIntervals &i = b.interval;
    v({"angle_deg", "degrees", "inclination, anticlockwise from the horizontal", Kind::line}, i.angle_deg);
    v({"half_width_d", "mean diameters", "half width δ of the hyperbolic tangent", Kind::number, true}, i.half_width);
    v({"width_10_90_d", "mean diameters", "10–90 % width", Kind::number, true}, i.width_10_90);
    v({"offset_d", "mean diameters", "offset from the sample's centre along the normal", Kind::number, true}, i.offset);
    v({"jump", "-", "displacement jump over the platen's displacement, with the sign of the slip"}, i.jump);
    v({"dilation_deg", "degrees", "dilation angle, positive if the band opens"}, i.dilation_deg);
    v({"between_packs", "-", "true for a band between two packs that the platens carry", Kind::setting}, b.between_packs());
    v({"no_packs_because", "-", "reasons against a band between two packs", Kind::setting}, b.no_packs_because);
    v({"to_minor_stress_deg", "degrees", "angle to the minor principal stress in the band"}, b.to_minor_stress_deg);
    v({"resamples", "-", "number of resamples behind the intervals", Kind::setting}, i.resamples);
    v({"lost_share", "-", "share of the resamples in which the band was lost"}, i.lost_share);
    v({"diffuse", "-", "true for a zone wider than a third of the sample's narrower side, whose inclination enters no comparison",
       Kind::setting},
      b.is_diffuse);
    v({"r_squared", "-", "R² of the fit at the points"}, b.r_squared);
    v({"r_squared_strips", "-", "R² of the fit for means over strips"}, b.r_squared_strips);
  }

  template <class Visitor> void list_numbers(const Strips &s, Visitor &v)
  {
    v({"angle_deg", "degrees", "direction of the strips, anticlockwise from the horizontal", Kind::setting}, s.angle_deg);
    v({"edges_d", "mean diameters", "edges of the strips along the normal, from the sample's centre", Kind::setting, true},
      s.edges);
    v({"mean", "platen increments", "mean displacement along the strip"}, s.mean);
    v({"deviation", "platen increments", "standard deviation of the displacement along the strip"}, s.deviation);
    v({"count", "-", "number of points in the strip"}, s.count);
    v({"background", "platen increments", "value at the sample's centre of the straight line under the band's tanh"},
      s.background);
    v({"background_slope", "platen increments/mean diameter",
       "slope along the normal of the straight line under the band's tanh"},
      s.background_slope);
  }

  template <class Visitor> void list_numbers(const BandProfile &p, Visitor &v)
  {
    v({"angle_deg", "degrees", "inclination of the band across which the profile runs", Kind::setting}, p.angle_deg);
    v({"offset_d", "mean diameters", "offset of this band from the sample's centre along its normal", Kind::setting, true},
      p.offset);
    v({"blocks", "-", "number of resampled blocks along the band", Kind::setting}, p.blocks);
    v({"spin_amplitude", "rad", "spin of the material in the band's middle, beyond that beside it; positive as the shear turns"},
      p.spin_amplitude);
    v({"rotation_amplitude", "rad",
       "rotation minus spin in the band's middle, beyond that beside it; positive as the shear turns"},
      p.rotation_amplitude);
    v({"rotation_width_10_90_d", "mean diameters", "10–90 % width of this relative rotation; null if its amplitude may be 0"},
      p.rotation_width_10_90);
    v({"couple_stress_peak", "pressure length",
       "largest couple stress along the band's normal, from a fit with the shape of a rotation's gradient"},
      p.couple_stress_peak);
    v({"loosening", "-", "solid fraction beside the band minus that in its middle"}, p.loosening);
  }

  template <class Visitor> void list_numbers(const PanelIncrement &p, Visitor &v)
  {
    v.list("bands", "shear bands, the strongest first", p.band.bands);
    v({"band_verdict", "-", "verdict of the band detection"}, p.band.verdict);
    v({"band_misfit", "platen increments", "robust root mean square of the displacements that the fit of the bands leaves"},
      p.band.residual[std::min(p.band.bands.size(), p.band.residual.size() - 1)]);
    v({"bic_of_0_1_2_bands", "-", "Bayesian information criterion for no, one and two bands"}, p.band.bic);
    v({"independent_samples", "-", "number of independent samples assumed"}, p.band.n_effective);
    v.group("strips", "means over strips parallel to the band", p.strips);
    v.group("profile", "fits to the profiles across the band, whose curves are arrays of comparison.h5", p.profile);
  }

  template <class Visitor> void list_numbers(const BandValues &d, Visitor &v)
  {
    v({"angle_deg", "degrees", "rotation from the grains' band to the continuum's, anticlockwise"}, d.angle_deg);
    v({"half_width_d", "mean diameters", "difference of the half widths", Kind::number, true}, d.half_width);
    v({"width_10_90_d", "mean diameters", "difference of the 10–90 % widths", Kind::number, true}, d.width_10_90);
    v({"offset_d", "mean diameters", "difference of the offsets", Kind::number, true}, d.offset);
    v({"jump", "-", "difference of the jumps"}, d.jump);
    v({"dilation_deg", "degrees", "difference of the dilation angles"}, d.dilation_deg);
  }

  template <class Visitor> void list_numbers(const Increment &w, Visitor &v)
  {
    v({"from", "strain or time", "progress at the beginning of the window", Kind::setting}, w.from);
    v({"to", "strain or time", "progress at the end of the window", Kind::setting}, w.to);
    v({"duration", "time", "duration of the window in the grains' loading", Kind::setting}, w.duration);
    v({"displacement_unit_d", "mean diameters", "unit of displacements: the displacement of the upper platen", Kind::setting,
       true},
      w.displacement_unit);
    v.group("discrete", "the grains", w.discrete);
    v.group("continuum", "the continuum", w.continuum);
    v.group("difference", "continuum minus grains, for the bands that are compared", band_difference(w));
  }
} // namespace diptych::coupling
