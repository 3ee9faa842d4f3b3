// diptych: shear layer with a nonlocal hardening variable against its closed form
// SPDX-License-Identifier: LGPL-2.1-or-later
#include "tests/continuum/problem_scenes.h"

namespace
{
  using namespace diptych::continuum;
  using namespace diptych::continuum::tests;

  // Softens linearly from c = 0.5 to 0.36 over a hardening variable of 0.1; no friction. A weak spot starts the band.
  Options layer(const double length, const double weight)
  {
    Options options           = with_steps(with({}, Platens::rough, Kinematics::small_strain), 1e-3);
    options.law               = LawKind::gradient_drucker_prager;
    LawOptions &law           = options.material;
    law.hardening             = kind_of<TableHardening>;
    law.table_strain          = {0, 0.1};
    law.table_friction_angle  = {0, 0};
    law.table_dilatancy_angle = {0, 0};
    law.table_cohesion        = {0.5, 0.36};
    law.internal_length       = length;
    law.nonlocal_weight       = weight;
    law.viscosity             = 5e-4;
    options.weak_spot_strain  = 0.01;
    options.weak_spot_radius  = 0.8 * length;
    return options;
  }

  // Standard deviation across the layer of the hardening variable that grew between two progresses.
  double half_width(const double h, const Options &options)
  {
    constexpr double height  = 20;
    Loading          loading = straight_loading(1, {height, 0}, {1});
    loading.lateral          = PeriodicSides{0.};
    BoundaryValueProblem problem(rectangle(h, height, h), Units(), loading, options);
    LoadDriver           driver(problem, options);
    EXPECT_EQ(driver.equilibrate(), "");
    EXPECT_EQ(advance(problem, driver, 0.015), "");
    const auto before = problem.committed().points;
    EXPECT_EQ(advance(problem, driver, 0.025), "");
    const auto &mesh = problem.discretisation();
    double      sum = 0, first = 0, second = 0;
    for (std::size_t i = 0; i < before.size(); ++i)
      {
        const std::size_t c = i / mesh.reference.n_points, q = i % mesh.reference.n_points;
        double            y = -height / 2;
        for (unsigned int node = 0; node < mesh.reference.n_nodes; ++node)
          y += mesh.reference.shape[q][node] * mesh.nodes[mesh.cells[c].nodes[node]].initial.y();
        const double w = problem.geometry().cells[c].points[q].area *
                         (problem.committed().points[i].equivalent_plastic_strain - before[i].equivalent_plastic_strain);
        sum += w, first += w * y, second += w * y * y;
      }
    EXPECT_GT(sum, 0);
    return std::sqrt(second / sum - first * first / (sum * sum));
  }

  // The softening variable is uniform in the plastic zone, so that kappa = cos(x/a) - cos(w/(2a)) up to a factor, with a = l
  // sqrt(m - 1) and the zone w = 2 a (pi - atan(l/a)), where kappa = 0. For m = 2 this is w = 4.71 l and a standard deviation of
  // 0.976 l. For m = 1 there is no such solution: the band is as thin as the mesh permits.
  TEST(GradientLayer, HasTheWidthOfTheClosedFormOnAnyMesh)
  {
    const double coarse = half_width(2, layer(2, 2)), fine = half_width(1, layer(2, 2));
    EXPECT_NEAR(coarse / fine, 1, 0.03);
    EXPECT_NEAR(fine, 0.976 * 2, 0.03 * 0.976 * 2);
    EXPECT_NEAR(half_width(0.5, layer(1, 2)), 0.976, 0.03 * 0.976);
    EXPECT_LT(half_width(1, layer(2, 1)), 0.7 * half_width(2, layer(2, 1)));
  }
} // namespace
