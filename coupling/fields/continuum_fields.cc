// diptych: the continuum's fields between two stages
// SPDX-License-Identifier: LGPL-2.1-or-later
#include "coupling/fields/continuum_fields.h"

#include <cmath>

#include "coupling/cells/polygon.h"
#include "coupling/fields/node_transfer.h"

namespace diptych::coupling
{
  ContinuumFields continuum_fields(const continuum::Snapshot &from, const continuum::Snapshot &to)
  {
    const std::vector<unsigned int>    earlier_cell     = cells_of(from, to);
    const std::vector<Eigen::Vector2d> earlier          = displacement_at_nodes_of(from, to);
    const bool                         turns            = !from.rotation.empty() && !to.rotation.empty();
    const std::vector<double>          earlier_rotation = turns ? rotation_at_nodes_of(from, to) : std::vector<double>();

    ContinuumFields fields;
    for (std::size_t k = 0; k < to.cells.size(); ++k)
      {
        const continuum::CellState &before = from.cell_state[earlier_cell[k]], &after = to.cell_state[k];
        fields.stress.push_back(0.5 * (before.stress + after.stress).topLeftCorner<2, 2>());
        fields.couple_stress.push_back(-after.couple_stress); // the snapshot has the sign convention of mechanics
        fields.dissipation.push_back(after.dissipation - before.dissipation);

        std::vector<Eigen::Vector2d> now, initial;
        Eigen::Vector2d              increment = Eigen::Vector2d::Zero();
        double                       turn      = turns ? 0 : NAN;
        for (unsigned int corner = 0; corner < 4; ++corner)
          {
            const unsigned int node = to.cells[k][corner];
            increment += 0.25 * (to.displacement[node] - earlier[node]);
            now.push_back(to.position[node]);
            initial.emplace_back(to.position[node] - to.displacement[node]);
            if (turns)
              turn += 0.25 * (to.rotation[node] - earlier_rotation[node]);
          }
        fields.displacement_increment.push_back(increment);
        fields.rotation_increment.push_back(turn);
        fields.volume_ratio.push_back(polygon_area(initial) / polygon_area(now));
      }
    return fields;
  }
} // namespace diptych::coupling
