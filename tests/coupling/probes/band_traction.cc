// diptych: tests of what is found along a band: traction and dissipation; of branches of contacts and polygons
// SPDX-License-Identifier: LGPL-2.1-or-later
#include "coupling/probes/band_traction.h"
#include "coupling/bands/strips.h"
#include "coupling/probes/dissipation_split.h"
#include "coupling/probes/grain_network.h"
#include "coupling/cells/polygon.h"
#include "tests/coupling/averaging/hexagonal_lattice.h"
#include "tests/coupling/synthetic_samples.h"
#include "tests/common.h"

namespace
{
  using namespace diptych::coupling;
  using synthetic::oblique_stress;

  // Six strips about the middle, 7 rows high and 40 long.
  TractionStrips strips_of_whole_rows()
  {
    TractionStrips strips;
    strips.origin = {26, 37.5};
    for (int k = -3; k <= 3; ++k)
      strips.edges.push_back(7 * k * std::sqrt(0.75) + 0.1);
    strips.from.assign(6, -20);
    strips.to.assign(6, 20);
    return strips;
  }

  // The number of branches of one direction that a line of length L crosses is L times their density, to less than one, because
  // they lie end to end on parallel lines. The same is true for the mean over the lines of a strip. The traction therefore
  // differs from sigma.n by less than sum |f_k| / L.
  TEST(BandTraction, LatticeHasUniformTractionToOneBranchPerLine)
  {
    const GrainNetwork    network = synthetic::hexagonal_network(53, 88, oblique_stress());
    const SampleFrame     frame   = synthetic::frame_52_75();
    const double          angle   = -40;
    const TractionStrips  strips  = traction_strips(synthetic::box_52_75, frame, angle, strip_edges(frame, angle, 2));
    const BandTraction    result  = grain_band_traction(strips, network, 5);
    const auto            forces  = synthetic::lattice_forces(oblique_stress());
    const Eigen::Vector2d s(std::cos(angle * M_PI / 180), std::sin(angle * M_PI / 180)), n(-s.y(), s.x());
    int                   carrying = 0;
    ASSERT_EQ(result.normal.size(), 16u);
    for (int k = 0; k < 16; ++k)
      if (std::isfinite(result.normal[k]))
        {
          ++carrying;
          const double bound = (std::abs(forces[0]) + std::abs(forces[1]) + std::abs(forces[2])) /
                               (strips.to[k] - strips.from[k]);
          EXPECT_LT(std::abs(result.normal[k] - n.dot(oblique_stress() * n)), bound);
          EXPECT_LT(std::abs(result.shear[k] - s.dot(oblique_stress() * n)), bound);
        }
    EXPECT_GE(carrying, 10);
    EXPECT_LT(result.variation_normal, 0.05);
  }

  // Equilibrium does not determine the stress along a band. Rows of a lattice may carry any force along x, different in each row.
  // Planes y = const still transmit only the forces of the oblique contacts, the same in every strip: two contacts per disc, each
  // f sin 60, per diameter. The strips hold whole rows and whole columns: 7 rows are 7 sqrt(3)/2 high.
  TEST(BandTraction, DoesNotDependOnTheStressAlongTheBand)
  {
    std::mt19937_64 random(2);
    const auto      network = synthetic::hexagonal_network(
           53, 88, [&](const int k, int) { return k == 0 ? synthetic::uniform(random, 0.2, 3) : 0.7; });
    const BandTraction result = grain_band_traction(strips_of_whole_rows(), network, 5);
    for (int k = 0; k < 6; ++k)
      {
        EXPECT_NEAR(result.normal[k], 2 * 0.7 * std::sqrt(0.75), 1e-12);
        EXPECT_NEAR(result.shear[k], 0, 1e-12);
        EXPECT_LT(result.normal_error[k], 1e-12);
      }
    EXPECT_LT(result.variation_normal, 1e-12);
  }

  TEST(BandTraction, CellStressThatJumpsAlongTheBandOnlyIsInEquilibrium)
  {
    const SampleFrame            frame = synthetic::frame_52_75();
    const QuadMesh               mesh  = synthetic::box_mesh({0, 0}, {52, 75}, 26, 37, 0.2);
    const double                 angle = -46 * M_PI / 180;
    const Eigen::Vector2d        s(std::cos(angle), std::sin(angle)), n(-s.y(), s.x());
    std::mt19937_64              random(3);
    std::vector<Eigen::Matrix2d> stress;
    for (unsigned int c = 0; c < mesh.cell.size(); ++c)
      stress.push_back(synthetic::uniform(random, 0.5, 2) * s * s.transpose() + 1.5 * n * n.transpose() -
                       0.4 * (s * n.transpose() + n * s.transpose()));
    const TractionStrips strips = traction_strips(synthetic::box_52_75, frame, -46, strip_edges(frame, -46, 2));
    const BandTraction   result = cell_band_traction(strips, mesh, TriangleSearch(mesh), stress);
    for (int k = 4; k < 12; ++k)
      {
        EXPECT_NEAR(result.normal[k], 1.5, 1e-12);
        EXPECT_NEAR(result.shear[k], -0.4, 1e-12);
      }
    EXPECT_LT(result.variation_normal, 1e-12);
    EXPECT_LT(result.variation_shear, 1e-12);
  }

  // The normal traction is 1 in three strips and 2 in three: mean 1.5, deviation sqrt(6 * 0.25 / 5). The strip edge is a cell
  // edge.
  TEST(BandTraction, VariationOfAStepOutOfEquilibrium)
  {
    const QuadMesh               mesh = synthetic::box_mesh({0, 0}, {40, 60}, 10, 30);
    std::vector<Eigen::Matrix2d> stress;
    for (unsigned int c = 0; c < mesh.cell.size(); ++c)
      stress.push_back((cell_centre(mesh, c).y() > 30 ? 2 : 1) * Eigen::Matrix2d::Identity());
    SampleFrame frame;
    frame.centre      = {20, 30};
    frame.width       = 40;
    frame.height      = 60;
    const auto strips = traction_strips({{0, 0}, {40, 0}, {40, 60}, {0, 60}}, frame, 0, {-15, -10, -5, 0, 5, 10, 15});
    EXPECT_NEAR(strips.to[0] - strips.from[0], 0.7 * (40 - 2 * 2), 1e-12); // two diameters away from either side
    const auto result = cell_band_traction(strips, mesh, TriangleSearch(mesh), stress);
    EXPECT_NEAR(result.variation_normal, std::sqrt(0.3) / 1.5, 1e-12);
    EXPECT_NEAR(result.variation_shear, 0, 1e-12);
  }

  // Traction errors of independent forces: each of the eight blocks of a strip is an independent mean. The mean over all strips
  // of (traction - true)^2 is compared with that of the squared errors. Chance leaves sqrt(2 / (30 * 6)) = 0.1; twice that is
  // allowed.
  TEST(BandTraction, ErrorsAreThoseOfIndependentBlocks)
  {
    std::mt19937_64 random(11);
    double          squares = 0, errors = 0;
    for (int sample = 0; sample < 30; ++sample)
      {
        auto network = synthetic::hexagonal_network(53, 88, oblique_stress());
        for (auto &contact : network.forces)
          contact.force *= 1 + 0.8 * synthetic::normal(random);
        const BandTraction result = grain_band_traction(strips_of_whole_rows(), network, 5);
        for (int k = 0; k < 6; ++k)
          {
            squares += std::pow(result.normal[k] - 2, 2);
            errors += std::pow(result.normal_error[k], 2);
          }
      }
    EXPECT_NEAR(squares / errors, 1, 0.2);
  }

  TEST(BandTraction, StripsOutsideTheSampleOrTooShortHaveNoValue)
  {
    const SampleFrame    frame  = synthetic::frame_52_75();
    const TractionStrips strips = traction_strips(synthetic::box_52_75, frame, 45, {-60, -50, -40, 0, 10});
    EXPECT_TRUE(std::isnan(strips.from[0])); // the sample ends at 44.9
    EXPECT_TRUE(std::isnan(strips.from[1]));
    EXPECT_FALSE(std::isnan(strips.from[3]));
    const BandTraction result = grain_band_traction(strips, synthetic::hexagonal_network(53, 88, oblique_stress()), 5);
    EXPECT_TRUE(std::isnan(result.normal[0]));
    EXPECT_GT(result.normal[3], 0);
    EXPECT_THROW(traction_strips(synthetic::box_52_75, frame, 45, {1, 0}), std::invalid_argument);
  }

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
