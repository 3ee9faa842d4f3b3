// diptych: energy dissipated inside and outside the band, beside the share of the area that the band covers
// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <vector>

#include <Eigen/Core>

#include "coupling/bands/band_zone.h"
#include "coupling/cells/mesh_cells.h"

namespace diptych::coupling
{
  // Energies per unit thickness [pressure * length^2]. Shares refer to the whole sample; NaN if nothing is dissipated.
  struct DissipationSplit
  {
    double inside = 0, outside = 0;
    double share_inside = NAN, area_share = NAN;
    double density_ratio = NAN; // dissipation per area, inside over outside
  };

  // A contact is inside the zone if its contact point is. `dissipation`: n_contacts energies; outline: outline of the sample,
  // counter-clockwise. Throws std::invalid_argument if there is not one energy per point, or no outline.
  DissipationSplit contact_dissipation_split(const BandZone                     &zone,
                                             const std::vector<Eigen::Vector2d> &outline,
                                             const std::vector<Eigen::Vector2d> &points,
                                             const std::vector<double>          &dissipation);

  // A cell counts in proportion to the exact share of its area inside the zone. `dissipation`: n_cells energies per area
  // [pressure]. Cells without a value (NaN) count neither in the energy nor in the area. Throws std::invalid_argument if there is
  // not one value per cell.
  DissipationSplit cell_dissipation_split(const BandZone &zone, const QuadMesh &mesh, const std::vector<double> &dissipation);
} // namespace diptych::coupling
