// diptych: position sweeps in rounds have the bits of sweeps pair by pair
// SPDX-License-Identifier: LGPL-2.1-or-later
#include <gtest/gtest.h>

#include "discrete/stepping/position_projection.h"
#include "tests/discrete/small_scenes.h"

namespace
{
  using namespace diptych::tests;

  // One pair in the order of the list: the slow clear version. Returns the penetration found.
  double part(State &state, const Contact &pair)
  {
    Grains               &g     = state.grains;
    const Contact         c     = make_contact(state, pair.i, pair.j);
    const bool            grain = std::size_t(c.j) < g.size();
    const Eigen::Vector2d wall  = grain ? Eigen::Vector2d::Zero() : state.walls[c.j - g.size()].inverse_mass();
    const double          wi = g.inverse_mass(c.i), wj = grain ? g.inverse_mass(c.j) : wall.dot(c.normal.cwiseProduct(c.normal));
    const double          across = c.image * c.normal.x(), wc = c.image != 0 ? state.cell->inverse_mass() : 0.;
    const double          sum = wi + wj + wc * across * across;
    if (c.gap >= 0 || sum == 0)
      return 0;
    g.position[c.i] -= c.gap * wi / sum * c.normal;
    if (grain)
      g.position[c.j] += c.gap * wj / sum * c.normal;
    else
      state.walls[c.j - g.size()].point += c.gap / sum * wall.cwiseProduct(c.normal);
    if (wc > 0)
      state.cell->width += c.gap / sum * wc * across;
    return -c.gap;
  }

  void expect_same_positions(const State &a, const State &b)
  {
    for (std::size_t i = 0; i < a.grains.size(); ++i)
      EXPECT_EQ(a.grains.position[i], b.grains.position[i]) << "grain " << i;
    for (std::size_t w = 0; w < a.walls.size(); ++w)
      EXPECT_EQ(a.walls[w].point, b.walls[w].point) << "wall " << w;
    ASSERT_EQ(a.cell.has_value(), b.cell.has_value());
    EXPECT_EQ(a.cell ? a.cell->width : 0., b.cell ? b.cell->width : 0.);
  }

  // Grains grown by 2 %, so that nearly all pairs overlap; far more than any step leaves.
  void expect_rounds_to_have_the_bits_of_single_pairs(State state)
  {
    for (double &radius : state.grains.radius)
      radius *= 1.02;
    const std::vector<Contact> contacts = find_contacts(state, std::vector<double>(state.grains.size(), 0.02));
    State                      plain    = state;
    double                     found    = 0;
    for (int sweep = 0; sweep < 10; ++sweep)
      {
        found = 0;
        for (const Contact &c : contacts)
          found = std::max(found, part(plain, c));
      }
    EXPECT_GT(found, 1e-3) << "ten sweeps are not enough here, so that all were done";
    project_positions(state, contacts, 1e-3);
    expect_same_positions(state, plain);
  }

  TEST(PositionProjection, RoundsHaveTheBitsOfSinglePairsBetweenStandingPlatens)
  {
    State state           = sheared_sample().state;
    state.grains.fixed[7] = state.grains.fixed[8] = 1;
    expect_rounds_to_have_the_bits_of_single_pairs(state);
  }

  TEST(PositionProjection, RoundsHaveTheBitsOfSinglePairsWhereAPlatenGivesWay)
  {
    State state            = sheared_sample().state;
    state.walls[1].drive_y = AppliedForce{{{0.}, {-10.}}};
    state.walls[1].mass    = 5;
    expect_rounds_to_have_the_bits_of_single_pairs(state);
  }

  TEST(PositionProjection, RoundsHaveTheBitsOfSinglePairsAcrossTheEdgeOfAFreeCell)
  {
    State  state = sheared_sample().state;
    double left = 0, right = 0;
    for (const Eigen::Vector2d &x : state.grains.position)
      left = std::min(left, x.x()), right = std::max(right, x.x());
    state.cell = PeriodicCell{right - left + 0.7, 0, 1., 5.};
    expect_rounds_to_have_the_bits_of_single_pairs(state);
  }
} // namespace
