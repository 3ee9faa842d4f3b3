// diptych: tractions on planes parallel to a band, one value per strip
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
  // Rectangles along a band, one per strip, each in the middle part of the sample's chord there.
  struct TractionStrips
  {
    Eigen::Vector2d     origin;        // the sample's centre [length]
    double              angle_deg = 0; // from the horizontal to the band: s = (cos, sin), normal n = (-sin, cos)
    std::vector<double> edges;         // n + 1 positions along n from the origin, ascending [length]
    std::vector<double> from, to;      // n each, along s from the origin [length]; NaN: too short for a value
  };

  // n entries each, NaN in strips without a value. The traction is exerted by the side behind n on the side to which n points
  // [pressure]. Its normal part is positive in compression, its shear part acts along s.
  struct BandTraction
  {
    std::vector<double> edges; // [length]
    std::vector<double> normal, shear;
    // Grains: standard errors from blocks along the strip. Continuum: empty.
    std::vector<double> normal_error, shear_error;
    // Standard deviation over the strips, relative to the magnitude of the mean traction.
    double variation_normal = NAN, variation_shear = NAN;
    // Root mean square of the standard errors, relative to the magnitude of the mean traction.
    double independent_normal = NAN, independent_shear = NAN;
  };

  // The rectangle of a strip is the middle `share` of its chord, at least 2 mean diameters away from the outline. The chord is
  // the shortest of three: on both edges and on the middle line. Strips shorter than 8 mean diameters have no value.
  TractionStrips traction_strips(const std::vector<Eigen::Vector2d> &outline,
                                 const SampleFrame                  &frame,
                                 double                              angle_deg,
                                 const std::vector<double>          &edges,
                                 double                              share = 0.7);

  // sigma.n of each strip, with sigma = -sum f (x) (branch within the rectangle) / area. This is the mean, over all lines of
  // the strip, of (force through the branches that cross a line) / (its length). The errors come from at least three blocks of
  // at least `block` [length] along the strip, assumed independent. In equilibrium one block carries what its neighbour does
  // not, so real tractions vary less. Throws std::invalid_argument for a block that is not positive.
  BandTraction grain_band_traction(const TractionStrips &strips, const GrainNetwork &network, double block);

  // Tractions of a stress that is constant on cells, n_cells entries [pressure], using the exact part of each triangle. Cells
  // without a value (NaN) are left out. Throws std::invalid_argument if there is not one stress per cell.
  BandTraction cell_band_traction(const TractionStrips               &strips,
                                  const QuadMesh                     &mesh,
                                  const TriangleSearch               &search,
                                  const std::vector<Eigen::Matrix2d> &stress);
} // namespace diptych::coupling
