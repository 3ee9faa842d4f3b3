// diptych: tests of the continuum's fields: increments between two stages, and after the averaging of the grains
// SPDX-License-Identifier: LGPL-2.1-or-later
#include "coupling/fields/continuum_averaging.h"
#include "coupling/cells/triangle_search.h"
#include "coupling/fields/continuum_fields.h"
#include "tests/common.h"
#include "tests/coupling/synthetic_samples.h"

namespace
{
  using namespace diptych;
  using namespace diptych::coupling;

  // sigma_xx(x) with sigma_yy = 2, displacement (x, 0), rotation y, dissipation 3, couple stress (0, 1).
  ContinuumFields fields_on(const QuadMesh &mesh, const std::function<double(const Eigen::Vector2d &)> &sigma_xx)
  {
    ContinuumFields fields;
    for (unsigned int c = 0; c < mesh.cell.size(); ++c)
      {
        const Eigen::Vector2d x = cell_centre(mesh, c);
        fields.stress.emplace_back(Eigen::Vector2d(sigma_xx(x), 2).asDiagonal());
        fields.couple_stress.emplace_back(0, 1);
        fields.displacement_increment.emplace_back(x.x(), 0);
        fields.rotation_increment.push_back(x.y());
        fields.dissipation.push_back(3);
        fields.volume_ratio.push_back(1);
      }
    return fields;
  }

  AveragingOptions method(const AveragingMethod name)
  {
    AveragingOptions options;
    options.method = name;
    return options; // width is 1.5
  }

  unsigned int cell_at(const QuadMesh &mesh, const Eigen::Vector2d &x)
  {
    return mesh.triangle[TriangleSearch(mesh).locate(x).triangle].cell;
  }

  TEST(ContinuumAveraging, MethodsThatOnlyCutPreserveValuesOnTheSameMesh)
  {
    const QuadMesh        mesh   = regular_grid({0, 0}, {10, 10}, 2);
    const ContinuumFields fields = fields_on(mesh, [](const auto &x) { return x.x(); });
    for (const AveragingMethod name : {AveragingMethod::segments, AveragingMethod::centroid, AveragingMethod::laguerre})
      {
        const ContinuumFields seen = averaged_continuum({mesh, fields}, mesh, {}, method(name));
        for (std::size_t c = 0; c < mesh.cell.size(); ++c)
          EXPECT_EQ(seen.stress[c], fields.stress[c]);
      }
  }

  // Smoothing redistributes stress but keeps its integral: sum of area x sigma_xx = 20 x integral of x from 0 to 20 = 4000, on
  // any receiving cells.
  TEST(ContinuumAveraging, SmoothingKeepsTheTotal)
  {
    const QuadMesh        mesh   = regular_grid({0, 0}, {20, 20}, 1);
    const ContinuumFields fields = fields_on(mesh, [](const auto &x) { return x.x(); });
    for (const AveragingMethod name : {AveragingMethod::kernel, AveragingMethod::projection})
      for (const double size : {1., 2.5, 5.})
        {
          const QuadMesh            receiving = regular_grid({0, 0}, {20, 20}, size);
          const std::vector<double> area      = cell_areas(receiving);
          const ContinuumFields     seen      = averaged_continuum({mesh, fields}, receiving, {}, method(name));
          double                    sum       = 0;
          for (std::size_t c = 0; c < area.size(); ++c)
            sum += area[c] * seen.stress[c](0, 0);
          EXPECT_NEAR(sum, 4000, 1e-8) << discrete::name_of(name) << ' ' << size;
        }
  }

  // A Gaussian of standard deviation w damps cos(k x) by exp(-w^2 k^2 / 2), 0.895 for w = 1.5 and a wave length of 20. The
  // Helmholtz smoothing damps it by 1 / (1 + w^2 k^2 / 2) = 0.900. Values that are constant on cells of 1, and means over such
  // cells, damp it by sin(k/2)/(k/2) = 0.996 each. A constant does not change. Kernel integrals are accurate to 1e-3.
  TEST(ContinuumAveraging, SmoothingDampsAWaveByTheKernelsFactor)
  {
    const QuadMesh        mesh = regular_grid({0, 0}, {40, 40}, 1);
    const double          k = 2 * M_PI / 20, cells = std::sin(k / 2) / (k / 2);
    const ContinuumFields fields = fields_on(mesh, [k](const Eigen::Vector2d &x) { return 1 + std::cos(k * (x.x() - 20.5)); });
    for (const auto &[name, factor] : {std::pair{AveragingMethod::kernel, std::exp(-0.5 * 2.25 * k * k)},
                                       std::pair{AveragingMethod::projection, 1 / (1 + 0.5 * 2.25 * k * k)}})
      {
        const ContinuumFields seen = averaged_continuum({mesh, fields}, mesh, {}, method(name));
        EXPECT_NEAR(seen.stress[cell_at(mesh, {20.5, 20.5})](0, 0), 1 + factor * cells * cells, 2e-3) << discrete::name_of(name);
        EXPECT_NEAR(seen.stress[cell_at(mesh, {20.5, 20.5})](1, 1), 2, 4e-3) << discrete::name_of(name);
        EXPECT_NEAR(seen.dissipation[cell_at(mesh, {20.5, 20.5})], 3, 6e-3) << discrete::name_of(name);
        EXPECT_NEAR(seen.displacement_increment[cell_at(mesh, {20.5, 20.5})].x(), 20.5, 1e-2) << discrete::name_of(name);
      }
  }

  TEST(ContinuumAveraging, GridCellsOutsideTheMeshHaveNoValue)
  {
    const QuadMesh        mesh = regular_grid({0, 0}, {4, 4}, 1), grid = regular_grid({0, 0}, {8, 4}, 2);
    const ContinuumFields seen = averaged_continuum({mesh, fields_on(mesh, [](const auto &) { return 1.; })}, grid, {},
                                                    method(AveragingMethod::segments));
    EXPECT_NEAR(seen.stress[cell_at(grid, {1, 1})](0, 0), 1, 1e-14);
    EXPECT_FALSE(seen.stress[cell_at(grid, {7, 1})].allFinite());
  }

  // n x n nine-node cells on the square of side 2. They move by u = t (x, -y) and rotate by t (1 + x + y), x and y in the initial
  // shape.
  continuum::Snapshot squeezed(const int n, const double t)
  {
    continuum::Snapshot s;
    const int           m = 2 * n + 1;
    for (int j = 0; j < m; ++j)
      for (int i = 0; i < m; ++i)
        {
          const Eigen::Vector2d x(2. * i / (m - 1), 2. * j / (m - 1));
          s.displacement.emplace_back(t * x.x(), -t * x.y());
          s.position.emplace_back(x + s.displacement.back());
          s.rotation.push_back(t * (1 + x.x() + x.y()));
        }
    s.cells = synthetic::nine_node_cells(n, n);
    for (int k = 0; k < n * n; ++k)
      {
        continuum::CellState state;
        state.stress.diagonal() = Eigen::Vector3d(1, 2 + t, 1.5);
        state.dissipation       = 10 * t + (k % n < n / 2 ? 0 : 1); // the right half had dissipated more before
        state.couple_stress     = {t, 0};
        s.cell_state.push_back(state);
      }
    return s;
  }

  // From t = 0.1 to 0.2: stress in the middle, dissipation 10 x 0.1. The mean displacement increment is 0.1 (x, -y) at the centre
  // of the initial cell, and the rotation there 0.1 (1 + x + y). The couple stress changes its sign to that of compression.
  void expect_increments(const ContinuumFields &f, const int n)
  {
    for (int k = 0; k < n * n; ++k)
      {
        const Eigen::Vector2d x((k % n + 0.5) * 2 / n, (k / n + 0.5) * 2 / n);
        EXPECT_NEAR(f.stress[k](1, 1), 2.15, 1e-14);
        EXPECT_NEAR(f.dissipation[k], 1, 1e-12);
        EXPECT_NEAR((f.displacement_increment[k] - 0.1 * Eigen::Vector2d(x.x(), -x.y())).norm(), 0, 1e-13);
        EXPECT_NEAR(f.rotation_increment[k], 0.1 * (1 + x.sum()), 1e-13);
        EXPECT_NEAR(f.couple_stress[k].x(), -0.2, 1e-15);
      }
  }

  TEST(ContinuumFields, AreDifferencesOfTheSameCells)
  {
    expect_increments(continuum_fields(squeezed(2, 0.1), squeezed(2, 0.2)), 2);
  }

  TEST(ContinuumFields, DividedCellsTakeTheEarlierValuesOfTheirParents)
  {
    expect_increments(continuum_fields(squeezed(2, 0.1), squeezed(4, 0.2)), 4);
  }

  TEST(ContinuumFields, ALawWithoutRotationHasNoRotationIncrement)
  {
    auto from = squeezed(2, 0.1), to = squeezed(2, 0.2);
    from.rotation.clear(), to.rotation.clear();
    EXPECT_TRUE(std::isnan(continuum_fields(from, to).rotation_increment[0]));
  }
} // namespace
