// diptych: invariants that every method of averaging keeps on every mesh
// SPDX-License-Identifier: LGPL-2.1-or-later
#include "coupling/homogenisation/averaging.h"

#include <stdexcept>

#include <Eigen/Geometry>
#include <gtest/gtest.h>

#include "benchmarks/homogenisation/airy_network.h"
#include "coupling/homogenisation/periodic.h"
#include "tests/coupling/averaging_cases.h"

namespace
{
  using namespace diptych::coupling;
  using namespace diptych::coupling::synthetic;

  template <class Action> void for_each_case(Action &&action)
  {
    for (const NamedMesh &mesh : averaging_meshes())
      for (const AveragingOptions &options : averaging_methods)
        {
          SCOPED_TRACE(name_of(options) + " on " + mesh.name);
          action(options, mesh.mesh);
        }
  }

  // |sum over cells - sum over carriers| of every column, relative to the sum of absolute values over carriers.
  double loss(const Columns &cells, const Columns &carriers)
  {
    double largest = 0;
    for (Eigen::Index k = 0; k < cells.cols(); ++k)
      largest = std::max(largest, std::abs(cells.col(k).sum() - carriers.col(k).sum()) / carriers.col(k).cwiseAbs().sum());
    return largest;
  }

  double loss(const CellSums &sums, const Carriers &c)
  {
    return std::max({loss(sums.of_grains, c.of_grains), loss(sums.uniform, c.uniform), loss(sums.tapered, c.tapered)});
  }

  // Mass, momentum and moments, contacts with platens included; also where a third of the sample lies outside the mesh.
  TEST(Averaging, CellsAddUpToWhatTheGrainsCarry)
  {
    const Carriers inside  = random_carriers(random_network({0, 0}, {20, 30}, 600, 1), 2);
    const Carriers outside = random_carriers(random_network({-3, -3}, {23, 33}, 600, 3), 4);
    for_each_case([&](const AveragingOptions &options, const QuadMesh &mesh) {
      const TargetCells target(mesh);
      EXPECT_LT(loss(distribute(options, target, inside), inside), 1e-12);
      const CellSums sums = distribute(options, target, outside);
      EXPECT_LT(loss(sums, outside), 1e-12);
      EXPECT_GE(sums.outside_share, 0);
      EXPECT_LT(sums.outside_share, 0.5);
    });
  }

  // Grains whose own abscissa lies in another period than the mesh, and contacts across its sides.
  TEST(Averaging, CellsOfAPeriodicSampleAddUpToWhatTheGrainsCarry)
  {
    const Network still = random_network({0, 0}, {20, 30}, 600, 5);
    // network in which a grain at x stands at x - 7 or x + 13: the old sides are in the middle
    Network moved = made_periodic(still, 20, 6);
    for (Eigen::Vector2d &x : moved.position)
      x.x() -= 7;
    for (auto &c : moved.contacts)
      c.point.x() -= 7;
    const Carriers carriers = random_carriers(moved, 7);
    for_each_case([&](const AveragingOptions &options, const QuadMesh &mesh) {
      const CellSums sums = distribute(options, TargetCells(mesh, 20), carriers);
      EXPECT_LT(loss(sums, carriers), 1e-12);
    });
  }

  // In a periodic sample the sides are nowhere: moving the grains by one column of a regular grid moves the sums by one column.
  TEST(Averaging, PeriodicSampleHasNoSeam)
  {
    const unsigned int columns = 10, rows = 12;
    const QuadMesh     mesh = box_mesh({0, 0}, {20, 30}, columns, rows);
    const TargetCells  target(mesh, 20);
    const Network      first = random_network({0, 0}, {20, 30}, 400, 8);
    Network            moved = made_periodic(first, 20, 9);
    for (Eigen::Vector2d &x : moved.position)
      x.x() += 2;
    for (auto &c : moved.contacts)
      c.point.x() += 2;
    for (const AveragingOptions &options : averaging_methods)
      {
        SCOPED_TRACE(name_of(options));
        const CellSums before = distribute(options, target, random_carriers(first, 10));
        CellSums       after = distribute(options, target, random_carriers(moved, 10)), back = after;
        for (unsigned int r = 0; r < rows; ++r)
          for (unsigned int c = 0; c < columns; ++c)
            {
              const unsigned int to = r * columns + c, from = r * columns + (c + 1) % columns;
              back.of_grains.row(to) = after.of_grains.row(from);
              back.uniform.row(to)   = after.uniform.row(from);
              back.tapered.row(to)   = after.tapered.row(from);
            }
        EXPECT_LT(difference(before, back), 1e-10);
      }
  }

  // Grains and halves coloured in three, each colour's quantities averaged alone: the parts add up cell by cell.
  TEST(Averaging, PartsOfTheSampleAddUp)
  {
    const Carriers all = random_carriers(random_network({0, 0}, {20, 30}, 300, 11), 12);
    for_each_case([&](const AveragingOptions &options, const QuadMesh &mesh) {
      const TargetCells target(mesh);
      const CellSums    whole = distribute(options, target, all);
      CellSums          sum;
      for (int colour = 0; colour < 3; ++colour)
        {
          Carriers part = all;
          for (Eigen::Index i = 0; i < part.of_grains.rows(); ++i)
            part.of_grains.row(i) *= i % 3 == colour;
          for (Eigen::Index h = 0; h < part.uniform.rows(); ++h)
            part.uniform.row(h) *= h % 3 == colour, part.tapered.row(h) *= h % 3 == colour;
          const CellSums sums = distribute(options, target, part);
          sum.of_grains       = colour == 0 ? sums.of_grains : Columns(sum.of_grains + sums.of_grains);
          sum.uniform         = colour == 0 ? sums.uniform : Columns(sum.uniform + sums.uniform);
          sum.tapered         = colour == 0 ? sums.tapered : Columns(sum.tapered + sums.tapered);
        }
      EXPECT_LT(difference(whole, sum), 1e-12);
    });
  }

  // Every second cell cut in four. Methods that divide the plane among grains: the parts add up to the cell. The kernel's
  // quadrature points differ: 1e-3 of the largest cell. The projection has other functions, so that only totals are equal.
  TEST(Averaging, RefinementLeavesCellsAndTotalsAsTheyWere)
  {
    const QuadMesh coarse = box_mesh({0, 0}, {20, 30}, 9, 13, 0.2);
    const Refined  fine   = refined(coarse, [](const Eigen::Vector2d &x) { return std::fmod(x.x() + x.y(), 5) < 2.5; });
    const Carriers c      = random_carriers(random_network({0, 0}, {20, 30}, 600, 13), 14);
    for (const AveragingOptions &options : averaging_methods)
      {
        SCOPED_TRACE(name_of(options));
        const CellSums on_coarse = distribute(options, TargetCells(coarse), c),
                       on_fine   = distribute(options, TargetCells(fine.mesh), c);
        EXPECT_LT(loss(on_fine, c), 1e-12);
        if (options.method == "projection")
          continue;
        CellSums added = on_coarse;
        added.of_grains.setZero(), added.uniform.setZero(), added.tapered.setZero();
        for (std::size_t k = 0; k < fine.children.size(); ++k)
          for (const unsigned int child : fine.children[k])
            {
              added.of_grains.row(Eigen::Index(k)) += on_fine.of_grains.row(child);
              added.uniform.row(Eigen::Index(k)) += on_fine.uniform.row(child);
              added.tapered.row(Eigen::Index(k)) += on_fine.tapered.row(child);
            }
        EXPECT_LT(difference(on_coarse, added), options.method == "kernel" ? 1e-3 : 1e-11);
      }
  }

  // Sample and mesh moved away: the same sums.
  TEST(Averaging, OriginDoesNotMatter)
  {
    const Network         network = random_network({0, 0}, {20, 30}, 500, 15);
    const Eigen::Vector2d shift(-137.3, 81.7);
    Network               moved = network;
    for (Eigen::Vector2d &x : moved.position)
      x += shift;
    for (auto &c : moved.contacts)
      c.point += shift;
    for_each_case([&](const AveragingOptions &options, const QuadMesh &mesh) {
      QuadMesh moved_mesh = mesh;
      for (Eigen::Vector2d &x : moved_mesh.node)
        x += shift;
      const CellSums here  = distribute(options, TargetCells(mesh), random_carriers(network, 16));
      const CellSums there = distribute(options, TargetCells(moved_mesh), random_carriers(moved, 16));
      EXPECT_LT(difference(here, there), 1e-10);
    });
  }

  // Sample and mesh turned by 0.7: scalars stay, vectors and tensors turn.
  TEST(Averaging, TurningTheSampleTurnsEveryTensor)
  {
    const Eigen::Matrix2d turn    = Eigen::Rotation2Dd(0.7).toRotationMatrix();
    const Network         network = random_network({0, 0}, {20, 30}, 500, 17);
    Network               turned  = network;
    for (Eigen::Vector2d &x : turned.position)
      x = turn * x;
    for (auto &c : turned.contacts)
      c.point = turn * c.point, c.force = turn * c.force;
    const Carriers carriers                = random_carriers(network, 18);
    Carriers       turned_carriers         = random_carriers(turned, 18); // turns the moments with the forces and branches
    turned_carriers.of_grains.rightCols(2) = carriers.of_grains.rightCols(2) * turn.transpose();
    turned_carriers.tapered                = carriers.tapered * turn.transpose();
    for_each_case([&](const AveragingOptions &options, const QuadMesh &mesh) {
      QuadMesh turned_mesh = mesh;
      for (Eigen::Vector2d &x : turned_mesh.node)
        x = turn * x;
      CellSums       expected         = distribute(options, TargetCells(mesh), carriers);
      const CellSums sums             = distribute(options, TargetCells(turned_mesh), turned_carriers);
      expected.of_grains.rightCols(2) = (expected.of_grains.rightCols(2) * turn.transpose()).eval();
      expected.tapered                = (expected.tapered * turn.transpose()).eval();
      for (Eigen::Index k = 0; k < expected.uniform.rows(); ++k)
        {
          Eigen::Matrix2d m;
          m << expected.uniform(k, 0), expected.uniform(k, 1), expected.uniform(k, 2), expected.uniform(k, 3);
          m = (turn * m * turn.transpose()).eval();
          expected.uniform.row(k) << m(0, 0), m(0, 1), m(1, 0), m(1, 1);
        }
      EXPECT_LT(difference(expected, sums), 1e-10);
    });
  }

  // Velocities v = b + A x of the grains, mass weighted: every method gives b + A (centre of mass of the cell's grains) to
  // round-off, so that a uniform velocity is reproduced exactly, and an added velocity V adds V.
  TEST(Averaging, AffineVelocityIsReproducedAtTheCentreOfMass)
  {
    const Network         network = random_network({0, 0}, {20, 30}, 800, 19);
    const Eigen::Vector2d b(3, -7);
    Eigen::Matrix2d       a;
    a << 0.4, -1.1, 0.7, 0.2;
    Carriers c = moment_carriers(network.position, network.radius, {});
    c.of_grains.resize(Eigen::Index(network.position.size()), 5);
    for (Eigen::Index i = 0; i < c.of_grains.rows(); ++i)
      {
        const Eigen::Vector2d &x = network.position[i], v = b + a * x;
        const double           m = network.radius[i] * network.radius[i];
        c.of_grains.row(i) << m, m * x.x(), m * x.y(), m * v.x(), m * v.y();
      }
    for_each_case([&](const AveragingOptions &options, const QuadMesh &mesh) {
      const Columns sums   = distribute(options, TargetCells(mesh), c).of_grains;
      int           filled = 0;
      for (Eigen::Index k = 0; k < sums.rows(); ++k)
        if (sums(k, 0) > 0.1)
          {
            const Eigen::Vector2d centre   = sums.row(k).segment<2>(1) / sums(k, 0),
                                  velocity = sums.row(k).segment<2>(3) / sums(k, 0);
            EXPECT_LT((velocity - b - a * centre).norm(), 1e-11);
            ++filled;
          }
      EXPECT_GT(filled, 50);
    });
  }

  // Random stress waves about a pressure of 1, every grain in equilibrium: sum |K| sigma = -sum f (x) x over the forces of the
  // box on the sample, f at x.
  TEST(Averaging, InEquilibriumTheBoundaryForcesGiveTheTotal)
  {
    const auto network = diptych::benchmarks::airy_network({0, 0}, {20, 30}, diptych::benchmarks::pressure_wave(0.3, 12), 21);
    Eigen::Matrix2d boundary = Eigen::Matrix2d::Zero();
    for (const auto &c : network.contacts)
      if (c.j == int(network.position.size()))
        boundary -= c.force * c.point.transpose();
    const Carriers c = moment_carriers(network.position, network.radius, network.contacts);
    for_each_case([&](const AveragingOptions &options, const QuadMesh &mesh) {
      const CellSums           sums  = distribute(options, TargetCells(mesh), c);
      const Eigen::RowVector4d total = sums.uniform.colwise().sum();
      EXPECT_NEAR(total[0], boundary(0, 0), 1e-10 * boundary.norm());
      EXPECT_NEAR(total[1], boundary(0, 1), 1e-10 * boundary.norm());
      EXPECT_NEAR(total[2], boundary(1, 0), 1e-10 * boundary.norm());
      EXPECT_NEAR(total[3], boundary(1, 1), 1e-10 * boundary.norm());
      // phi = -r^2/2 + ...: the pressure of the whole box is 1 up to the wave's mean, below 0.3 x 2 / (k 20) = 0.06
      EXPECT_NEAR(0.5 * (total[0] + total[3]) / 600, 1, 0.06);
    });
  }

  // Grains on every node and in the middle of every edge of a grid.
  TEST(Averaging, GrainOnAnEdgeIsCountedOnce)
  {
    const QuadMesh mesh = box_mesh({0, 0}, {6, 6}, 3, 3);
    Network        network;
    for (int x = 0; x <= 6; ++x)
      for (int y = 0; y <= 6; ++y)
        network.position.emplace_back(x, y), network.radius.push_back(0.5);
    Carriers c  = moment_carriers(network.position, network.radius, {});
    c.of_grains = Columns::Ones(49, 1);
    for (const AveragingOptions &options : averaging_methods)
      {
        SCOPED_TRACE(name_of(options));
        const CellSums sums = distribute(options, TargetCells(mesh), c);
        EXPECT_NEAR(sums.of_grains.sum(), 49, 1e-11);
        for (Eigen::Index k = 0; options.method == "centroid" && k < 9; ++k)
          EXPECT_EQ(sums.of_grains(k, 0), std::round(sums.of_grains(k, 0)));
      }
  }

  // Hexagonal lattice of diameter 1 in a cell with periodic sides, every contact with the normal force 1. Cells of whole
  // lattice periods, 2 wide and two rows high, far from the upper and the lower end: sigma = sqrt(3) 1 (three contacts a
  // grain of area sqrt(3)/2, sum n (x) n = 3/2 1) and solid fraction pi / (2 sqrt 3) = 0.9069.
  TEST(Averaging, HexagonalLatticeIsUniformInCellsOfWholePeriods)
  {
    const double row_height = std::sqrt(3.) / 2;
    const int    columns = 12, rows = 60;
    Network      network;
    const auto   number = [&](const int r, const int c) { return r * columns + (c + columns) % columns; };
    for (int r = 0; r < rows; ++r)
      for (int c = 0; c < columns; ++c)
        network.position.emplace_back(c + 0.5 * (r % 2) + 0.1, (r + 0.3) * row_height), network.radius.push_back(0.5);
    const auto touch = [&](const int i, const int j) {
      const double          shift = columns * std::round((network.position[i].x() - network.position[j].x()) / columns);
      const Eigen::Vector2d n     = network.position[i] - network.position[j] - Eigen::Vector2d(shift, 0);
      network.contacts.push_back({i, j, network.position[i] - 0.5 * n, n, n, shift});
    };
    for (int r = 0; r < rows; ++r)
      for (int c = 0; c < columns; ++c)
        {
          touch(number(r, c), number(r, c + 1));
          if (r + 1 < rows)
            touch(number(r, c), number(r + 1, c - 1 + r % 2)), touch(number(r, c), number(r + 1, c + r % 2));
        }
    Carriers c  = moment_carriers(network.position, network.radius, network.contacts);
    c.of_grains = Columns::Constant(rows * columns, 1, M_PI / 4);

    const QuadMesh    mesh = box_mesh({0, 0}, {columns, rows * row_height}, columns / 2, rows / 2);
    const TargetCells target(mesh, columns);
    for (AveragingOptions options : averaging_methods)
      {
        SCOPED_TRACE(name_of(options));
        options.width       = 0.7; // ends of the sample are 20 mean diameters = 40 l away from the cells looked at
        const CellSums sums = distribute(options, target, c);
        const double   area = 2 * 2 * row_height;
        for (Eigen::Index k = 12 * columns / 2; k < 18 * columns / 2; ++k)
          {
            EXPECT_NEAR(sums.of_grains(k, 0) / area, M_PI / (2 * std::sqrt(3.)), 1e-10);
            EXPECT_NEAR(sums.uniform(k, 0) / area, std::sqrt(3.), 1e-10);
            EXPECT_NEAR(sums.uniform(k, 3) / area, std::sqrt(3.), 1e-10);
            EXPECT_NEAR(sums.uniform(k, 1) / area, 0, 1e-10);
            EXPECT_NEAR(sums.uniform(k, 2) / area, 0, 1e-10);
          }
      }
  }

  // One half branch from (0.5, 0.5) to (2.5, 0.5), cells with edges at x = 1 and 2, t = 1/4 and 3/4: uniform 1/4, 1/2, 1/4;
  // tapered 2t - t^2: 7/16, 8/16, 1/16.
  TEST(Averaging, SegmentsCutUniformAndTaperedQuantitiesExactly)
  {
    const QuadMesh mesh = box_mesh({0, 0}, {3, 1}, 3, 1);
    Carriers       c;
    c.position  = {{0.5, 0.5}};
    c.radius    = {0.5};
    c.half      = {{0, {2, 0}}};
    c.half_size = {1};
    c.uniform = c.tapered    = Columns::Ones(1, 1);
    const CellSums sums      = distribute({}, TargetCells(mesh), c);
    const double   uniform[] = {1. / 4, 1. / 2, 1. / 4}, tapered[] = {7. / 16, 8. / 16, 1. / 16};
    for (int k = 0; k < 3; ++k)
      {
        EXPECT_NEAR(sums.uniform(k, 0), uniform[k], 1e-14);
        EXPECT_NEAR(sums.tapered(k, 0), tapered[k], 1e-14);
      }
  }

  // The moments of cells are those of map_grains(), which keeps triangles apart; also of what lies outside the mesh, and in a
  // periodic sample.
  TEST(Averaging, SegmentsAgreesWithTheMappingOntoTriangles)
  {
    const Network network = random_network({-2, -2}, {22, 32}, 800, 23);
    for (const double period : {0., 20.})
      for (const NamedMesh &mesh : {averaging_meshes()[1], averaging_meshes()[2]})
        {
          diptych::discrete::Snapshot s;
          s.position = network.position, s.radius = network.radius, s.window_forces = network.contacts;
          s.mean_spin_term.assign(800, 0.);
          s.cell_width              = mesh.name == "regular grid" ? period : 0;
          const MappedGrains mapped = map_grains(mesh.mesh, s);
          const auto         stress = cell_stress(mesh.mesh, mapped.moment);
          const TargetCells  target(mesh.mesh, s.cell_width);
          const CellSums     sums = distribute({}, target, moment_carriers(s.position, s.radius, s.window_forces));
          EXPECT_NEAR(sums.outside_share, mapped.moment.outside_share, 1e-10);
          EXPECT_GT(sums.outside_share, 0.01);
          double largest = 0;
          for (unsigned int k = 0; k < target.n_cells(); ++k)
            largest = std::max(largest, std::abs(stress[k](1, 0) - sums.uniform(k, 2) / target.area[k]));
          EXPECT_LT(largest, 1e-10);
        }
  }

  // A disc of radius 1 centred on the mesh's left side: half of it outside, and all of that half belongs to the cells at the
  // side; a quarter of another one sticks out at the corner.
  TEST(Averaging, DiscOutsideTheMeshGoesToTheNearestBoundaryCell)
  {
    const QuadMesh mesh = box_mesh({0, 0}, {6, 6}, 3, 3);
    Carriers       c;
    c.position          = {{0, 3}};
    c.radius            = {1};
    c.of_grains         = Columns::Ones(1, 1);
    const CellSums sums = distribute({}, TargetCells(mesh), c);
    EXPECT_NEAR(sums.of_grains(3, 0), 1, 1e-12); // the cell [0, 2] x [2, 4]
    c.position = {{6, 6}};
    EXPECT_NEAR(distribute({}, TargetCells(mesh), c).of_grains(8, 0), 1, 1e-12);
  }

  TEST(Averaging, WrongInputIsRefused)
  {
    const TargetCells target(box_mesh({0, 0}, {6, 6}, 3, 3));
    Carriers          c = random_carriers(random_network({0, 0}, {6, 6}, 20, 1), 1);
    EXPECT_THROW((void)distribute({"nearest", "gauss", 1}, target, c), std::invalid_argument);
    EXPECT_THROW((void)distribute({"kernel", "heaviside", 1}, target, c), std::invalid_argument);
    EXPECT_THROW((void)distribute({"kernel", "gauss", 0}, target, c), std::invalid_argument);
    c.half_size.pop_back();
    EXPECT_THROW((void)distribute({}, target, c), std::invalid_argument);
    diptych::discrete::ContactForce nobody{0, -1, {1, 1}, {1, 0}, {1, 0}};
    EXPECT_THROW((void)moment_carriers({{0, 0}}, {0.5}, {nobody}), std::invalid_argument);
  }
} // namespace
