// diptych: strips parallel to a band and the mean longitudinal displacement in each (Moreau 1997)
// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <array>
#include <cmath>
#include <vector>

#include "coupling/bands/band.h"
#include "coupling/fields/strain_increment.h"

namespace diptych::coupling
{
  struct Strips
  {
    double              angle_deg = 0;
    std::vector<double> edges;     // n + 1 positions along the band's normal from the sample's centre, ascending [length]
    std::vector<double> mean;      // n weighted means of u.s / |platen increment|; NaN in an empty strip
    std::vector<double> deviation; // n weighted standard deviations of the same
    std::vector<int>    count;     // n numbers of points of positive weight
    // Straight line a + b x, x along the normal, through the means minus a band's tanh (background()). NaN without a band.
    double background = NAN, background_slope = NAN; // [platen increments], [platen increments / mean diameter]
  };

  // Edges of equal strips that cover the band's centre line +- 30 mean diameters, within the extent of the sample's rectangle
  // along the normal. Both panels use the same edges.
  std::vector<double> strip_edges(const SampleFrame &frame, double angle_deg, double offset, int n_strips = 16);

  // Coefficients a and b of the least squares line through the strips' means minus the tanh of the band along them. A strip is
  // weighted by its number of points. NaN if fewer than two strips have points.
  std::array<double, 2> background(const Strips &strips, const Band &band);

  Strips strip_means(const DisplacementField   &field,
                     const SampleFrame         &frame,
                     double                     angle_deg,
                     const std::vector<double> &edges);
} // namespace diptych::coupling
