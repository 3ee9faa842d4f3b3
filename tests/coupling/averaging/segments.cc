// diptych: tests of the invariants of the segments mapping
// SPDX-License-Identifier: LGPL-2.1-or-later
#include "coupling/averaging/segments.h"

#include <stdexcept>

#include <Eigen/Geometry>
#include <gtest/gtest.h>

#include "tests/coupling/synthetic_samples.h"

namespace
{
  using namespace diptych::coupling;
  using diptych::discrete::ContactForce;

  MappedMoment mapped_on(const QuadMesh &mesh, const synthetic::Network &network)
  {
    return map_segments(mesh, TriangleSearch(mesh), network.position, network.contacts);
  }

  Eigen::Matrix2d sum(const MappedMoment &mapped)
  {
    Eigen::Matrix2d total = Eigen::Matrix2d::Zero();
    for (const auto &moment : mapped.triangle_moment)
      total += moment;
    return total;
  }

  double largest(const std::vector<Eigen::Matrix2d> &tensors)
  {
    double norm = 0;
    for (const auto &t : tensors)
      norm = std::max(norm, t.norm());
    return norm;
  }

  // Grain 0 lies left of grain 1, and both are pressed together by F = 3. Only sigma_xx |K| = F times the branch 1 is not zero,
  // and it is positive.
  TEST(Segments, TwoDiscsPressedTogetherAreInCompression)
  {
    const QuadMesh     mesh = synthetic::box_mesh({0, 0}, {4, 4}, 3, 3);
    synthetic::Network network;
    network.position = {{1.3, 2}, {2.3, 2}};
    network.contacts = {{0, 1, {1.8, 2}, {-1, 0}, {-3, 0}}};
    Eigen::Matrix2d expected;
    expected << 3, 0, 0, 0;
    EXPECT_LT((sum(mapped_on(mesh, network)) - expected).norm(), 1e-14);
  }

  // Row index = force: a force along y through a branch along x fills yx only.
  TEST(Segments, RowIsForceAndColumnIsBranch)
  {
    const QuadMesh     mesh = synthetic::box_mesh({0, 0}, {4, 4}, 3, 3);
    synthetic::Network network;
    network.position = {{1.3, 2}, {2.3, 2}};
    network.contacts = {{0, 1, {1.8, 2}, {-1, 0}, {0, -3}}};
    Eigen::Matrix2d expected;
    expected << 0, 0, 3, 0;
    EXPECT_LT((sum(mapped_on(mesh, network)) - expected).norm(), 1e-14);
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
        EXPECT_LT((sum(mapped) - mapped.total).norm(), 1e-12 * mapped.total.norm());
        EXPECT_LT((moments - mapped.total).norm(), 1e-12 * mapped.total.norm());
        EXPECT_LT(total_relative_error(mapped, moments), 1e-12);
        EXPECT_EQ(mapped.outside_share, 0);
      }
  }

  TEST(Segments, TotalIsExactIfPartOfTheSampleLiesOutsideTheMesh)
  {
    const auto network = synthetic::random_network({0, 0}, {20, 30}, 800, 4);
    const auto mapped  = mapped_on(synthetic::box_mesh({3, 2}, {17, 21}, 9, 9, 0.3), network);
    EXPECT_LT((sum(mapped) - mapped.total).norm(), 1e-12 * mapped.total.norm());
    EXPECT_GT(mapped.outside_share, 0.1);
    EXPECT_LT(mapped.outside_share, 0.7);
  }

  // A branch from (1, 1) to a platen's contact point at (1, -1), with the mesh ending at y = 0. The outer half of the segment
  // goes to the cell above it.
  TEST(Segments, PieceOutsideGoesToTheNearestBoundaryCell)
  {
    const QuadMesh     mesh = synthetic::box_mesh({0, 0}, {6, 2}, 3, 1);
    synthetic::Network network;
    network.position  = {{1, 1}};
    network.contacts  = {{0, 1, {1, -1}, {0, 1}, {0, 5}}};
    const auto mapped = mapped_on(mesh, network);
    EXPECT_NEAR(mapped.outside_share, 0.5, 1e-12);
    EXPECT_NEAR((mapped.triangle_moment[0] + mapped.triangle_moment[1])(1, 1), 10, 1e-12);
  }

  TEST(Segments, OriginDoesNotMatter)
  {
    auto       network = synthetic::random_network({0, 0}, {20, 30}, 800, 5);
    QuadMesh   mesh    = synthetic::box_mesh({0, 0}, {20, 30}, 13, 17, 0.3);
    const auto before  = mapped_on(mesh, network);

    const Eigen::Vector2d shift(-37.3, 81.7);
    for (auto &node : mesh.node)
      node += shift;
    for (auto &x : network.position)
      x += shift;
    for (auto &contact : network.contacts)
      contact.point += shift;
    const auto after = mapped_on(mesh, network);
    for (std::size_t t = 0; t < before.triangle_moment.size(); ++t)
      EXPECT_LT((after.triangle_moment[t] - before.triangle_moment[t]).norm(), 1e-11 * largest(before.triangle_moment));
  }

  TEST(Segments, RotatingTheSampleRotatesEveryTensor)
  {
    auto       network = synthetic::random_network({0, 0}, {20, 30}, 800, 6);
    QuadMesh   mesh    = synthetic::box_mesh({0, 0}, {20, 30}, 13, 17, 0.3);
    const auto before  = mapped_on(mesh, network);

    const Eigen::Matrix2d turn = Eigen::Rotation2Dd(0.7).toRotationMatrix();
    for (auto &node : mesh.node)
      node = turn * node;
    for (auto &x : network.position)
      x = turn * x;
    for (auto &contact : network.contacts)
      {
        contact.point = turn * contact.point;
        contact.force = turn * contact.force;
      }
    const auto after = mapped_on(mesh, network);
    for (std::size_t t = 0; t < before.triangle_moment.size(); ++t)
      EXPECT_LT((after.triangle_moment[t] - turn * before.triangle_moment[t] * turn.transpose()).norm(),
                1e-11 * largest(before.triangle_moment));
  }

  // Each cell is cut into four by the middles of its edges and its centre. The four must add up to the cell.
  TEST(Segments, RefinementPreservesTheMomentOfEveryCell)
  {
    const auto     network = synthetic::random_network({0, 0}, {20, 30}, 800, 7);
    const QuadMesh coarse  = synthetic::box_mesh({0, 0}, {20, 30}, 8, 11, 0.2);
    QuadMesh       fine    = coarse;
    fine.cell.clear();
    const auto add = [&fine](const Eigen::Vector2d &x) {
      fine.node.push_back(x);
      return static_cast<unsigned int>(fine.node.size() - 1);
    };
    for (unsigned int c = 0; c < coarse.cell.size(); ++c)
      {
        const auto                 &corner = coarse.cell[c];
        const unsigned int          centre = add(cell_centre(coarse, c));
        std::array<unsigned int, 4> middle;
        for (int k = 0; k < 4; ++k)
          middle[k] = add(0.5 * (coarse.node[corner[k]] + coarse.node[corner[(k + 1) % 4]]));
        for (int k = 0; k < 4; ++k)
          fine.cell.push_back({{corner[k], middle[k], centre, middle[(k + 3) % 4]}});
      }
    triangulate(fine);

    const auto on_coarse = mapped_on(coarse, network), on_fine = mapped_on(fine, network);
    EXPECT_LT((on_fine.total - on_coarse.total).norm(), 1e-12 * on_coarse.total.norm());
    for (std::size_t c = 0; c < coarse.cell.size(); ++c)
      {
        Eigen::Matrix2d parts = Eigen::Matrix2d::Zero();
        for (int t = 0; t < 8; ++t)
          parts += on_fine.triangle_moment[8 * c + t];
        EXPECT_LT((parts - on_coarse.triangle_moment[2 * c] - on_coarse.triangle_moment[2 * c + 1]).norm(),
                  1e-11 * largest(on_coarse.triangle_moment));
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

  // Two groups of contacts, mapped separately, add up to the whole: the moment is an additive measure.
  TEST(Segments, PartsOfTheNetworkAddUp)
  {
    const auto     network = synthetic::random_network({0, 0}, {20, 30}, 800, 9);
    const QuadMesh mesh    = synthetic::box_mesh({0, 0}, {20, 30}, 13, 17, 0.3);
    auto           odd = network, even = network;
    odd.contacts.clear();
    even.contacts.clear();
    for (std::size_t c = 0; c < network.contacts.size(); ++c)
      (c % 2 == 0 ? even : odd).contacts.push_back(network.contacts[c]);
    const auto whole = mapped_on(mesh, network), a = mapped_on(mesh, odd), b = mapped_on(mesh, even);
    for (std::size_t t = 0; t < whole.triangle_moment.size(); ++t)
      EXPECT_LT((whole.triangle_moment[t] - a.triangle_moment[t] - b.triangle_moment[t]).norm(),
                1e-12 * largest(whole.triangle_moment));
  }

  // A hexagonal lattice of diameter 1; every contact has the normal force F = 1. Each grain of area sqrt(3)/2 has three contacts
  // with sum n (x) n = 3/2 1. Therefore sigma = sqrt(3) 1 in every cell of whole lattice periods: 2 diameters wide, two rows
  // high.
  TEST(Segments, HexagonalLatticeHasUniformStressInCellsOfWholePeriods)
  {
    const double       row_height = std::sqrt(3.) / 2;
    const int          columns = 24, rows = 24;
    synthetic::Network network;
    const auto         number = [](const int r, const int c) { return r * columns + c; };
    for (int r = 0; r < rows; ++r)
      for (int c = 0; c < columns; ++c)
        network.position.push_back({c + 0.5 * (r % 2), r * row_height});
    const auto touch = [&](const int i, const int j) {
      const Eigen::Vector2d normal = network.position[i] - network.position[j];
      network.contacts.push_back({i, j, 0.5 * (network.position[i] + network.position[j]), normal, normal});
    };
    for (int r = 0; r < rows; ++r)
      for (int c = 0; c < columns; ++c)
        {
          if (c + 1 < columns)
            touch(number(r, c), number(r, c + 1));
          const int left = c - 1 + r % 2;
          if (r + 1 < rows && left >= 0)
            touch(number(r, c), number(r + 1, left));
          if (r + 1 < rows && left + 1 < columns)
            touch(number(r, c), number(r + 1, left + 1));
        }

    const QuadMesh mesh   = synthetic::box_mesh({2.13, 1.37}, {2.13 + 18, 1.37 + 18 * row_height}, 9, 9);
    const auto     stress = cell_stress(mesh, mapped_on(mesh, network));
    for (unsigned int r = 1; r < 8; ++r) // boundary cells also hold parts outside the mesh
      for (unsigned int c = 1; c < 8; ++c)
        EXPECT_LT((stress[9 * r + c] - std::sqrt(3.) * Eigen::Matrix2d::Identity()).norm(), 1e-12);
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
} // namespace
