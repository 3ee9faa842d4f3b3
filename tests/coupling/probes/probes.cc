// diptych: tests of probes in states of known stress and fabric
// SPDX-License-Identifier: LGPL-2.1-or-later
#include "coupling/probes/probes.h"
#include "tests/coupling/averaging/hexagonal_lattice.h"
#include "tests/coupling/synthetic_samples.h"

namespace
{
  using namespace diptych::coupling;

  Band oblique_band()
  {
    Band band;
    band.angle_deg   = -46;
    band.half_width  = 4;
    band.width_10_90 = 8.8;
    band.offset      = 2;
    return band;
  }

  TEST(Probes, LieInsideTheOutlineOnTheirSideOfTheBand)
  {
    const SampleFrame frame  = synthetic::frame_52_75();
    const Band        band   = oblique_band();
    const auto        probes = place_probes(synthetic::box_52_75, frame, {band});
    ASSERT_EQ(probes.size(), 3u);
    const char *names[] = {"upper", "zone", "lower"};
    for (int p = 0; p < 3; ++p)
      {
        EXPECT_EQ(probes[p].name, names[p]);
        ASSERT_EQ(probes[p].polygon.size(), 4u);
        Eigen::Vector2d centre = Eigen::Vector2d::Zero();
        for (const auto &x : probes[p].polygon)
          {
            EXPECT_TRUE(inside_polygon(x, synthetic::box_52_75));
            centre += 0.25 * x;
          }
        const double across = (centre - frame.centre).dot(band.normal()) - band.offset;
        if (p == 1)
          EXPECT_NEAR(across, 0, 1e-12);
        else
          for (const auto &x : probes[p].polygon)
            EXPECT_GE((p == 0 ? 1 : -1) * ((x - frame.centre).dot(band.normal()) - band.offset), 4.4 - 1e-9);
      }
  }

  TEST(Probes, AreStackedWithoutABand)
  {
    const auto probes = place_probes(synthetic::box_52_75, synthetic::frame_52_75(), {});
    ASSERT_EQ(probes.size(), 3u);
    for (int p = 0; p < 2; ++p)
      EXPECT_GT(probes[p].polygon[0].y(), probes[p + 1].polygon[2].y());
  }

  TEST(Probes, OutlineOfASnapshotRunsCounterClockwise)
  {
    diptych::discrete::Outline outline;
    outline.left          = {{0, 0}, {-1, 1}, {0, 2}};
    outline.right         = {{3, 0}, {3, 2}};
    const auto polygon    = outline_polygon(outline);
    double     twice_area = 0;
    for (std::size_t k = 0; k < polygon.size(); ++k)
      {
        const auto &a = polygon[k], &b = polygon[(k + 1) % polygon.size()];
        twice_area += a.x() * b.y() - a.y() * b.x();
      }
    EXPECT_DOUBLE_EQ(twice_area, 2 * (6 + 1));
  }

  TEST(Probes, PrincipalStressesOfAKnownTensor)
  {
    // 3 along 30 degrees and 1 across: xx = 2 + cos 60, yy = 2 - cos 60, xy = sin 60.
    Eigen::Matrix2d stress;
    stress << 2.5, std::sqrt(0.75), std::sqrt(0.75), 1.5;
    const auto result = probe_stress(stress, 1);
    EXPECT_NEAR(result.s1, 3, 1e-14);
    EXPECT_NEAR(result.s2, 1, 1e-14);
    EXPECT_NEAR(result.direction_deg, 30, 1e-12);
    EXPECT_NEAR(result.t_over_s, 0.5, 1e-14);
  }

  // A hexagonal lattice of touching discs of diameter 1 under the stress S. Every grain has M = S times its share of area,
  // sqrt(3)/2. In spite of its rim, a probe gives S up to the scatter of its measured solid fraction.
  TEST(Probes, UniformMomentDensityGivesItsStress)
  {
    const Eigen::Matrix2d              stress  = synthetic::oblique_stress();
    const GrainNetwork                 lattice = synthetic::hexagonal_network(55, 90, stress);
    const std::vector<Eigen::Matrix2d> moment(lattice.position.size(), stress * std::sqrt(0.75));
    const QuadMesh                     mesh = synthetic::box_mesh({0, 0}, {52, 75}, 26, 37, 0.2);
    const std::vector<Eigen::Matrix2d> in_cells(mesh.cell.size(), stress);
    for (const auto &probe : place_probes(synthetic::box_52_75, synthetic::frame_52_75(), {oblique_band()}))
      {
        const auto of_grains = grain_probe_stress(probe, lattice.position, lattice.radius, moment);
        EXPECT_LT((of_grains.stress - stress).norm(), 0.01 * stress.norm());
        EXPECT_NEAR(of_grains.t_over_s, probe_stress(stress, 1).t_over_s, 1e-12);
        EXPECT_GT(of_grains.count, 50);
        const auto of_cells = cell_probe_stress(probe, mesh, in_cells);
        EXPECT_LT((of_cells.stress - stress).norm(), 1e-12);
        EXPECT_GT(of_cells.count, 5);
      }
  }

  // Density of normals (1 + a cos 2 (theta - 20 deg)) / 2 pi: F1 - F2 = a/2, so 2 (F1 - F2) = a.
  TEST(Probes, FabricOfAKnownDistribution)
  {
    std::mt19937_64                              random(1);
    std::vector<diptych::discrete::ContactForce> contacts;
    while (contacts.size() < 20000)
      {
        const double theta = synthetic::uniform(random, 0, 2 * M_PI);
        if (synthetic::uniform(random, 0, 1.4) < 1 + 0.4 * std::cos(2 * (theta - 20 * M_PI / 180)))
          contacts.push_back({0, 1, {26, 37.5}, {std::cos(theta), std::sin(theta)}, {1, 0}});
      }
    contacts.push_back({0, 1, {26, 37.5}, {1, 0}, {0, 0}});  // carries no force
    contacts.push_back({0, 1, {-26, 37.5}, {1, 0}, {1, 0}}); // lies elsewhere
    const auto fabric = probe_fabric({"zone", synthetic::box_52_75, 0}, contacts);
    EXPECT_EQ(fabric.contacts, 20000);
    EXPECT_NEAR(fabric.fabric.trace(), 1, 1e-12);
    EXPECT_NEAR(fabric.anisotropy_error, 0.01, 1e-12);
    EXPECT_NEAR(fabric.anisotropy, 0.4, 3 * fabric.anisotropy_error);
    // 1 / (0.4 sqrt(40000)) rad = 0.72 degrees.
    EXPECT_NEAR(fabric.direction_error_deg, 0.72, 0.03);
    EXPECT_NEAR(fabric.direction_deg, 20, 3 * fabric.direction_error_deg);
    EXPECT_EQ(std::accumulate(fabric.normals_24.begin(), fabric.normals_24.end(), 0), 40000);
    for (int k = 0; k < 12; ++k)
      EXPECT_EQ(fabric.normals_24[k], fabric.normals_24[k + 12]);
    EXPECT_GT(fabric.normals_24[1], fabric.normals_24[7]); // 15-30 degrees and 105-120 degrees
  }

  // 0, 0 is the middle of the frame, 26, 37.5. A probe of 20 x 10 rotated by 90 degrees covers x = 31 .. 41, y = 17.5 .. 37.5.
  TEST(Probes, UseThePlacesGivenByTheScene)
  {
    ProbeOptions options;
    options.probe_rectangles = {10, -10, 20, 10, 90, 24, 0, 10, 20, 0};
    const auto probes        = place_probes(synthetic::box_52_75, synthetic::frame_52_75(), {oblique_band()}, options);
    ASSERT_EQ(probes.size(), 2u);
    EXPECT_EQ(probes[0].name, "probe 1");
    EXPECT_EQ(probes[0].angle_deg, 90);
    Eigen::Vector2d low = probes[0].polygon[0], high = low;
    for (const auto &x : probes[0].polygon)
      low = low.cwiseMin(x), high = high.cwiseMax(x);
    EXPECT_LT((low - Eigen::Vector2d(31, 17.5)).norm(), 1e-12);
    EXPECT_LT((high - Eigen::Vector2d(41, 37.5)).norm(), 1e-12);
    EXPECT_NEAR(polygon_area(probes[1].polygon), 7 * 20, 1e-12); // x = 45 .. 55, but the sample ends at 52
    options.probe_rectangles = {100, 0, 10, 20, 0};
    EXPECT_TRUE(place_probes(synthetic::box_52_75, synthetic::frame_52_75(), {}, options)[0].polygon.empty());
  }

  TEST(Probes, MessagesForWrongNumbersHaveTheKey)
  {
    const auto refused = [](const std::vector<double> &rectangles, const std::vector<double> &circle, const std::string &fault) {
      ProbeOptions options;
      options.probe_rectangles = rectangles, options.probe_circle = circle;
      diptych::tests::expect_refused({fault}, [&] { place_probes(synthetic::box_52_75, synthetic::frame_52_75(), {}, options); });
    };
    refused({1, 2, 3, 4}, {}, "probe_rectangles: 4 numbers");
    refused({1, 2, 3, 0, 5}, {}, "probe_rectangles: length and thickness of probe 1");
    refused({}, {1, 2, -3}, "probe_circle: the radius");
  }

  TEST(Probes, EmptyProbeHasNoStress)
  {
    const ProbeRegion none{"upper", {}, 0};
    EXPECT_TRUE(std::isnan(grain_probe_stress(none, {}, {}, {}).s1));
    EXPECT_EQ(probe_fabric(none, {}).contacts, 0);
  }
} // namespace
