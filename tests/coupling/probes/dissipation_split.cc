// diptych: tests of the dissipation inside and outside a band
// SPDX-License-Identifier: LGPL-2.1-or-later
#include "coupling/probes/dissipation_split.h"

#include <numeric>
#include <stdexcept>

#include <gtest/gtest.h>

#include "tests/coupling/synthetic_samples.h"

namespace
{
  using namespace diptych::coupling;

  // In a square of side a, the strip |x - y| / sqrt 2 <= h about the diagonal leaves two triangles of side a - sqrt(2) h.
  TEST(DissipationSplit, UniformDissipationFollowsTheArea)
  {
    const BandZone zone{{20, 20}, 45, 4};
    const double   share = 1 - std::pow(1 - std::sqrt(2.) * 4 / 40, 2);
    const QuadMesh mesh  = synthetic::box_mesh({0, 0}, {40, 40}, 11, 9, 0.2);
    const auto     cells = cell_dissipation_split(zone, mesh, std::vector<double>(mesh.cell.size(), 0.25));
    EXPECT_NEAR(cells.area_share, share, 1e-12);
    EXPECT_NEAR(cells.share_inside, share, 1e-12);
    EXPECT_NEAR(cells.inside + cells.outside, 0.25 * 1600, 1e-9);

    std::vector<Eigen::Vector2d> points;
    for (int k = 0; k < 160000; ++k)
      points.emplace_back((k % 400 + 0.5) / 10, (k / 400 + 0.5) / 10);
    const auto contacts = contact_dissipation_split(zone, {{0, 0}, {40, 0}, {40, 40}, {0, 40}}, points,
                                                    std::vector<double>(points.size(), 0.25 / 100));
    EXPECT_NEAR(contacts.area_share, share, 1e-12);
    // For points of a grid the error is half their spacing along the strip's two edges, 2 * 40 sqrt 2 * 0.05 of 1600.
    EXPECT_NEAR(contacts.share_inside, share, 2 * 40 * std::sqrt(2.) * 0.05 / 1600);
    EXPECT_NEAR(contacts.inside + contacts.outside, 0.25 * 1600, 1e-9);
  }

  // The strip 18 <= y <= 24 covers one row of cells (20 .. 24) and half of the row below (16 .. 20), which dissipates 3 per area.
  TEST(DissipationSplit, CellsAreCutByTheStrip)
  {
    const QuadMesh      mesh = synthetic::box_mesh({0, 0}, {40, 40}, 10, 10);
    std::vector<double> dissipation(100, 0.);
    for (int k = 0; k < 20; ++k)
      dissipation[40 + k] = 3;
    const auto split = cell_dissipation_split({{20, 21}, 0, 3}, mesh, dissipation);
    EXPECT_NEAR(split.inside, 3 * 40 * 6, 1e-9);
    EXPECT_NEAR(split.outside, 3 * 40 * 2, 1e-9);
    EXPECT_NEAR(split.share_inside, 0.75, 1e-12);
    EXPECT_NEAR(split.area_share, 6. / 40, 1e-12);
  }

  TEST(DissipationSplit, IgnoresCellsWithoutAValue)
  {
    const QuadMesh mesh  = synthetic::box_mesh({0, 0}, {4, 4}, 1, 2);
    const auto     split = cell_dissipation_split({{2, 1}, 0, 1}, mesh, {1, NAN});
    EXPECT_NEAR(split.area_share, 1, 1e-12);
    EXPECT_NEAR(split.share_inside, 1, 1e-12);
    EXPECT_TRUE(std::isnan(cell_dissipation_split({{2, 1}, 0, 1}, mesh, {0, 0}).share_inside));
    EXPECT_THROW(cell_dissipation_split({{2, 1}, 0, 1}, mesh, {1}), std::invalid_argument);
    EXPECT_THROW(contact_dissipation_split({{2, 1}, 0, 1}, {{0, 0}, {1, 0}, {0, 1}}, {{0, 0}}, {}), std::invalid_argument);
  }
} // namespace
