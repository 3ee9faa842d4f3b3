// diptych: pairs of bodies that may touch within a step
// SPDX-License-Identifier: LGPL-2.1-or-later
#include "discrete/contact_detection.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace diptych::discrete
{
  namespace
  {
    // Grains sorted into square cells; cell (a, b) holds grains[start[b * columns + a]] up to the next start.
    struct CellGrid
    {
      Eigen::Vector2d  origin;
      double           cell_size = 1;
      int              columns = 1, rows = 1;
      std::vector<int> start, grains;

      int column(const double x) const { return std::clamp(int((x - origin.x()) / cell_size), 0, columns - 1); }
      int row(const double y) const { return std::clamp(int((y - origin.y()) / cell_size), 0, rows - 1); }
    };

    CellGrid sort_into_cells(const Grains &grains, const double cell_size)
    {
      CellGrid        grid;
      Eigen::Vector2d low = Eigen::Vector2d::Constant(std::numeric_limits<double>::infinity()), high = -low;
      for (const Eigen::Vector2d &x : grains.position)
        low = low.cwiseMin(x), high = high.cwiseMax(x);
      grid.origin    = low;
      grid.cell_size = cell_size;
      // A grain that has flown far away must not blow the grid up: cells grow instead.
      const double most_cells = 16. * grains.size() + 64.;
      while ((high.x() - low.x()) / grid.cell_size * ((high.y() - low.y()) / grid.cell_size) > most_cells)
        grid.cell_size *= 2;
      grid.columns = int((high.x() - low.x()) / grid.cell_size) + 1;
      grid.rows    = int((high.y() - low.y()) / grid.cell_size) + 1;

      std::vector<int> cell(grains.size());
      grid.start.assign(std::size_t(grid.columns) * grid.rows + 1, 0);
      for (std::size_t i = 0; i < grains.size(); ++i)
        {
          cell[i] = grid.row(grains.position[i].y()) * grid.columns + grid.column(grains.position[i].x());
          ++grid.start[cell[i] + 1];
        }
      for (std::size_t c = 1; c < grid.start.size(); ++c)
        grid.start[c] += grid.start[c - 1];
      grid.grains.resize(grains.size());
      std::vector<int> next(grid.start.begin(), grid.start.end() - 1);
      for (std::size_t i = 0; i < grains.size(); ++i)
        grid.grains[next[cell[i]]++] = int(i);
      return grid;
    }

    // A pair is found from its member with the larger margin, whose search circle therefore needs to know only its own.
    void pairs_of_grain(const int                  i,
                        const State               &state,
                        const std::vector<double> &margin,
                        const CellGrid            &grid,
                        const double               largest_radius,
                        std::vector<Contact>      &contacts)
    {
      const Grains         &g     = state.grains;
      const Eigen::Vector2d x     = g.position[i];
      const double          reach = g.radius[i] + largest_radius + 2 * margin[i];
      for (int b = grid.row(x.y() - reach); b <= grid.row(x.y() + reach); ++b)
        {
          const int first = grid.start[b * grid.columns + grid.column(x.x() - reach)];
          const int last  = grid.start[b * grid.columns + grid.column(x.x() + reach) + 1];
          for (int k = first; k < last; ++k)
            {
              const int j = grid.grains[k];
              if (margin[j] > margin[i] || (margin[j] == margin[i] && j <= i))
                continue;
              const double alert = g.radius[i] + g.radius[j] + margin[i] + margin[j];
              if ((x - g.position[j]).squaredNorm() < alert * alert)
                contacts.push_back(make_contact(state, std::min(i, j), std::max(i, j)));
            }
        }
    }
  } // namespace

  Contact make_contact(const State &state, const int i, const int j)
  {
    const Grains &g = state.grains;
    const int     n = int(g.size());
    if (j >= n)
      {
        const Wall  &wall = state.walls[j - n];
        const double gap  = (g.position[i] - wall.point).dot(wall.normal) - g.radius[i];
        return {i, j, gap, wall.normal, g.position[i] - (g.radius[i] + 0.5 * gap) * wall.normal};
      }
    const Eigen::Vector2d branch   = g.position[i] - g.position[j];
    const double          distance = branch.norm();
    // Coinciding centres have no normal; any fixed direction separates them.
    const Eigen::Vector2d normal = distance > 0 ? Eigen::Vector2d(branch / distance) : Eigen::Vector2d::UnitX();
    const double          gap    = distance - g.radius[i] - g.radius[j];
    return {i, j, gap, normal, g.position[i] - (g.radius[i] + 0.5 * gap) * normal};
  }

  std::vector<Contact> find_contacts(const State &state, const std::vector<double> &margin)
  {
    const Grains        &g = state.grains;
    std::vector<Contact> contacts;
    if (g.size() == 0)
      return contacts;
    contacts.reserve(4 * g.size());

    const double   largest_radius = *std::max_element(g.radius.begin(), g.radius.end());
    const CellGrid grid           = sort_into_cells(g, 2 * largest_radius);
    for (std::size_t i = 0; i < g.size(); ++i)
      {
        pairs_of_grain(int(i), state, margin, grid, largest_radius, contacts);
        for (std::size_t w = 0; w < state.walls.size(); ++w)
          {
            const Contact contact = make_contact(state, int(i), int(g.size() + w));
            if (contact.gap < margin[i])
              contacts.push_back(contact);
          }
      }
    std::sort(contacts.begin(), contacts.end(),
              [](const Contact &a, const Contact &b) { return a.i != b.i ? a.i < b.i : a.j < b.j; });
    return contacts;
  }
} // namespace diptych::discrete
