// diptych: tests of averaging for cases with a known answer
// SPDX-License-Identifier: LGPL-2.1-or-later
#include <cmath>
#include <stdexcept>

#include "coupling/averaging/averaging.h"
#include "coupling/averaging/periodic.h"
#include "tests/coupling/averaging/averaging_cases.h"
#include "tests/coupling/averaging/hexagonal_lattice.h"

namespace
{
  using namespace diptych::coupling;
  using namespace diptych::coupling::synthetic;

  // Grains on every node and in the middle of every edge of a grid.
  TEST(Averaging, CountsAGrainOnAnEdgeOnce)
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
        for (Eigen::Index k = 0; options.method == AveragingMethod::centroid && k < 9; ++k)
          EXPECT_EQ(sums.of_grains(k, 0), std::round(sums.of_grains(k, 0)));
      }
  }

  // The mesh's cells cover whole lattice periods, 2 wide and two rows high, far from the upper and lower end.
  TEST(Averaging, HexagonalLatticeIsUniformInCellsOfWholePeriods)
  {
    const double       row_height = std::sqrt(3.) / 2;
    const int          columns = 12, rows = 60;
    const GrainNetwork network = periodic_lattice(columns, rows);
    Carriers           c       = moment_carriers(network.position, network.radius, network.forces);
    c.of_grains                = Columns::Constant(rows * columns, 1, M_PI / 4);

    const Eigen::Vector2d lower(-0.1, -0.3 * row_height), size(columns, rows * row_height);
    const TargetCells     target(box_mesh(lower, lower + size, columns / 2, rows / 2), columns);
    for (AveragingOptions options : averaging_methods)
      {
        SCOPED_TRACE(name_of(options));
        options.width       = 0.7; // the ends of the sample are 20 mean diameters = 40 l away from the tested cells
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

  // One half branch from (0.5, 0.5) to (2.5, 0.5) in cells with edges at x = 1 and 2, that is t = 1/4 and 3/4. Uniform: 1/4, 1/2,
  // 1/4. Tapered, 2t - t^2: 7/16, 8/16, 1/16.
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

  // The moments of cells must equal those of map_grains(), which keeps triangles separate. This includes parts outside the mesh
  // and periodic samples. So map_grains() has all invariances of the method segments.
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
          Carriers           carriers = moment_carriers(s.position, s.radius, s.window_forces);
          carriers.judge_nodes        = true;
          const CellSums sums         = distribute({}, target, carriers);
          EXPECT_NEAR(sums.outside_share, mapped.moment.outside_share, 1e-10);
          EXPECT_GT(sums.outside_share, 0.01);
          EXPECT_EQ(std::isnan(sums.nodal_residual), std::isnan(mapped.nodal_residual));
          if (mapped.has_collar)
            {
              EXPECT_LT(sums.nodal_residual, 1e-10);
            }
          double largest = 0;
          for (unsigned int k = 0; k < target.n_cells(); ++k)
            {
              Eigen::Matrix2d moment;
              moment << sums.uniform(k, 0), sums.uniform(k, 1), sums.uniform(k, 2), sums.uniform(k, 3);
              largest = std::max(largest, (stress[k] - moment / target.area[k]).norm());
            }
          EXPECT_LT(largest, 1e-10);
        }
  }

  // A disc of radius 1 is centred on the mesh's left side: its outer half belongs to the cells at this side. A quarter of another
  // disc lies outside at the corner.
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

  TEST(Averaging, RejectsWrongInput)
  {
    const TargetCells target(box_mesh({0, 0}, {6, 6}, 3, 3));
    Carriers          c = random_carriers(random_network({0, 0}, {6, 6}, 20, 1), 1);
    EXPECT_THROW((void)distribute({AveragingMethod::kernel, KernelShape::gauss, 0}, target, c), std::invalid_argument);
    c.half_size.pop_back();
    EXPECT_THROW((void)distribute({}, target, c), std::invalid_argument);
    diptych::discrete::ContactForce nobody{0, -1, {1, 1}, {1, 0}, {1, 0}};
    EXPECT_THROW((void)moment_carriers({{0, 0}}, {0.5}, {nobody}), std::invalid_argument);
  }
} // namespace
