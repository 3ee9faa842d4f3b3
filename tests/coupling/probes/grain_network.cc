// diptych: tests of branches of contacts in periodic samples, and of polygons
// SPDX-License-Identifier: LGPL-2.1-or-later
#include "coupling/probes/grain_network.h"

#include <stdexcept>

#include <gtest/gtest.h>

#include "coupling/cells/polygon.h"

namespace
{
  using namespace diptych::coupling;
  using diptych::discrete::Snapshot;

  // Two grains have drifted one and two periods of 10 to the right. The contact joins 0 and the image of 1 one period to the
  // left. In the cell 0 .. 10 they lie at 9.5 and 0.5, and the image that touches 0 is at 10.5.
  TEST(GrainNetwork, WrapsGrainsOfAPeriodicSampleWithTheirContacts)
  {
    Snapshot s;
    s.position                 = {{19.5, 1}, {30.5, 1}};
    s.radius                   = {0.5, 0.5};
    s.mean_internal_moment     = {2, Eigen::Matrix2d::Zero()};
    s.cell_width               = 10;
    s.outline.left             = {{0, 0}, {0, 5}};
    s.outline.right            = {{10, 0}, {10, 5}};
    s.window_forces            = {{0, 1, {20, 1}, {-1, 0}, {-2, 0}, -10}, {1, 3, {30.5, 0.5}, {0, 1}, {0, 1}}};
    const GrainNetwork network = grain_network(s);
    EXPECT_NEAR(network.position[0].x(), 9.5, 1e-12);
    EXPECT_NEAR(network.position[1].x(), 0.5, 1e-12);
    EXPECT_NEAR(network.forces[0].point.x(), 10, 1e-12);
    EXPECT_NEAR(network.forces[0].shift, 10, 1e-12);
    EXPECT_NEAR(network.forces[1].point.x(), 0.5, 1e-12);

    const auto all = branches(network.position, network.forces, network.period);
    ASSERT_EQ(all.size(), 6u);
    EXPECT_NEAR(all[0].to.x(), 10.5, 1e-12);
    EXPECT_NEAR(all[1].from.x(), -0.5, 1e-12); // the left image extends into the cell
    EXPECT_NEAR(all[1].to.x(), 0.5, 1e-12);
    EXPECT_NEAR(all[3].to.y(), 0.5, 1e-12); // platen: ends at the contact point
  }

  TEST(GrainNetwork, BranchesLeaveOutContactsWithoutForce)
  {
    const std::vector<Eigen::Vector2d> position = {{0, 0}, {1, 0}};
    EXPECT_TRUE(branches(position, {{0, 1, {0.5, 0}, {-1, 0}, {0, 0}}}).empty());
    EXPECT_THROW(branches(position, {{2, 0, {0.5, 0}, {-1, 0}, {1, 0}}}), std::invalid_argument);
  }

  // An L of area 3 cut at x = 1.5 loses 0.5. Cut at y >= 0.5, its two arms are joined by edges without area only.
  TEST(Polygon, PartsWithinAConvexOneHaveTheExactArea)
  {
    const std::vector<Eigen::Vector2d> corner = {{0, 0}, {2, 0}, {2, 1}, {1, 1}, {1, 2}, {0, 2}};
    EXPECT_NEAR(polygon_area(corner), 3, 1e-15);
    EXPECT_NEAR(polygon_area(clipped(corner, {{-1, -1}, {1.5, -1}, {1.5, 3}, {-1, 3}})), 2.5, 1e-15);
    const std::vector<Eigen::Vector2d> comb = {{0, 0}, {3, 0}, {3, 1}, {2, 1}, {2, 0.2}, {1, 0.2}, {1, 1}, {0, 1}};
    EXPECT_NEAR(polygon_area(clipped(comb, {{-1, 0.5}, {4, 0.5}, {4, 2}, {-1, 2}})), 1, 1e-15);
    EXPECT_TRUE(clipped(corner, {{5, 5}, {6, 5}, {6, 6}, {5, 6}}).empty());
  }

  TEST(Polygon, LinesAndDistances)
  {
    const std::vector<Eigen::Vector2d> square = {{0, 0}, {2, 0}, {2, 2}, {0, 2}};
    const auto                         span   = line_span(square, {1, 1}, {std::sqrt(0.5), std::sqrt(0.5)});
    ASSERT_TRUE(span);
    EXPECT_NEAR((*span)[0], -std::sqrt(2.), 1e-14);
    EXPECT_NEAR((*span)[1], std::sqrt(2.), 1e-14);
    EXPECT_FALSE(line_span(square, {0, 3}, {1, 0}));
    EXPECT_NEAR(distance_to_edges({0.5, 1}, square), 0.5, 1e-15);
    EXPECT_NEAR(distance_to_edges({3, 3}, square), std::sqrt(2.), 1e-15);
  }
} // namespace
