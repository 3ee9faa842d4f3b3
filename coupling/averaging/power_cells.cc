// diptych: power diagram (Laguerre tessellation) of discs
// SPDX-License-Identifier: LGPL-2.1-or-later
#include "coupling/averaging/power_cells.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "coupling/cells/cross_product.h"
#include "coupling/cells/point_bins.h"

namespace diptych::coupling
{
  namespace
  {
    // Keeps the part where normal . x <= bound. `neighbour` lies beyond the new edge. scratch keeps its memory between calls.
    void clip(PowerCell &cell, const Eigen::Vector2d &normal, const double bound, const int neighbour, PowerCell &scratch)
    {
      scratch.corner.clear();
      scratch.beyond.clear();
      cut_polygon(
        cell.corner, [&](const Eigen::Vector2d &x) { return bound - normal.dot(x); },
        [&](const std::size_t k, const double here, const double there) {
          scratch.corner.push_back(cell.corner[k]);
          scratch.beyond.push_back(here == 0 && there < 0 ? neighbour : cell.beyond[k]);
        },
        [&](const std::size_t k, const Eigen::Vector2d &point, const bool leaves) {
          scratch.corner.push_back(point);
          scratch.beyond.push_back(leaves ? neighbour : cell.beyond[k]);
        });
      std::swap(cell, scratch);
      if (cell.corner.size() < 3)
        cell = {};
    }

    struct Discs
    {
      const std::vector<Eigen::Vector2d> &position;
      const std::vector<double>          &radius;
      double                              largest_radius;
      PointBins                           bins;
    };

    // Clips cell i by the axis of disc j. `reach`: largest distance of a corner from the centre of i.
    void clip_by_neighbour(const Discs &discs, const unsigned int i, const unsigned int j, const double reach, PowerCell &cell)
    {
      static thread_local PowerCell scratch;
      const Eigen::Vector2d         between = discs.position[j] - discs.position[i];
      const double                  ri = discs.radius[i], rj = discs.radius[j], squared = between.squaredNorm();
      if (squared == 0)
        {
          if (rj > ri || (rj == ri && j < i))
            cell = {};
          return;
        }
      const double axis = 0.5 * (squared + ri * ri - rj * rj); // times 1/D: distance of the axis
      if (axis < reach * std::sqrt(squared))
        clip(cell, between, between.dot(discs.position[i]) + axis, int(j), scratch);
    }

    PowerCell clipped_cell(const Discs &discs, const unsigned int i, PowerCell cell)
    {
      const Eigen::Vector2d &x        = discs.position[i];
      const auto             reach_of = [&x](const PowerCell &c) {
        double squared = 0;
        for (const Eigen::Vector2d &corner : c.corner)
          squared = std::max(squared, (corner - x).squaredNorm());
        return std::sqrt(squared);
      };
      const double r = discs.radius[i], R = discs.largest_radius;
      double       reach = reach_of(cell);
      for (int ring = 0; !cell.corner.empty(); ++ring)
        {
          // The rings before this one hold all discs closer than ring - 1 bins, so no closer disc can be missed.
          const double seen = (ring - 1) * discs.bins.bin_size();
          if (seen >= reach + std::sqrt(reach * reach + R * R - r * r))
            break;
          const bool any = discs.bins.for_each_in_ring(x, ring, [&](const unsigned int j) {
            if (j != i && !cell.corner.empty())
              clip_by_neighbour(discs, i, j, reach, cell);
          });
          if (!any)
            break;
          reach = reach_of(cell);
        }
      return cell;
    }
  } // namespace

  std::vector<PowerCell> power_cells(const std::vector<Eigen::Vector2d> &position,
                                     const std::vector<double>          &radius,
                                     const std::size_t                   n_cells,
                                     const Eigen::Vector2d              &lower,
                                     const Eigen::Vector2d              &upper)
  {
    if (radius.size() != position.size() || n_cells > position.size())
      throw std::invalid_argument("power cells need one radius per disc");
    std::vector<PowerCell> cells;
    if (n_cells == 0)
      return cells;
    // A bin holds about one disc.
    Eigen::Vector2d low = position.front(), high = low;
    for (const Eigen::Vector2d &x : position)
      {
        low  = low.cwiseMin(x);
        high = high.cwiseMax(x);
      }
    const Eigen::Vector2d extent  = high - low;
    const double          largest = *std::max_element(radius.begin(), radius.end());
    const double          spacing = std::sqrt(std::max(extent.x() * extent.y(), extent.squaredNorm() / position.size()) /
                                              double(position.size()));
    const Discs           discs{position, radius, largest, PointBins(position, spacing > 0 ? spacing : 1)};
    const PowerCell       box{{lower, {upper.x(), lower.y()}, upper, {lower.x(), upper.y()}}, {-1, -1, -1, -1}};
    cells.reserve(n_cells);
    for (unsigned int i = 0; i < n_cells; ++i)
      cells.push_back(clipped_cell(discs, i, box));
    return cells;
  }

  double shared_area(const std::vector<Eigen::Vector2d>   &convex,
                     const std::array<Eigen::Vector2d, 3> &triangle,
                     std::vector<Eigen::Vector2d>         &corners)
  {
    static thread_local std::vector<Eigen::Vector2d> next;
    corners = convex;
    for (unsigned int side = 0; side < 3 && !corners.empty(); ++side)
      {
        clip_to_left(corners, triangle[side], triangle[(side + 1) % 3] - triangle[side], next);
        std::swap(corners, next);
      }
    return polygon_area(corners);
  }
} // namespace diptych::coupling
