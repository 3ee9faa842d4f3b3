// diptych: tests of the circular probe in states of known stress
// SPDX-License-Identifier: LGPL-2.1-or-later
#include "coupling/probes/circular_probe.h"
#include "tests/coupling/averaging/hexagonal_lattice.h"
#include "tests/coupling/synthetic_samples.h"

namespace
{
  using namespace diptych::coupling;
  using synthetic::oblique_stress;

  // Branches of one direction lie end to end on parallel lines, and a diameter crosses each line in one branch. The number of
  // crossings is the diameter's length over their distance, to less than one. The resultant therefore differs from 2 R sigma.n by
  // less than one force of each direction.
  TEST(CircularProbe, LatticeTransmitsItsStressToOneBranchPerDiameter)
  {
    const GrainNetwork  network = synthetic::hexagonal_network(52, 60, oblique_stress());
    const Circle        circle{{26.1, 25.7}, 15};
    const CircularProbe probe  = grain_circular_probe(circle, network, {});
    const auto          forces = synthetic::lattice_forces(oblique_stress());
    const double        bound  = (std::abs(forces[0]) + std::abs(forces[1]) + std::abs(forces[2])) / 30;
    ASSERT_EQ(probe.normal.size(), 36u);
    for (int k = 0; k < 36; ++k)
      {
        EXPECT_DOUBLE_EQ(probe.angles_deg[k], 5. * k);
        const double          angle = 5 * k * M_PI / 180;
        const Eigen::Vector2d s(std::cos(angle), std::sin(angle)), n(-s.y(), s.x());
        EXPECT_LT(std::abs(probe.normal[k] - n.dot(oblique_stress() * n)), bound);
        EXPECT_LT(std::abs(probe.tangential[k] - s.dot(oblique_stress() * n)), bound);
      }
    // The lines in the circle are h = sqrt(3)/2 apart, so their length is a rectangle rule for 2 sqrt(R^2 - y^2). Its ends have
    // an error of at most 0.21 * 2 sqrt(2 R) h^1.5 each (0.21 = -zeta(-1/2)), 0.0053 of the area. Each direction's share of the
    // stress is 2/sqrt(3) f_k.
    EXPECT_LT((probe.stress - oblique_stress()).norm(), 0.0053 * 2 / std::sqrt(3.) * 30 * bound);
    EXPECT_LT(probe.relative_l2.value, 0.05);
  }

  // A lattice under its weight w per disc: the two oblique contacts above row r carry the rows above. Forces are equal on a
  // horizontal line and decrease linearly upward. The mean over a diameter about a point halfway between two rows is therefore
  // the value at this point. Koksma's inequality: the sum over crossings differs from the integral by less than the largest force
  // plus the variation of the forces along the diameter (36 rows of 60 at most).
  TEST(CircularProbe, DiametersOfAnAffineStressCarryTheStressOfTheCentre)
  {
    const double        weight  = 0.05;
    const auto          oblique = [&](const double row) { return (59 - row) * weight / std::sqrt(3.); };
    const auto          network = synthetic::hexagonal_network(52, 60,
                                                               [&](const int k, const int row) { return k == 0 ? 0.5 : oblique(row); });
    const Circle        circle{{26.1, 30.5 * std::sqrt(0.75)}, 15};
    const CircularProbe probe     = grain_circular_probe(circle, network, {});
    const double        at_centre = oblique(30), per_stress = 2 / std::sqrt(3.);
    Eigen::Matrix2d     stress = Eigen::Matrix2d::Zero();
    stress(0, 0)               = per_stress * (0.5 + 0.5 * at_centre);
    stress(1, 1)               = per_stress * 1.5 * at_centre;
    const double highest = oblique(30 - 18), lowest = oblique(30 + 18);
    const double bound = (0.5 + 2 * (highest + highest - lowest)) / 30;
    for (int k = 0; k < 36; ++k)
      {
        const double          angle = 5 * k * M_PI / 180;
        const Eigen::Vector2d s(std::cos(angle), std::sin(angle)), n(-s.y(), s.x());
        EXPECT_LT(std::abs(probe.normal[k] - n.dot(stress * n)), bound);
        EXPECT_LT(std::abs(probe.tangential[k] - s.dot(stress * n)), bound);
      }
    EXPECT_LT(probe.relative_l2.value, 0.05);
  }

  // One contact with the force (0, -2) on the lower grain pushes the upper one up. The side behind n = (0, 1), the lower one,
  // exerts (0, 2) on the upper one. Over the diameter 10 this is 0.2, and nothing across the vertical diameter.
  TEST(CircularProbe, CompressionAcrossTheDiameterIsPositive)
  {
    GrainNetwork network;
    network.position            = {{3, -0.5}, {3, 0.5}};
    network.radius              = {0.5, 0.5};
    network.moment              = {2, Eigen::Matrix2d::Zero()};
    network.forces              = {{0, 1, {3, 0}, {0, -1}, {0, -2}}};
    const CircularProbe upright = grain_circular_probe({{0, 0}, 5}, network, {}, 2);
    EXPECT_DOUBLE_EQ(upright.normal[0], 0.2);
    EXPECT_NEAR(upright.tangential[0], 0, 1e-15);
    EXPECT_EQ(upright.normal[1], 0);
    // The branch is 1 long: sigma_yy = 2 * 1 / (25 pi).
    EXPECT_NEAR(upright.stress(1, 1), 2 / (25 * M_PI), 1e-15);
    // The same contact, with the upper grain as i.
    network.forces = {{1, 0, {3, 0}, {0, 1}, {0, 2}}};
    EXPECT_DOUBLE_EQ(grain_circular_probe({{0, 0}, 5}, network, {}, 2).normal[0], 0.2);
    // The contact lies beyond the end of the diameter.
    EXPECT_EQ(grain_circular_probe({{0, 0}, 2.9}, network, {}, 2).normal[0], 0);
  }

  // Forces scatter independently about those of a uniform stress. The expected square of the difference is that of the standard
  // error, less the diameter's own part of the mean stress: a branch is one of about 30 rows, counted twice, 2/30. Chance leaves
  // sqrt(2/(10 * 100)) = 4 % (about ten independent diameters per sample). 95 % of 100 intervals, +- 2.2, must contain the
  // expected difference.
  TEST(CircularProbe, IndependentForcesDifferByTheirStandardErrors)
  {
    std::mt19937_64            random(5);
    double                     difference = 0, sampling = 0;
    std::vector<CircularProbe> probes;
    for (int sample = 0; sample < 100; ++sample)
      {
        GrainNetwork network = synthetic::hexagonal_network(52, 60, oblique_stress());
        for (auto &contact : network.forces)
          contact.force *= 1 + 0.8 * synthetic::normal(random);
        probes.push_back(grain_circular_probe({{26.1, 25.7}, 15}, network, {5, 200, 3}));
        difference += std::pow(probes.back().relative_l2.value, 2);
        sampling += std::pow(probes.back().independent_blocks, 2);
      }
    EXPECT_NEAR(difference / sampling, 1 - 2. / 30, 0.1);
    const double expected = std::sqrt(difference / 100);
    const auto   covered  = std::count_if(probes.begin(), probes.end(), [&](const CircularProbe &p) {
      return p.relative_l2.low < expected && expected < p.relative_l2.high;
    });
    EXPECT_GE(covered, 88);
  }

  TEST(CircularProbe, UniformCellStressIsPredictedExactly)
  {
    const QuadMesh       mesh = synthetic::box_mesh({0, 0}, {52, 75}, 26, 37, 0.2);
    const TriangleSearch search(mesh);
    Eigen::Matrix2d      stress = oblique_stress();
    stress(0, 1) += 0.1; // a Cosserat stress is not symmetric
    const CircularProbe probe = cell_circular_probe({{25, 30}, 13}, mesh, search, {mesh.cell.size(), stress});
    EXPECT_LT((probe.stress - stress).norm(), 1e-12);
    EXPECT_LT(probe.relative_l2.value, 1e-12);
    // The diameter at 90 degrees has n = (-1, 0) and s = (0, 1). The traction is (-1, -0.3), with the normal part 1 and the
    // tangential part -0.3.
    EXPECT_NEAR(probe.normal[18], 1, 1e-12);
    EXPECT_NEAR(probe.tangential[18], -0.3, 1e-12);
  }

  // sigma_xx = sigma_yy = 1, but 3 beyond x = c from the centre. The share beyond c is (1 - c / (R cos a)) / 2 for the diameter
  // at the angle a, and (acos(c/R) - (c/R) sqrt(1 - c^2/R^2)) / pi for the circle.
  TEST(CircularProbe, CutsAStepOfTheCellStressAtItsPlace)
  {
    const QuadMesh               mesh = synthetic::box_mesh({0, 0}, {40, 40}, 20, 20);
    std::vector<Eigen::Matrix2d> stress;
    for (unsigned int c = 0; c < mesh.cell.size(); ++c)
      stress.push_back((cell_centre(mesh, c).x() > 24 ? 3 : 1) * Eigen::Matrix2d::Identity());
    const CircularProbe probe     = cell_circular_probe({{20, 20}, 10}, mesh, TriangleSearch(mesh), stress, 12);
    const double        of_circle = (std::acos(0.4) - 0.4 * std::sqrt(0.84)) / M_PI;
    double              squares   = 0;
    for (int k = 0; k < 12; ++k)
      {
        const double share = 0.5 * std::max(0., 1 - 0.4 / std::abs(std::cos(15 * k * M_PI / 180)));
        EXPECT_NEAR(probe.normal[k], 1 + 2 * share, 1e-9);
        EXPECT_NEAR(probe.predicted_normal[k], 1 + 2 * of_circle, 1e-9);
        squares += std::pow(2 * share - 2 * of_circle, 2) / 12;
      }
    EXPECT_NEAR(probe.relative_l2.value, std::sqrt(squares) / (1 + 2 * of_circle), 1e-9);
  }

  TEST(CircularProbe, LiesOnTheBandsMiddleAndAwayFromTheOutline)
  {
    const SampleFrame frame = synthetic::frame_52_75();
    Band              band;
    band.angle_deg = 0;
    band.offset    = 4;
    Circle circle  = place_circle(synthetic::box_52_75, frame, {band}, {});
    EXPECT_LT((circle.centre - Eigen::Vector2d(26, 41.5)).norm(), 1e-12);
    EXPECT_NEAR(circle.radius, 26 - 1.5, 1e-12);

    ProbeOptions options;
    options.probe_circle = {10, -5, 40};
    circle               = place_circle(synthetic::box_52_75, frame, {band}, options);
    EXPECT_LT((circle.centre - Eigen::Vector2d(36, 32.5)).norm(), 1e-12);
    EXPECT_NEAR(circle.radius, 16, 1e-12); // reaches the right side
    options.probe_circle = {100, 0, 5};
    EXPECT_EQ(place_circle(synthetic::box_52_75, frame, {band}, options).radius, 0);
    EXPECT_TRUE(grain_circular_probe(place_circle(synthetic::box_52_75, frame, {band}, options), {}, {}).normal.empty());
    options.probe_circle = {1, 2};
    diptych::tests::expect_refused({"probe_circle"}, [&] { place_circle(synthetic::box_52_75, frame, {band}, options); });
  }
} // namespace
