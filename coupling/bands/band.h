// diptych: a shear band
// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <cmath>
#include <string>

#include <Eigen/Core>

#include "coupling/statistics/interval.h"

namespace diptych::coupling
{
  // The reference values for lengths and displacements.
  struct SampleFrame
  {
    Eigen::Vector2d centre = Eigen::Vector2d::Zero();           // centre of the sample's bounding box or outline [length]
    double          width = 0, height = 0;                      // size of the sample [length]
    double          mean_diameter    = 1;                       // [length]
    Eigen::Vector2d platen_increment = Eigen::Vector2d::Zero(); // displacement increment of the upper platen [length]
  };

  // The numbers of a band with their 95 % intervals (band_intervals.h), each in its unit in Band. Unknown ends are NaN. Angles
  // are unwrapped around the value.
  struct BandValues
  {
    Interval angle_deg, half_width, width_10_90, offset, jump, dilation_deg;
  };
  struct BandIntervals : BandValues
  {
    int    resamples  = 0;   // resamples that held the band
    double lost_share = NAN; // share of the resamples in which the fit failed or found no band; NaN: no resamples were drawn
  };

  constexpr double widest_band = 1 / 3.; // 10-90 % width / narrower side of the sample; a wider zone is diffuse

  // A band along s = (cos, sin)(angle) with normal n = (-sin, cos)(angle), n_y >= 0. Across it the displacement increment is
  // u = c + G (x - centre) + (J/2) tanh((n.(x - centre) - offset) / half_width).
  // J is the displacement of the side to which n points, relative to the other side.
  struct Band
  {
    double angle_deg        = 0; // from the horizontal to the band line, in (-90, 90]
    double half_width       = 0; // delta [length]
    double width_10_90      = 0; // 2.197 delta [length]
    double offset           = 0; // from the sample's centre along n [length]
    double jump             = 0; // |J| / |platen increment|, with the sign of J.s: positive if the side of n moves along +s
    double dilation_deg     = 0; // atan2(J.n, |J.s|): positive if the band opens
    double r_squared        = 0; // weighted 1 - SS_res/SS_tot of the longitudinal component u.s at the raw points
    double r_squared_strips = 0; // r_squared of the means over 16 strips parallel to the band

    bool is_diffuse = false; // wider than widest_band of the sample's narrower side: no comparison uses its angle

    std::string no_packs_because = "not judged"; // why it is not a band between two packs (packs.h); empty: it is one

    Interval to_minor_stress_deg; // angle to the minor principal stress beside the band, in [0, 90]; NaN: not known. Its interval
                                  // is that of the inclination only.

    BandIntervals interval; // intervals of the numbers above

    bool            between_packs() const { return no_packs_because.empty(); }
    Eigen::Vector2d direction() const { return {std::cos(angle_deg * M_PI / 180), std::sin(angle_deg * M_PI / 180)}; }

    Eigen::Vector2d normal() const { return {-std::sin(angle_deg * M_PI / 180), std::cos(angle_deg * M_PI / 180)}; }
  };

  // Under vertical loading a band leans left or right by chance. Mirrors a band of negative angle left to right about the
  // centre: angle and jump change sign. Bands of several samples can then be averaged. Any other band is returned unchanged.
  Band folded(const Band &band);
} // namespace diptych::coupling
