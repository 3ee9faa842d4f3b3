// diptych: tests of the continuum's fields after the averaging of the grains
// SPDX-License-Identifier: LGPL-2.1-or-later
#include "coupling/fields/continuum_averaging.h"

#include <cmath>
#include <functional>

#include <gtest/gtest.h>

#include "coupling/cells/triangle_search.h"

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
} // namespace
