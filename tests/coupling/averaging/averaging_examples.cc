// diptych: tests of averaging for cases with a known answer
// SPDX-License-Identifier: LGPL-2.1-or-later
#include "coupling/averaging/averaging.h"
#include "coupling/averaging/periodic.h"
#include "tests/coupling/averaging/averaging_cases.h"

namespace
{
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

  // A column of discs, 1.3 wide, of different radii. Every contact carries the horizontal force 0.7 on the upper disc, and the
  // couples balance: each disc takes up 0.7 x its diameter. The skew stress is then uniform, s_xy - s_yx = 0.7/1.3, and in a
  // continuum in equilibrium the couple stress changes linearly by this amount per length. The mapped one is exact in cells of
  // any height, the reference point of each being its centre. Couples at the contacts alone would make a staircase.
  TEST(Averaging, CoupleStressOfAColumnOfDiscsIsThatOfACosseratContinuum)
  {
    const double force = 0.7, width = 1.3, at_bottom = 0.4;
    Network      column;
    double       y = 0;
    for (const double radius : {0.3, 0.5, 0.4, 0.65, 0.3, 0.55, 0.5, 0.35})
      {
        column.position.emplace_back(0.2, y + radius);
        column.radius.push_back(radius);
        const int                       i = int(column.radius.size()) - 1;
        diptych::discrete::ContactForce below{i, i > 0 ? i - 1 : 9, {0.2, y}, {0, 1}, {force, 1}};
        below.couple = at_bottom + force * y; // on the upper disc
        column.contacts.push_back(below);
        y += 2 * radius;
      }
    diptych::discrete::ContactForce top{7, 8, {0.2, y}, {0, -1}, {-force, -1}};
    top.couple = -(at_bottom + force * y);
    column.contacts.push_back(top);

    const Carriers    carriers = moment_carriers(column.position, column.radius, column.contacts);
    const QuadMesh    mesh     = box_mesh({-0.45, 0}, {width - 0.45, y}, 1, 5);
    const TargetCells target(mesh);
    const CellSums    sums = distribute({}, target, carriers);
    for (unsigned int k = 0; k < target.n_cells(); ++k)
      {
        const double skew = (sums.uniform(k, 1) - sums.uniform(k, 2)) / target.area[k], middle = cell_centre(mesh, k).y();
        EXPECT_NEAR(skew, force / width, 1e-12);
        EXPECT_NEAR((sums.uniform(k, couple_moment + 1) + sums.tapered(k, 1)) / target.area[k],
                    (at_bottom + force * middle) / width, 1e-12);
      }
    Eigen::Vector2d of_grains = Eigen::Vector2d::Zero(); // conservative
    for (const Eigen::Vector2d &moment : couple_moments(carriers))
      of_grains += moment;
    const double total = y * (at_bottom + force * y / 2);
    EXPECT_NEAR(of_grains.y(), total, 1e-12);
  }

  // Random forces and couples, nothing in equilibrium: sum_K |K| mu_K grad N_a plus the skew stress with N_a must equal the
  // couples of the grains with N_a at their centres, minus those of the platens, at every node of mesh and collar.
  TEST(Averaging, CouplesBalanceAtEveryNode)
  {
    std::mt19937_64 random(25);
    Network         network = random_network({-2, -2}, {22, 32}, 800, 24);
    for (auto &contact : network.contacts)
      contact.couple = normal(random);
    Carriers carriers    = moment_carriers(network.position, network.radius, network.contacts);
    carriers.judge_nodes = true;
    for (const NamedMesh &mesh : averaging_meshes())
      EXPECT_LT(distribute({}, TargetCells(mesh.mesh), carriers).couple_residual, 1e-12) << mesh.name;
    carriers.tapered *= 1.001;
    EXPECT_GT(distribute({}, TargetCells(averaging_meshes()[0].mesh), carriers).couple_residual, 1e-6);
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
