// diptych: difference between the stresses of the two panels, beside the scatter that sampling would give
// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <string>
#include <vector>

#include <Eigen/Core>

#include "coupling/cells/mesh_cells.h"

namespace diptych::coupling
{
  // Stresses of both panels on the same cells [pressure]. n_cells entries each, NaN where a panel has no value.
  struct StressPair
  {
    std::vector<Eigen::Matrix2d> grains, continuum;
    std::vector<double>          standard_error; // of a cell's grain stress, Frobenius norm, for independent grains
  };

  struct StressDifference
  {
    std::string label;             // "cells", "3 d", "6 d"
    double      size        = 0;   // side of the cells [length]
    int         cells       = 0;   // number of cells with both values
    double      relative_l2 = NAN; // sqrt(sum A |a - b|^2 / sum A |b|^2) of the symmetric parts, a of the grains, b of the
                                   // continuum
    double direction_deg  = NAN;   // root mean square angle between the major principal directions, weighted by area
    double sampling_alone = NAN;   // the norm of relative_l2 for the grains' scatter about their own smooth field
    double lowest_scatter = NAN;   // scatter of independent grains: a lower bound, because neighbours share force chains
  };

  // The smooth field is a quadratic polynomial in x and y, fitted by least squares to each component of the grains' cells. Its
  // residual is scaled by n / (n - 6). Real features beyond a quadratic, such as a narrow band, count as scatter.
  StressDifference stress_difference(const QuadMesh &mesh, const StressPair &stress);

  // States whether the panels differ by more than sampling explains, from the widest cells.
  std::string stress_verdict(const StressDifference &widest);
} // namespace diptych::coupling
