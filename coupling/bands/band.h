// diptych: shear bands in a displacement field, one operator for grains and nodes
// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <array>
#include <cmath>
#include <cstdint>
#include <string>
#include <vector>

#include <Eigen/Core>

#include "coupling/bands/band_options.h"
#include "coupling/statistics/interval.h"
#include "coupling/fields/strain_increment.h"

namespace diptych::coupling
{
  // What lengths and displacements are measured against.
  struct SampleFrame
  {
    Eigen::Vector2d centre = Eigen::Vector2d::Zero();           // of the sample's bounding box, or of its outline [length]
    double          width = 0, height = 0;                      // of the sample [length]
    double          mean_diameter    = 1;                       // [length]
    Eigen::Vector2d platen_increment = Eigen::Vector2d::Zero(); // displacement increment of the upper platen [length]
  };

  // The numbers of a band with their 95 % intervals (band_intervals.h), each in the unit it has in Band. Ends that are not
  // known are NaN. Angles are unwrapped around the value.
  struct BandIntervals
  {
    Interval angle_deg, half_width, width_10_90, offset, jump, dilation_deg;
    int      resamples  = 0;   // kept
    double   lost_share = NAN; // of all resamples: those in which the fit failed or was no band any more; NaN: none were drawn
  };

  // A band along s = (cos, sin)(angle) with normal n = (-sin, cos)(angle), n_y >= 0. Across it the displacement increment is
  // u = c + G (x - centre) + (J/2) tanh((n.(x - centre) - offset) / half_width): J is what the side n points to moves relative to
  // the other.
  struct Band
  {
    double angle_deg        = 0; // of the band line from the horizontal, in (-90, 90]
    double half_width       = 0; // delta [length]
    double width_10_90      = 0; // 2.197 delta [length]
    double offset           = 0; // from the sample's centre along n [length]
    double jump             = 0; // |J| / |platen increment|, with the sign of J.s: positive when the side of n moves along +s
    double dilation_deg     = 0; // atan2(J.n, |J.s|): positive when the band opens
    double r_squared        = 0; // weighted 1 - SS_res/SS_tot of the longitudinal component u.s at the raw points
    double r_squared_strips = 0; // the same for the means over 16 strips parallel to the band

    double to_minor_stress_deg = NAN; // angle to the minor principal stress beside it, in [0, 90]; NaN: not known here

    BandIntervals interval; // of the numbers above

    Eigen::Vector2d direction() const { return {std::cos(angle_deg * M_PI / 180), std::sin(angle_deg * M_PI / 180)}; }

    Eigen::Vector2d normal() const { return {-std::sin(angle_deg * M_PI / 180), std::cos(angle_deg * M_PI / 180)}; }
  };

  struct BandReport
  {
    std::vector<Band>     bands;                           // strongest jump first; empty: diffuse
    std::array<double, 3> bic         = {{NAN, NAN, NAN}}; // of no, one and two bands; NaN: not fitted, or no valid fit
    std::array<double, 3> residual    = {{NAN, NAN, NAN}}; // robust root mean square of the misfit / |platen increment|
    double                n_effective = 0;                 // independent samples assumed
    bool                  converged   = false;             // of the chosen fit
    std::string           verdict;                         // "diffuse", "one band", "two bands", and why no more
  };

  // Fits no, one and two bands (Huber loss, variable projection) and keeps the number with the lowest BIC; n in it is the number
  // of independent samples, two for each square of the correlation length, not the number of points. A transition as wide as half
  // the sample is not told from the affine background: it is reported as diffuse. Throws std::invalid_argument for fewer than 30
  // weighted points, a platen increment of zero or a frame without extent. The seed draws the blocks of the intervals and nothing
  // else.
  [[nodiscard]] BandReport find_bands(const DisplacementField &field,
                                      const SampleFrame       &frame,
                                      const BandOptions       &options = {},
                                      std::uint64_t            seed    = 1);

  // Under vertical loading chance decides whether a band leans to the left or to the right. A band of negative angle is mirrored
  // left to right (about the sample's centre): angle and jump change sign, offset, widths and dilation stay; a band of
  // positive angle, a level or an upright one is returned as it is. So folded, the bands of several samples can be averaged.
  Band folded(const Band &band);
} // namespace diptych::coupling
