// diptych: mesh refinement where plastic strain concentrates: conserved quantities and results
// SPDX-License-Identifier: LGPL-2.1-or-later
#include <deal.II/dofs/dof_tools.h>

#include "continuum/panel/sample_state.h"
#include "tests/continuum/problem_scenes.h"

namespace
{
  using namespace diptych::continuum::tests;

  Options softening(const LawKind law)
  {
    Options options                          = with_steps({}, 2e-3);
    options.law                              = law;
    options.material.friction_angle_peak     = 30;
    options.material.friction_angle_residual = 22;
    options.material.dilatancy_angle_peak    = 5;
    options.material.softening_strain        = 0.1;
    return options;
  }

  // Largest distance of a hanging node from its edge, in the present shape.
  double largest_gap(const BoundaryValueProblem &problem, unsigned int &n_hanging)
  {
    const auto                       &mesh = problem.discretisation();
    dealii::AffineConstraints<double> hanging(mesh.relevant);
    dealii::DoFTools::make_hanging_node_constraints(mesh.dof_handler, hanging);
    hanging.close();
    const auto &u   = problem.committed().displacement;
    double      gap = 0;
    n_hanging       = 0;
    for (const auto &line : hanging.get_lines())
      {
        double on_edge = 0;
        for (const auto &[master, weight] : line.entries)
          on_edge += weight * u[mesh.relevant.index_within_set(master)];
        gap = std::max(gap, std::abs(u[mesh.relevant.index_within_set(line.index)] - on_edge));
        ++n_hanging;
      }
    return gap;
  }

  // A homogeneous plastic state stays in equilibrium wherever elements are divided.
  TEST(Refinement, LeavesAHomogeneousStateInEquilibrium)
  {
    const QuadMesh mesh = rectangle(12, 12, 3.);
    for (const auto &[law, element] : {std::pair<LawKind, Displacement>{LawKind::cosserat_mohr_coulomb, Displacement::q2},
                                       {LawKind::gradient_drucker_prager, Displacement::q2},
                                       {LawKind::drucker_prager, Displacement::q2},
                                       {LawKind::mohr_coulomb, Displacement::q1_bbar}})
      {
        Options options   = perfectly_plastic(law, 30, 10, 0.1);
        options           = with_steps(with(options, Platens::smooth, Kinematics::small_strain), 1e-3);
        options.element   = element;
        options.tolerance = 1e-9;
        BoundaryValueProblem problem(mesh, Units(), straight_loading(1, {0, -12}, {1}), options);
        LoadDriver           driver(problem, options);
        ASSERT_EQ(advance(problem, driver, 0.01), "");
        const MaterialState before = problem.committed().points.front();
        refine_around(problem, {0, 9}, 1);
        EXPECT_GT(problem.discretisation().cells.size(), 16u);
        EXPECT_LT(problem.discretisation().cells.size(), 64u);
        problem.begin_step(problem.progress());
        EXPECT_LT(problem.evaluate(problem.zero_vector()).relative(), 1e-7) << name_of(law);
        for (const MaterialState &point : problem.committed().points)
          {
            EXPECT_NEAR((point.stress - before.stress).norm(), 0, 1e-7);
            EXPECT_NEAR(point.equivalent_plastic_strain, before.equivalent_plastic_strain, 1e-7);
          }
      }
  }

  // A hanging node beside a platen moves with it, by the same travel as its edge.
  TEST(Refinement, HangingNodesBesideAPlatenFollowIt)
  {
    const QuadMesh       mesh = rectangle(12, 12, 3.);
    BoundaryValueProblem problem(mesh, Units(), straight_loading(1, {12, -12}, {1}), elastic());
    refine_around(problem, {0, 9}, 1);
    problem.begin_step(0.01);
    auto u = random_increment(problem, 0.01, 2);
    problem.impose(u);
    (void)problem.evaluate(u);
    problem.commit();
    unsigned int n_hanging = 0;
    EXPECT_LT(largest_gap(problem, n_hanging), 1e-14);
    EXPECT_GT(n_hanging, 4u);
  }

  // On the shape for equilibrium.
  double plastic_work(const BoundaryValueProblem &problem)
  {
    const unsigned int n_points = problem.discretisation().reference.n_points;
    double             work     = 0;
    for (std::size_t i = 0; i < problem.committed().points.size(); ++i)
      work += problem.geometry().cells[i / n_points].points[i % n_points].area * problem.committed().points[i].dissipation;
    return work;
  }

  // Refinement at the onset of plastic flow, as in a run, or within an existing band. Area and mean stress are kept. The
  // transferred stress is nearly in equilibrium. At the onset its error is that of an elastic sample (6 % to 11 %), because the
  // coarse mesh has no equilibrium at the new nodes. Then equilibrium is found again. Hanging nodes lie on their edges at once,
  // afterwards, and after further steps. The plastic work done so far does not change: the polynomial through the points of an
  // element has the same integral on its four parts, exactly for parallelograms such as the elements of the initial shape.
  TEST(Refinement, CarriesTheStateAndFindsEquilibriumAgain)
  {
    const QuadMesh mesh = rectangle(24, 24, 2.);
    for (const auto &[law, element] : {std::pair<LawKind, Displacement>{LawKind::cosserat_mohr_coulomb, Displacement::q2},
                                       {LawKind::mohr_coulomb, Displacement::q2},
                                       {LawKind::mohr_coulomb, Displacement::q1_bbar}})
      for (const double onset : {0.002, 0.008})
        {
          const std::string name       = name_of(law) + ", " + name_of(element) + " at " + std::to_string(onset);
          Options           options    = with(softening(law), Platens::rough, Kinematics::small_strain);
          options.element              = element;
          const Loading        loading = straight_loading(1, {24, -24}, {1});
          BoundaryValueProblem problem(mesh, Units(), loading, options);
          LoadDriver           driver(problem, options);
          ASSERT_EQ(driver.equilibrate(), "");
          ASSERT_EQ(advance(problem, driver, onset), "");
          const HistoryRow before = make_history_row(problem, driver, loading);
          const double     work   = plastic_work(problem);
          auto             state  = driver.state();
          ASSERT_TRUE(refine(problem, {1, 0.5}, plastic_increments(problem), state.last));
          driver.restart(state);
          const HistoryRow after = make_history_row(problem, driver, loading);
          EXPECT_GT(work, 0);
          EXPECT_NEAR(plastic_work(problem), work, 1e-12 * work) << name;
          EXPECT_GT(after.n_cells, before.n_cells);
          EXPECT_LT(after.n_cells, 4 * before.n_cells) << "elements away from the band are not divided";
          EXPECT_NEAR(after.volumetric_strain, before.volumetric_strain, 1e-6);
          EXPECT_NEAR((after.mean_stress - before.mean_stress).norm(), 0, 1e-6 * before.mean_stress.norm()) << name;
          EXPECT_EQ(after.axial_strain, before.axial_strain);
          unsigned int n_hanging;
          EXPECT_LT(largest_gap(problem, n_hanging), 1e-9);
          EXPECT_GT(n_hanging, 0u);

          problem.begin_step(problem.progress());
          const double unbalance = problem.evaluate(problem.zero_vector()).relative();
          EXPECT_GT(unbalance, 1e-4) << "the transfer is not exact";
          if (onset == 0.002)
            {
              EXPECT_LT(unbalance, 0.15) << name;
            }
          ASSERT_EQ(driver.equilibrate(), "");
          problem.begin_step(problem.progress());
          EXPECT_LT(problem.evaluate(problem.zero_vector()).relative(), 1.01 * options.tolerance) << name;
          EXPECT_LT(largest_gap(problem, n_hanging), 1e-9);

          ASSERT_EQ(advance(problem, driver, onset + 0.004), "");
          EXPECT_LT(largest_gap(problem, n_hanging), 1e-9) << name;
          const Eigen::Vector2d lower = problem.platen_force(false), upper = problem.platen_force(true);
          EXPECT_LT((lower + upper).norm(), 1e-3 * upper.norm());
        }
  }

  // An adaptive run with one division against uniform meshes of both sizes: it is nearer to the fine one, with fewer elements.
  TEST(Refinement, AdaptiveCourseIsNearlyTheFineOne)
  {
    const QuadMesh coarse = rectangle(24, 24, 4.), fine = rectangle(24, 24, 2.);
    const Loading  loading    = straight_loading(1, {24, -24}, {0.03});
    Options        options    = softening(LawKind::cosserat_mohr_coulomb);
    const Course   uniform    = finished(fine, loading, options);
    options                   = tests::adaptive(options);
    options.refinement_levels = 1;
    const Course adaptive     = finished(coarse, loading, options);
    EXPECT_EQ(adaptive.rows.front().n_cells, 36);
    EXPECT_GT(adaptive.end().n_cells, 36);
    EXPECT_LT(adaptive.end().n_cells, 144);
    EXPECT_NEAR(adaptive.end().stress_ratio, uniform.end().stress_ratio, 0.03 * uniform.end().stress_ratio);
    EXPECT_NEAR((adaptive.end().upper_platen_force - uniform.end().upper_platen_force).norm(), 0,
                0.04 * uniform.end().upper_platen_force.norm());
    const Snapshot &s    = adaptive.snapshots.back();
    double          area = 0;
    for (const CellState &cell : s.cell_state)
      area += cell.area;
    EXPECT_NEAR(area, s.area, 1e-9 * s.area);
    for (std::size_t k = 0; k < s.position.size(); ++k)
      if (const Eigen::Vector2d initial = s.position[k] - s.displacement[k]; initial.y() > 24 - 1e-9)
        {
          EXPECT_NEAR((s.displacement[k] - Eigen::Vector2d(0.72, -0.72)).norm(), 0, 1e-9);
        }
  }

  TEST(Refinement, DoesNotDivideAnElasticSample)
  {
    Options options    = elastic();
    options.refinement = Refinement::adaptive;
    EXPECT_EQ(finished(rectangle(8, 8, 2.), straight_loading(1, {8, -8}, {0.01}), options).report.n_cells, 16u);
  }
} // namespace
