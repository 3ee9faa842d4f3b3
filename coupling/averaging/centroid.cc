// diptych: averaging by centroid: a grain and its contacts go to the cell that holds the grain's centre
// SPDX-License-Identifier: LGPL-2.1-or-later
#include "coupling/averaging/averaging_methods.h"

namespace diptych::coupling
{
  CellSums average_by_centroid(const TargetCells &target, const Carriers &carriers)
  {
    GrainShares shares;
    for (const Eigen::Vector2d &x : carriers.position)
      {
        const TriangleSearch::Place place = target.search.locate(x);
        shares.add(target.cell_of(place.triangle), 1);
        shares.end_row(!place.inside);
      }
    return sums_by_owner(target, carriers, shares);
  }
} // namespace diptych::coupling
