// diptych: tests of the invariants of every averaging method on every mesh
// SPDX-License-Identifier: LGPL-2.1-or-later
#include "coupling/averaging/averaging.h"

#include <Eigen/Geometry>

#include "benchmarks/homogenisation/airy_network.h"
#include "coupling/averaging/periodic.h"
#include "coupling/averaging/point_stress.h"
#include "tests/coupling/averaging/averaging_cases.h"

namespace
{
  using namespace diptych::coupling::synthetic;

  // |sum over cells - sum over carriers| of every column, relative to the sum of the absolute values over carriers.
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

  // Mass, momentum and moments, with the contacts at platens. In the second case a third of the sample lies outside the mesh.
  TEST(Averaging, CellsAddUpToTheGrains)
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

  // Some grains have an abscissa in another period than the mesh, and some contacts cross its sides. The continuum can change its
  // width. Its mesh is then a hundredth wider or narrower than the grains' cell, and its images overlap or leave gaps.
  TEST(Averaging, CellsOfAPeriodicSampleAddUpToTheGrainsForAMeshOfAnyWidth)
  {
    for (const double period : {19.8, 20., 20.2})
      {
        // A grain at x moves to x - 7 or x - 7 + period, so that the old sides lie in the middle.
        Network moved = made_periodic(random_network({0, 0}, {period, 30}, 600, 5), period, 6);
        for (Eigen::Vector2d &x : moved.position)
          x.x() -= 7;
        for (auto &c : moved.contacts)
          c.point.x() -= 7;
        const Carriers carriers = random_carriers(moved, 7);
        for_each_case([&](const AveragingOptions &options, const QuadMesh &mesh) {
          EXPECT_LT(loss(distribute(options, TargetCells(mesh, period), carriers), carriers), 1e-12) << period;
        });
      }
  }

  // A network in a cell with two periods, and the same network moved by one row of its mesh. Whole periods of each grain are
  // random, and the contacts follow.
  Network moved_in_cell(Network network, const Period &cell, const Eigen::Vector2d &step, const std::uint64_t seed)
  {
    std::mt19937_64              random(seed);
    std::vector<Eigen::Vector2d> moves;
    for (Eigen::Vector2d &x : network.position)
      {
        moves.emplace_back(step + cell.vectors *
                                    Eigen::Vector2d(std::floor(uniform(random, -1, 2)), std::floor(uniform(random, -1, 2))));
        x += moves.back();
      }
    follow_grains(moves, network.contacts);
    return network;
  }

  // Parallelograms over the cell from `corner` on.
  QuadMesh mesh_of(const Period &cell, const Eigen::Vector2d &corner, const unsigned int columns, const unsigned int rows)
  {
    QuadMesh mesh = box_mesh({0, 0}, {1, 1}, columns, rows);
    for (Eigen::Vector2d &x : mesh.node)
      x = corner + cell.vectors * x;
    return mesh;
  }

  // A cell that is periodic in both directions has no edge.
  TEST(Averaging, CellWithTwoPeriodsHasNoSeamAndAddsUpToTheGrains)
  {
    const Period       cell((Eigen::Matrix2d() << 20, 6, -3, 28).finished());
    const unsigned int columns = 7, rows = 10;
    const TargetCells  target(mesh_of(cell, {1, 2}, columns, rows), cell);
    const Network      first    = moved_in_cell(random_network({0, 0}, {20, 30}, 400, 8), cell, {0, 0}, 9);
    const Network      moved    = moved_in_cell(first, cell, cell.vectors.col(1) / rows, 10);
    const Carriers     carriers = random_carriers(first, 11);
    for (const AveragingOptions &options : averaging_methods)
      {
        SCOPED_TRACE(name_of(options));
        const CellSums before = distribute(options, target, carriers);
        EXPECT_LT(loss(before, carriers), 1e-12);
        CellSums after = distribute(options, target, random_carriers(moved, 11)), back = after;
        for (unsigned int to = 0; to < rows * columns; ++to)
          {
            const unsigned int from = (to + columns) % (rows * columns);
            back.of_grains.row(to)  = after.of_grains.row(from);
            back.uniform.row(to)    = after.uniform.row(from);
            back.tapered.row(to)    = after.tapered.row(from);
          }
        EXPECT_LT(difference(before, back), 1e-10);
      }
  }

  // One disc of diameter 1 in every parallelogram of 1, 60 degrees, with unit forces at its six contacts: sigma = sqrt(3) 1 and
  // the solid fraction pi / (2 sqrt 3), in every cell and by every method. Contacts across all edges reach other images.
  TEST(Averaging, LatticeInACellWithTwoPeriodsHasTheStressOfTheLattice)
  {
    const int             n    = 6;
    const Eigen::Matrix2d unit = (Eigen::Matrix2d() << 1, 0.5, 0, std::sqrt(0.75)).finished();
    const Period          cell(Eigen::Matrix2d(n * unit));
    Network               network;
    for (int k = 0; k < n * n; ++k)
      {
        network.position.emplace_back(unit * Eigen::Vector2d(k % n, k / n));
        network.radius.push_back(0.5);
        for (const auto &[along, up] : {std::pair(1, 0), std::pair(0, 1), std::pair(-1, 1)})
          {
            const Eigen::Vector2d there(k % n + along, k / n + up), image = (there / n).array().floor();
            const int             j      = int(std::lround((there - n * image).x() + n * (there - n * image).y()));
            const Eigen::Vector2d branch = unit * Eigen::Vector2d(along, up), shift = cell.vectors * image;
            network.contacts.push_back({k, j, network.position.back() + 0.5 * branch, -branch, -branch, shift.x(), 0, shift.y()});
          }
      }
    network = moved_in_cell(network, cell, {0, 0}, 12);
    diptych::discrete::Snapshot grains;
    grains.position = network.position, grains.radius = network.radius, grains.window_forces = network.contacts;
    grains.mean_spin_term.assign(network.radius.size(), 0.);
    grains.cell_vectors        = cell.vectors;
    const QuadMesh        mesh = mesh_of(cell, {-0.31, -0.23}, n, n);
    const TargetCells     target(mesh, cell);
    const Eigen::Vector4d expected(std::sqrt(3.), 0, 0, std::sqrt(3.));
    for (const AveragingOptions &options : averaging_methods)
      {
        const CellSums sums = distribute(options, target, moment_carriers(grains.position, grains.radius, grains.window_forces));
        for (unsigned int k = 0; k < target.n_cells(); ++k)
          EXPECT_LT((sums.uniform.row(k).head<4>().transpose() / target.area[k] - expected).norm(), 1e-10) << name_of(options);
      }
    const MappedGrains mapped = map_grains(mesh, grains);
    EXPECT_TRUE(mapped.has_collar);
    EXPECT_LT(mapped.nodal_residual, 1e-12);
    for (const Eigen::Matrix2d &stress : cell_stress(mesh, mapped.moment))
      EXPECT_LT((stress - std::sqrt(3.) * Eigen::Matrix2d::Identity()).norm(), 1e-12);
    for (const double solid : grain_cover(mesh, grains).solid_fraction)
      EXPECT_NEAR(solid, M_PI / std::sqrt(12.), 1e-12);
    const Carriers        moments = moment_carriers(grains.position, grains.radius, grains.window_forces);
    const TargetCells     region(mesh, period_of(grains));
    const Eigen::Matrix2d middle = stress_at_points(region, moments, {{0, 0}}, KernelShape::gauss, 2.)[0];
    EXPECT_LT((middle - std::sqrt(3.) * Eigen::Matrix2d::Identity()).norm(), 1e-3); // the kernel's quadrature
  }

  // A periodic sample has no sides: if the grains move by one column of a regular grid, the sums move by one column.
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

  // The grains and half branches belong to three groups. Each group is averaged alone, and the parts must add up cell by cell.
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

  // Every second cell is cut into four. For methods that divide the plane among grains, the parts add up to the cell. The kernel
  // has other quadrature points: 1e-3 of the largest cell. The projection has other functions, so only its totals agree.
  TEST(Averaging, RefinementPreservesCellsAndTotals)
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
        if (options.method == AveragingMethod::projection)
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
        EXPECT_LT(difference(on_coarse, added), options.method == AveragingMethod::kernel ? 1e-3 : 1e-11);
      }
  }

  // Sample and mesh are moved, or rotated by 0.7: scalars do not change, vectors and tensors rotate.
  TEST(Averaging, MovingAndRotatingTheSampleMovesAndRotatesEveryTensor)
  {
    const Network  network  = random_network({0, 0}, {20, 30}, 500, 17);
    const Carriers carriers = random_carriers(network, 18);
    for (const auto &[angle, shift] : {std::pair{0., Eigen::Vector2d(-137.3, 81.7)}, {0.7, Eigen::Vector2d(0, 0)}})
      {
        const Eigen::Matrix2d turn  = Eigen::Rotation2Dd(angle).toRotationMatrix();
        const auto            place = [&, to = shift](const Eigen::Vector2d &x) { return Eigen::Vector2d(turn * x + to); };
        Network               moved = network;
        for (Eigen::Vector2d &x : moved.position)
          x = place(x);
        for (auto &c : moved.contacts)
          c.point = place(c.point), c.force = turn * c.force;
        Carriers moved_carriers               = random_carriers(moved, 18); // rotates the moments with the forces and branches
        moved_carriers.of_grains.rightCols(2) = carriers.of_grains.rightCols(2) * turn.transpose();
        moved_carriers.tapered                = carriers.tapered * turn.transpose();
        for_each_case([&](const AveragingOptions &options, const QuadMesh &mesh) {
          QuadMesh moved_mesh = mesh;
          for (Eigen::Vector2d &x : moved_mesh.node)
            x = place(x);
          CellSums       expected         = distribute(options, TargetCells(mesh), carriers);
          const CellSums sums             = distribute(options, TargetCells(moved_mesh), moved_carriers);
          expected.of_grains.rightCols(2) = (expected.of_grains.rightCols(2) * turn.transpose()).eval();
          expected.tapered                = (expected.tapered * turn.transpose()).eval();
          for (Eigen::Index k = 0; k < expected.uniform.rows(); ++k)
            {
              Eigen::Matrix2d m;
              m << expected.uniform(k, 0), expected.uniform(k, 1), expected.uniform(k, 2), expected.uniform(k, 3);
              m = (turn * m * turn.transpose()).eval();
              expected.uniform.row(k).head(4) << m(0, 0), m(0, 1), m(1, 0), m(1, 1);
            }
          EXPECT_LT(difference(expected, sums), 1e-10);
        });
      }
  }

  // The grains' velocities are v = b + A x, weighted by mass. Every method must give b + A (centre of mass of the cell's grains)
  // to round-off. A uniform velocity is therefore reproduced exactly, and an added velocity V adds V.
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

  // Random stress waves about a pressure of 1, with every grain in equilibrium. Then sum |K| sigma = -sum f (x) x over the forces
  // f of the box on the sample at x.
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
      const Eigen::RowVectorXd total = sums.uniform.colwise().sum();
      EXPECT_NEAR(total[0], boundary(0, 0), 1e-10 * boundary.norm());
      EXPECT_NEAR(total[1], boundary(0, 1), 1e-10 * boundary.norm());
      EXPECT_NEAR(total[2], boundary(1, 0), 1e-10 * boundary.norm());
      EXPECT_NEAR(total[3], boundary(1, 1), 1e-10 * boundary.norm());
      // phi = -r^2/2 + ...: the pressure of the whole box is 1 up to the mean of the wave, below 0.3 x 2 / (k 20) = 0.06.
      EXPECT_NEAR(0.5 * (total[0] + total[3]) / 600, 1, 0.06);
    });
  }
} // namespace
