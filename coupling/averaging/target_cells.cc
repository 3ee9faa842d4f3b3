// diptych: the cells that receive grain quantities, with their periodic images
// SPDX-License-Identifier: LGPL-2.1-or-later
#include "coupling/averaging/target_cells.h"

namespace diptych::coupling
{
  TargetCells::TargetCells(const QuadMesh &cells, const Period &period)
      : mesh(cells),
        period(period),
        images(tiled(cells, period)),
        search(images),
        area(cell_areas(cells))
  {
    lower = upper = mesh.node[mesh.cell.front()[0]];
    for (const CellTriangle &triangle : mesh.triangle)
      for (const unsigned int node : triangle.node)
        {
          lower = lower.cwiseMin(mesh.node[node]);
          upper = upper.cwiseMax(mesh.node[node]);
        }
  }
} // namespace diptych::coupling
