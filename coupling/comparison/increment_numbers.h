// diptych: the list of the numbers of an increment: bands, strips, their differences
// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include "coupling/comparison/band_difference.h"
#include "coupling/comparison/increment.h"
#include "coupling/numbers/number_entry.h"

namespace diptych::coupling
{
  // See number_entry.h. Lengths are told in mean diameters where the unit says so, stresses in the scene's unit, positive in
  // compression; angles from the horizontal, anticlockwise.

  template <class Visitor> void list_numbers(const Band &b, Visitor &v)
  {
    const BandIntervals &i = b.interval;
    v({"angle_deg", "degrees", "inclination", Kind::line}, i.angle_deg);
    v({"half_width_d", "mean diameters", "half width δ of the hyperbolic tangent", Kind::number, true}, i.half_width);
    v({"width_10_90_d", "mean diameters", "10–90 % width", Kind::number, true}, i.width_10_90);
    v({"offset_d", "mean diameters", "offset from the sample's centre along the normal", Kind::number, true}, i.offset);
    v({"jump", "-", "jump of the displacement over the platen's, with the sign of the slip"}, i.jump);
    v({"dilation_deg", "degrees", "dilation angle"}, i.dilation_deg);
    v({"between_packs", "-", "a zone between the two packs that the platens carry", Kind::setting}, b.between_packs());
    v({"no_packs_because", "-", "what speaks against it", Kind::setting}, b.no_packs_because);
    v({"to_minor_stress_deg", "degrees", "angle to the minor principal stress of the zone"}, b.to_minor_stress_deg);
    v({"resamples", "-", "resamples behind the intervals", Kind::setting}, i.resamples);
    v({"lost_share", "-", "share of the resamples in which the band was lost"}, i.lost_share);
    v({"r_squared", "-", "R² at the points"}, b.r_squared);
    v({"r_squared_strips", "-", "R² of means over strips"}, b.r_squared_strips);
  }

  template <class Visitor> void list_numbers(const Strips &s, Visitor &v)
  {
    v({"angle_deg", "degrees", "direction of the strips", Kind::setting}, s.angle_deg);
    v({"edges_d", "mean diameters", "edges along the normal", Kind::setting, true}, s.edges);
    v({"mean", "platen increments", "mean displacement along the strips"}, s.mean);
    v({"deviation", "platen increments", "its standard deviation"}, s.deviation);
    v({"count", "-", "points in a strip"}, s.count);
    v({"background", "platen increments", "of the straight line under the band's tanh, at the sample's centre"}, s.background);
    v({"background_slope", "platen increments/mean diameter", "its slope along the normal"}, s.background_slope);
  }

  // What both kinds of increments tell of a panel.
  template <class Visitor> void list_numbers(const PanelIncrement &p, Visitor &v)
  {
    v.list("bands", "shear bands, the strongest first", p.band.bands);
    v({"band_verdict", "-", "the detector's words"}, p.band.verdict);
    v({"bic_of_0_1_2_bands", "-", "Bayesian information criterion of none, one and two bands"}, p.band.bic);
    v({"independent_samples", "-", "independent samples assumed"}, p.band.n_effective);
    v.group("strips", "means over strips parallel to the band", p.strips);
  }

  template <class Visitor> void list_numbers(const BandDifference &d, Visitor &v)
  {
    v({"angle_deg", "degrees", "turn from the grains' band to the continuum's"}, d.angle_deg);
    v({"half_width_d", "mean diameters", "difference of the half widths", Kind::number, true}, d.half_width);
    v({"width_10_90_d", "mean diameters", "difference of the 10–90 % widths", Kind::number, true}, d.width_10_90);
    v({"offset_d", "mean diameters", "difference of the offsets", Kind::number, true}, d.offset);
    v({"jump", "-", "difference of the jumps"}, d.jump);
    v({"dilation_deg", "degrees", "difference of the dilation angles"}, d.dilation_deg);
  }

  template <class Visitor> void list_numbers(const Increment &w, Visitor &v)
  {
    v({"from", "as walk says", "progress at the beginning", Kind::setting}, w.from);
    v({"to", "as walk says", "progress at the end", Kind::setting}, w.to);
    v({"duration", "time", "of the grains' loading", Kind::setting}, w.duration);
    v({"displacement_unit_d", "mean diameters", "what displacements count in: the upper platen's", Kind::setting, true},
      w.displacement_unit);
    v.group("discrete", "the grains", w.discrete);
    v.group("continuum", "the continuum", w.continuum);
    v.group("difference", "continuum minus grains", band_difference(w));
  }
} // namespace diptych::coupling
