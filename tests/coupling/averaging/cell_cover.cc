// diptych: tests of the areas of discs in cells
// SPDX-License-Identifier: LGPL-2.1-or-later
#include "coupling/averaging/cell_cover.h"

#include <cmath>
#include <numeric>

#include <gtest/gtest.h>

#include "tests/coupling/synthetic_samples.h"

namespace
{
  using namespace diptych::coupling;

  const std::vector<Eigen::Vector2d> square = {{0, 0}, {1, 0}, {1, 1}, {0, 1}};

  TEST(CellCover, DiscAreasInASquareOfKnownAnswer)
  {
    EXPECT_NEAR(disc_polygon_area({0.5, 0.5}, 0.3, square), M_PI * 0.09, 1e-14);     // inside
    EXPECT_NEAR(disc_polygon_area({0.5, 0}, 0.3, square), 0.5 * M_PI * 0.09, 1e-14); // half
    EXPECT_NEAR(disc_polygon_area({1, 1}, 0.3, square), 0.25 * M_PI * 0.09, 1e-14);  // quarter
    EXPECT_NEAR(disc_polygon_area({0.5, 0.5}, 2, square), 1, 1e-14);                 // the square lies inside the disc
    EXPECT_NEAR(disc_polygon_area({2, 2}, 0.5, square), 0, 1e-14);                   // apart
    // A segment of height h = 0.1 of a disc of radius 0.3: r^2 acos(1 - h/r) - (r - h) sqrt(2 r h - h^2).
    const double segment = 0.09 * std::acos(1 - 0.1 / 0.3) - 0.2 * std::sqrt(2 * 0.3 * 0.1 - 0.01);
    EXPECT_NEAR(disc_polygon_area({0.5, -0.2}, 0.3, square), segment, 1e-14);
  }

  TEST(CellCover, DiscAreasAndCountsAddUpOverCells)
  {
    const auto network = synthetic::random_network({0, 0}, {20, 30}, 500, 3);
    const auto above   = [](const Eigen::Vector2d &x) { return x.y() > 0.8 * x.x(); };
    const auto bent    = [](const Eigen::Vector2d &x) { return Eigen::Vector2d(0.2 * std::sin(x.y()), 0); };
    for (const QuadMesh &mesh : {synthetic::box_mesh({-1, -1}, {21, 31}, 14, 19, 0.3),
                                 synthetic::refined_mesh({-1, -1}, {21, 31}, {{9, 14}}, above, bent)})
      {
        const CellCover cover    = cell_cover(mesh, TriangleSearch(mesh), network.position, network.radius);
        const auto      areas    = cell_areas(mesh);
        double          in_cells = 0, of_discs = 0;
        for (std::size_t c = 0; c < areas.size(); ++c)
          in_cells += cover.solid_fraction[c] * areas[c];
        for (const double r : network.radius)
          of_discs += M_PI * r * r;
        EXPECT_NEAR(in_cells, of_discs, 1e-11 * of_discs);
        EXPECT_EQ(std::accumulate(cover.grain_count.begin(), cover.grain_count.end(), 0), 500);
      }
  }

  // A square lattice of touching discs (solid fraction pi/4) covers only the mesh's left part. Cells that it fills to a quarter
  // of their width have no value; cells that it fills to three quarters do.
  TEST(CellCover, CellFilledToLessThanHalfIsNotCovered)
  {
    const QuadMesh               mesh = synthetic::box_mesh({0, 0}, {16, 16}, 4, 4);
    std::vector<Eigen::Vector2d> position;
    const auto                   fill = [&position](const int columns) {
      position.clear();
      for (int c = 0; c < columns; ++c)
        for (int r = 0; r < 16; ++r)
          position.push_back({c + 0.5, r + 0.5});
      return std::vector<double>(position.size(), 0.5);
    };
    const auto      quarter_radius = fill(9);
    const CellCover quarter        = cell_cover(mesh, TriangleSearch(mesh), position, quarter_radius);
    EXPECT_NEAR(quarter.typical_solid_fraction, M_PI / 4, 1e-12);
    EXPECT_TRUE(quarter.covered[0] && quarter.covered[1]);
    EXPECT_FALSE(quarter.covered[2] || quarter.covered[3]);

    const auto three_quarter_radius = fill(11);
    EXPECT_TRUE(cell_cover(mesh, TriangleSearch(mesh), position, three_quarter_radius).covered[2]);
  }
} // namespace
