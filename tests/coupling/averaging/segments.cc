// diptych: tests of segments and of discs in cells
// SPDX-License-Identifier: LGPL-2.1-or-later
#include "coupling/averaging/segments.h"
#include "coupling/averaging/cell_cover.h"
#include "tests/coupling/synthetic_samples.h"

namespace
{
  using namespace diptych::coupling;
  using diptych::discrete::ContactForce;

  MappedMoment mapped_on(const QuadMesh &mesh, const synthetic::Network &network)
  {
    return map_segments(mesh, TriangleSearch(mesh), network.position, network.contacts);
  }

  // Grain 0 lies left of grain 1. Pressed together by F = 3 over the branch 1, only sigma_xx |K| = 3 is not zero, and it is
  // positive. Row index = force: a force along y through this branch fills yx only.
  TEST(Segments, CompressionIsPositiveAndTheRowIsTheForce)
  {
    const QuadMesh     mesh = synthetic::box_mesh({0, 0}, {4, 4}, 3, 3);
    synthetic::Network network;
    network.position = {{1.3, 2}, {2.3, 2}};
    for (const Eigen::Vector2d &force : {Eigen::Vector2d(-3, 0), Eigen::Vector2d(0, -3)})
      {
        network.contacts = {{0, 1, {1.8, 2}, {-1, 0}, force}};
        Eigen::Matrix2d expected;
        expected << -force.x(), 0, -force.y(), 0;
        const MappedMoment mapped = mapped_on(mesh, network);
        EXPECT_LT((mapped.total - expected).norm(), 1e-14);
        EXPECT_LT(synthetic::loss(mapped), 3e-15);
      }
  }

  // The expected value is the direct sum, and, independently, sum M_i = -sum_c (x_c - x_i) (x) f over all contacts of all grains.
  TEST(Segments, CellsAddUpToTheGrainsInternalMoments)
  {
    for (const std::uint64_t seed : {1, 2, 3})
      {
        const auto      network = synthetic::random_network({0, 0}, {20, 30}, 800, seed);
        const auto      mapped  = mapped_on(synthetic::box_mesh({0, 0}, {20, 30}, 13, 17, 0.3), network);
        Eigen::Matrix2d moments = Eigen::Matrix2d::Zero();
        for (const auto &c : network.contacts)
          {
            moments -= c.force * (c.point - network.position[c.i]).transpose();
            if (c.j < 800)
              moments += c.force * (c.point - network.position[c.j]).transpose();
          }
        EXPECT_LT(synthetic::loss(mapped), 1e-12);
        EXPECT_LT((moments - mapped.total).norm(), 1e-12 * mapped.total.norm());
        EXPECT_LT(total_relative_error(mapped, moments), 1e-12);
        EXPECT_EQ(mapped.outside_share, 0);
      }
  }

  // Branches along x = 1, shared by cells 0 and 1, and along the diagonal of cell 0. Each must lie in one triangle only.
  TEST(Segments, CountsABranchAlongAnEdgeOnce)
  {
    const QuadMesh     mesh = synthetic::box_mesh({0, 0}, {3, 1}, 3, 1);
    synthetic::Network network;
    network.position  = {{1, 0.2}, {1, 0.9}, {0.1, 0.1}, {0.8, 0.8}};
    network.contacts  = {{0, 1, {1, 0.5}, {0, -1}, {0, -2}}, {2, 3, {0.4, 0.4}, {-1, -1}, {-1, -1}}};
    const auto mapped = mapped_on(mesh, network);
    EXPECT_NEAR(mapped.triangle_moment[0](1, 1), 2 * 0.7 + 1 * 0.7, 1e-14);
    for (std::size_t t = 1; t < mapped.triangle_moment.size(); ++t)
      EXPECT_EQ(mapped.triangle_moment[t].norm(), 0);
  }

  // sum_K |K| sigma_K grad N_a = sum_i N_a(x_i) (contact force on i) - sum_platens N_a(x_c) f is the virtual power of linear
  // elements.
  TEST(Segments, NodalForcesAreTheContactForcesInWeakForm)
  {
    const auto           network = synthetic::random_network({0, 0}, {20, 30}, 2000, 8);
    const QuadMesh       mesh    = synthetic::box_mesh({0, 0}, {20, 30}, 13, 17, 0.3);
    const TriangleSearch search(mesh);
    const auto           stress_side   = nodal_forces(mesh, mapped_on(mesh, network));
    const auto           contact_side  = nodal_contact_forces(mesh, search, network.position, network.contacts);
    double               largest_force = 0, largest_error = 0;
    for (std::size_t a = 0; a < mesh.node.size(); ++a)
      {
        largest_force = std::max(largest_force, contact_side[a].norm());
        largest_error = std::max(largest_error, (stress_side[a] - contact_side[a]).norm());
      }
    EXPECT_LT(largest_error, 1e-12 * largest_force);
  }

  // A free spinning disc has the internal moment -(1/2) I omega^2 1, in the cell of its centre.
  TEST(Segments, AddsTheSpinTermAtTheGrainsCentre)
  {
    const QuadMesh       mesh = synthetic::box_mesh({0, 0}, {3, 1}, 3, 1);
    const TriangleSearch search(mesh);
    MappedMoment         mapped = map_segments(mesh, search, {{1.5, 0.4}}, {});
    add_spin_term(search, {{1.5, 0.4}}, {0.25}, mapped);
    EXPECT_EQ(cell_stress(mesh, mapped)[1], -0.25 * Eigen::Matrix2d::Identity());
    EXPECT_EQ(mapped.total, -0.25 * Eigen::Matrix2d::Identity());
    EXPECT_THROW(add_spin_term(search, {{1.5, 0.4}}, {}, mapped), std::invalid_argument);
  }

  TEST(Segments, RejectsAContactOfAnUnknownGrain)
  {
    const QuadMesh mesh = synthetic::box_mesh({0, 0}, {3, 1}, 3, 1);
    EXPECT_THROW(map_segments(mesh, TriangleSearch(mesh), {{1, 0.5}}, {ContactForce{1, 2, {1, 0}, {0, 1}, {0, 1}}}),
                 std::invalid_argument);
  }

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
