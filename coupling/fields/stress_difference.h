// diptych: how far the stresses of the two panels are apart, beside what sampling alone would give
// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <string>
#include <vector>

#include <Eigen/Core>

#include "coupling/cells/mesh_cells.h"

namespace diptych::coupling
{
  // Both panels on the same cells, n_cells entries each; NaN where a panel has no value [pressure].
  struct StressPair
  {
    std::vector<Eigen::Matrix2d> grains, continuum;
    std::vector<double>          standard_error; // of a grain cell, Frobenius norm, its grains taken as independent
  };

  struct StressDifference
  {
    std::string label;                // "cells", "3 d", "6 d"
    double      size           = 0;   // of the cells [length]
    int         cells          = 0;   // that carry both values
    double      relative_l2    = NAN; // sqrt(sum A |a - b|^2 / sum A |b|^2) of the symmetric parts, b the continuum's
    double      direction_deg  = NAN; // root mean square angle between the major principal directions, by area
    double      sampling_alone = NAN; // the same norm of the grains' scatter about their own smooth field
    double      lowest_scatter = NAN; // what independent grains would give: neighbours share force chains, so a lower bound
  };

  // The smooth field is a quadratic polynomial in x and y fitted to each component of the grains' cells by least squares; its
  // residual is scaled by n / (n - 6). What the sample really has beyond a quadratic (a narrow band) counts as scatter there.
  StressDifference stress_difference(const QuadMesh &mesh, const StressPair &stress);

  // What the widest cells say: whether the panels differ by more than sampling explains.
  std::string stress_verdict(const StressDifference &widest);
} // namespace diptych::coupling
