// diptych: averaging by power cells: a grain and its contacts go to each cell by the share of the grain's power cell in it
// SPDX-License-Identifier: LGPL-2.1-or-later
#include "coupling/averaging/averaging_methods.h"
#include "coupling/averaging/power_cells.h"

namespace diptych::coupling
{
  namespace
  {
    // The power cells of the grains. In a periodic sample their images surround them.
    std::vector<PowerCell> cells_of_grains(const TargetCells &target, const Carriers &carriers)
    {
      std::vector<Eigen::Vector2d> position = carriers.position;
      std::vector<double>          radius   = carriers.radius;
      Eigen::Vector2d              lower = target.lower, upper = target.upper;
      for (const Eigen::Vector2d &shift : target.period.neighbours())
        for (std::size_t i = 0; i < carriers.position.size(); ++i)
          {
            position.push_back(carriers.position[i] + shift);
            radius.push_back(carriers.radius[i]);
          }
      const Eigen::Vector2d extent = target.period.vectors.cwiseAbs().rowwise().sum();
      lower -= extent;
      upper += extent;
      return power_cells(position, radius, carriers.position.size(), lower, upper);
    }

    bool add_shares(const TargetCells &target, const PowerCell &cell, GrainShares &shares)
    {
      static thread_local std::vector<unsigned int>    triangles;
      static thread_local std::vector<Eigen::Vector2d> scratch;
      if (cell.corner.empty())
        return false;
      Eigen::Vector2d lower = cell.corner[0], upper = lower;
      for (const Eigen::Vector2d &x : cell.corner)
        {
          lower = lower.cwiseMin(x);
          upper = upper.cwiseMax(x);
        }
      target.search.triangles_in_box(lower, upper, triangles);

      const std::size_t first = shares.cell.size();
      double            sum   = 0;
      for (const unsigned int t : triangles)
        {
          const double area = shared_area(cell.corner, target.search.corners(t), scratch);
          if (area > 0)
            {
              shares.add(target.cell_of(t), area);
              sum += area;
            }
        }
      if (!(sum > 0))
        return false;
      for (std::size_t k = first; k < shares.share.size(); ++k)
        shares.share[k] /= sum;
      return true;
    }
  } // namespace

  CellSums average_by_laguerre(const TargetCells &target, const Carriers &carriers)
  {
    const std::vector<PowerCell> cells = cells_of_grains(target, carriers);
    GrainShares                  shares;
    for (std::size_t i = 0; i < cells.size(); ++i)
      {
        bool outside = false;
        if (!add_shares(target, cells[i], shares)) // outside the mesh, or hidden among larger grains
          {
            const TriangleSearch::Place place = target.search.locate(carriers.position[i]);
            shares.add(target.cell_of(place.triangle), 1);
            outside = !place.inside;
          }
        shares.end_row(outside);
      }
    return sums_by_owner(target, carriers, shares);
  }
} // namespace diptych::coupling
