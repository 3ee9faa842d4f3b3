// diptych: tests of tractions on planes parallel to a band, in states of known equilibrium
// SPDX-License-Identifier: LGPL-2.1-or-later
#include "coupling/probes/band_traction.h"

#include <stdexcept>

#include <gtest/gtest.h>

#include "coupling/bands/strips.h"
#include "tests/coupling/averaging/hexagonal_lattice.h"
#include "tests/coupling/synthetic_samples.h"

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
} // namespace
