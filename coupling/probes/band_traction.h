// diptych: tractions on planes parallel to a band, strip by strip across it
// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <vector>

#include <Eigen/Core>

#include "coupling/bands/band.h"
#include "coupling/probes/grain_network.h"
#include "coupling/cells/mesh_cells.h"
#include "coupling/cells/triangle_search.h"

namespace diptych::coupling
{
  // Rectangles along a band, one a strip, each in the middle part of the sample's own chord there.
  struct TractionStrips
  {
    Eigen::Vector2d     origin;        // the sample's centre [length]
    double              angle_deg = 0; // of the band from the horizontal: s = (cos, sin), normal n = (-sin, cos)
    std::vector<double> edges;         // n + 1, along n from the origin, ascending [length]
    std::vector<double> from, to;      // n each, along s from the origin [length]; NaN: too short to carry a value
  };

  // n entries each, NaN in strips without a value. Traction of the side behind n on the side n points to: normal part positive
  // in compression, shear along s [pressure].
  struct BandTraction
  {
    std::vector<double> edges; // [length]
    std::vector<double> normal, shear;
    std::vector<double> normal_error, shear_error;            // grains: standard errors from blocks along the strip; else empty
    double variation_normal = NAN, variation_shear = NAN;     // standard deviation over the strips / size of the mean traction
    double independent_normal = NAN, independent_shear = NAN; // root mean square standard error / the same size
  };

  // The middle `share` of each strip's chord (of the shortest of its edges' and its middle line's common part), kept 2 mean
  // diameters clear of the outline; strips shorter than 8 mean diameters carry no value.
  TractionStrips traction_strips(const std::vector<Eigen::Vector2d> &outline,
                                 const SampleFrame                  &frame,
                                 double                              angle_deg,
                                 const std::vector<double>          &edges,
                                 double                              share = 0.7);

  // sigma.n of the strip, sigma = -sum f (x) (branch within the rectangle) / area: the mean over all lines of the strip of the
  // forces whose branch crosses the line / its length. Errors: blocks of at least `block` [length] along the strip, three
  // or more, taken as independent (in equilibrium neighbours carry what one lacks, so real tractions vary less). Equilibrium
  // asks for uniform tractions, but for what the sides of the strips' part of the sample carry. Throws std::invalid_argument
  // for a block that is not positive.
  BandTraction grain_band_traction(const TractionStrips &strips, const GrainNetwork &network, double block);

  // The same of a stress that is constant on cells, n_cells entries [pressure], by the exact part of each triangle; cells without
  // a value (NaN) are left out. Throws std::invalid_argument where there is not one stress a cell.
  BandTraction cell_band_traction(const TractionStrips               &strips,
                                  const QuadMesh                     &mesh,
                                  const TriangleSearch               &search,
                                  const std::vector<Eigen::Matrix2d> &stress);
} // namespace diptych::coupling
