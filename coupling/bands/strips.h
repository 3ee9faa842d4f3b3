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
    std::vector<double> edges;     // n + 1, along the band's normal from the sample's centre, ascending [length]
    std::vector<double> mean;      // n, weighted mean of u.s / |platen increment|; NaN in an empty strip
    std::vector<double> deviation; // n, weighted standard deviation of the same
    std::vector<int>    count;     // n, points of positive weight
    // a + b x, x along the normal: what of the means a band's tanh leaves (background()); NaN without a band.
    double background = NAN, background_slope = NAN; // [platen increments], [platen increments / mean diameter]
  };

  // Edges of equal strips that cover the band's centre line +- 30 mean diameters, as far as the sample's rectangle reaches along
  // the normal. Both panels are cut at the same edges.
  std::vector<double> strip_edges(const SampleFrame &frame, double angle_deg, double offset, int n_strips = 16);

  // Straight line through the strips' means less the tanh of a band that lies along them, by least squares, a strip counting by
  // its points: a and b. NaN for fewer than two strips with points.
  std::array<double, 2> background(const Strips &strips, const Band &band);

  Strips strip_means(const DisplacementField   &field,
                     const SampleFrame         &frame,
                     double                     angle_deg,
                     const std::vector<double> &edges);
} // namespace diptych::coupling
