// diptych: a run of the continuum panel: stages, rows, early ends, refused input
// SPDX-License-Identifier: LGPL-2.1-or-later
#include "tests/continuum/continuum_scenes.h"

namespace
{
  using namespace diptych::continuum::tests;

  TEST(Panel, FortyFiveDegreeShearLandsOnItsStages)
  {
    const QuadMesh mesh = outline_mesh(wavy_outline(14, 20, 11, 0.15), 2.);
    Options        options;
    options.material.softening_strain = 0.5;
    const Course c                    = finished(mesh, straight_loading(1, {20, -20}, {0, 0.004, 0.01}), options);
    ASSERT_EQ(c.snapshots.size(), 3u);
    EXPECT_EQ(c.snapshots[0].axial_strain, 0);
    EXPECT_EQ(c.snapshots[1].axial_strain, 0.004);
    EXPECT_EQ(c.snapshots[2].axial_strain, 0.01);
    EXPECT_EQ(c.rows.front().step, 0);
    EXPECT_EQ(c.end().axial_strain, 0.01);
    EXPECT_EQ(c.report.steps, c.end().step);
    EXPECT_EQ(c.report.n_cells, mesh.cells.size());
    EXPECT_LT(c.end().upper_platen_force.y(), 0) << "the upper platen presses down";
    EXPECT_GT(c.end().stress_ratio, 0.2);
    EXPECT_LT(c.end().stress_ratio, std::sin(20.5 * M_PI / 180) + 0.02); // t/s = sin phi + (c/s) cos phi, c = 0.01, s > 1
  }

  // At a stage the cells fill the area, the means are those of the history, the platens are at the prescribed positions.
  TEST(Panel, SnapshotAndHistoryAreOfOneState)
  {
    const Course    c    = finished(rectangle(14, 20, 2.), straight_loading(1, {20, -20}, {0.01}), {});
    const Snapshot &s    = c.snapshots.back();
    double          area = 0, weight = 0, dissipation = 0;
    Eigen::Matrix3d stress = Eigen::Matrix3d::Zero();
    for (const CellState &cell : s.cell_state)
      {
        area += cell.area;
        stress += cell.area * cell.stress;
        dissipation += cell.area * cell.dissipation;
      }
    for (const double w : s.weight)
      weight += w;
    EXPECT_NEAR(weight, s.area, 1e-9 * s.area);
    EXPECT_NEAR(area, s.area, 1e-9 * s.area);
    EXPECT_NEAR(1 - s.area / (14 * 20), c.end().volumetric_strain, 1e-9);
    EXPECT_NEAR((stress / area - c.end().mean_stress).norm(), 0, 1e-9);
    EXPECT_NEAR(dissipation, c.end().dissipation, 1e-9 * dissipation);
    EXPECT_GT(dissipation, 0);
    int n_upper = 0;
    for (std::size_t k = 0; k < s.position.size(); ++k)
      if (const Eigen::Vector2d initial = s.position[k] - s.displacement[k]; initial.y() > 20 - 1e-9)
        {
          ++n_upper;
          EXPECT_NEAR((s.displacement[k] - Eigen::Vector2d(0.2, -0.2)).norm(), 0, 1e-9);
        }
    EXPECT_EQ(n_upper, 15); // 7 elements with midpoints
  }

  TEST(Panel, StopsAtTheNextStepOnRequest)
  {
    const QuadMesh mesh  = rectangle(4, 6, 2.);
    int            steps = 0;
    Hooks          hooks;
    hooks.on_row         = [&](const HistoryRow &) { ++steps; };
    hooks.stop_requested = [&] { return steps >= 3; };
    Panel panel(mesh, Units(), straight_loading(1, {6, -6}, {0.05}), {}, hooks);
    EXPECT_EQ(panel.prepare(), Status::finished);
    EXPECT_EQ(panel.advance_to(1), Status::stopped_by_user);
    const Report report = panel.report();
    EXPECT_EQ(panel.stage(), 0);
    EXPECT_EQ(steps, 3); // the initial state and two steps
    EXPECT_EQ(report.steps, 2);
    EXPECT_GT(report.axial_strain, 0);
    EXPECT_LT(report.axial_strain, 0.05);
    steps = -1000;
    EXPECT_EQ(panel.advance_to(1), Status::finished) << "a further call continues";
    EXPECT_EQ(panel.report().progress, 0.05);
  }

  // The constructor calls check_stop between its phases and passes its exception on at once.
  TEST(Panel, ASetUpThatIsStoppedIsLeftAtOnce)
  {
    const Loading loading = straight_loading(1, {6, -6}, {0.05});
    int           calls = 0, last = 1000;
    Hooks         hooks;
    hooks.check_stop = [&] {
      if (++calls >= last)
        throw std::runtime_error("stopped");
    };
    const Panel whole(rectangle(4, 6, 2.), Units(), loading, {}, hooks);
    const int   n = calls;
    EXPECT_GT(n, 5);
    for (last = 1; last <= n; ++last)
      {
        calls = 0;
        EXPECT_THROW(Panel(rectangle(4, 6, 2.), Units(), loading, {}, hooks), std::runtime_error);
        EXPECT_EQ(calls, last);
      }
  }

  // A sample with a weight is not at rest initially. A stop during the search for equilibrium does not change the bits.
  TEST(Panel, ContinuesAfterAStopOnTheWayToRest)
  {
    const QuadMesh mesh    = outline_mesh(wavy_outline(24, 24, 13, 0.2), 4.);
    Loading        loading = straight_loading(1, {24, -24}, {0.004});
    loading.body_force     = {0, -0.01};
    Panel whole(mesh, Units(), loading, {});
    ASSERT_EQ(whole.prepare(), Status::finished);
    bool  stops = false;
    Hooks hooks;
    hooks.stop_requested = [&] { return stops; };
    Panel panel(mesh, Units(), loading, {}, hooks);
    stops = true;
    EXPECT_EQ(panel.prepare(), Status::stopped_by_user);
    EXPECT_EQ(panel.report().message, "stopped on request");
    EXPECT_EQ(panel.advance_to(1), Status::stopped_by_user);
    EXPECT_EQ(panel.report().progress, 0);
    stops = false;
    ASSERT_EQ(panel.prepare(), Status::finished);
    EXPECT_EQ(panel.snapshot().position, whole.snapshot().position);
    ASSERT_EQ(panel.advance_to(1), Status::finished);
    ASSERT_EQ(whole.advance_to(1), Status::finished);
    EXPECT_EQ(panel.snapshot().position, whole.snapshot().position);
  }

  TEST(Panel, ReportsTheProgressReachedWhenItFails)
  {
    const QuadMesh mesh = rectangle(14, 20, 2.);
    Options        options;
    options.max_newton_iterations = 1; // no plastic step converges in one iteration
    options.min_step              = 1e-4;
    const Course c                = course(mesh, straight_loading(1, {20, -20}, {0.02}), options);
    EXPECT_EQ(c.report.status, Status::not_converged);
    EXPECT_LT(c.report.axial_strain, 0.02);
    EXPECT_EQ(c.report.axial_strain, c.end().axial_strain);
    EXPECT_GE(c.report.cut_backs, 1);
    diptych::tests::expect_words(c.report.message, {"Newton"});
    if (c.report.axial_strain > 0)
      {
        EXPECT_EQ(c.snapshots.back().axial_strain, c.report.axial_strain) << "the snapshot holds the state reached";
      }
    EXPECT_EQ(c.report.message.find("internal length"), std::string::npos) << "the Cosserat law has one";
    options.law = LawKind::mohr_coulomb;
    diptych::tests::expect_words(course(mesh, straight_loading(1, {20, -20}, {0.02}), options).report.message,
                                 {"Newton", "cosserat_mohr_coulomb", "continuum/viscosity", "difference of the two angles"});
  }

  // One element under smooth platens with hardly any hardening range. The acoustic tensor loses its positive determinant where
  // softening begins. The line lies between Roscoe's 45 + psi/2 and Coulomb's 45 + phi/2 to the horizontal, the direction of
  // the minor pressure: 51 and 55.25 degrees at psi = 12, phi = 20.5.
  TEST(Panel, ReportsTheOnsetOfLocalisation)
  {
    const QuadMesh mesh    = rectangle(1, 1, 1.);
    Options        options = with(Options(), Platens::smooth, Kinematics::updated);
    options.law            = LawKind::mohr_coulomb;
    const Course c         = finished(mesh, straight_loading(1, {0, -1}, {0.01}), options);
    ASSERT_TRUE(c.report.localisation_progress.has_value());
    // s1 at peak: 2.0775 + 0.0288: elastic strain (s1 - 1) 0.96/500 = 0.0021.
    EXPECT_GT(*c.report.localisation_progress, 0.0021);
    EXPECT_LT(*c.report.localisation_progress, 0.004);
    EXPECT_GT(std::abs(*c.report.localisation_angle), 51 - 1);
    EXPECT_LT(std::abs(*c.report.localisation_angle), 55.25 + 1);
    EXPECT_FALSE(finished(mesh, straight_loading(1, {0, -1}, {0.002}), options).report.localisation_progress.has_value());
  }

  TEST(Panel, DirectAndMultigridSolversGiveTheSameCurve)
  {
    const QuadMesh mesh    = rectangle(14, 20, 2.);
    const Loading  loading = straight_loading(1, {20, -20}, {0.01});
    Options        options = with_steps({}, 1e-3);
    options.linear_solver  = LinearChoice::direct;
    const Course direct    = finished(mesh, loading, options);
    options.linear_solver  = LinearChoice::amg;
    const Course amg       = finished(mesh, loading, options);
    ASSERT_EQ(direct.rows.size(), amg.rows.size());
    for (std::size_t k = 0; k < direct.rows.size(); ++k)
      EXPECT_NEAR(amg.rows[k].stress_ratio, direct.rows[k].stress_ratio, 1e-4 * direct.end().stress_ratio);
    EXPECT_GT(amg.end().linear_iterations, 2 * amg.end().newton_iterations) << "multigrid needs more iterations";
  }

  // Mapping the isotropic pressure gives the isotropic initial state.
  TEST(Panel, MappedPressureIsTheIsotropicStart)
  {
    const QuadMesh mesh    = rectangle(4, 6, 2.);
    Options        options = perfectly_plastic(LawKind::mohr_coulomb, 20, 0, 0.1);
    const Loading  loading = straight_loading(1, {6, -6}, {0.004});
    const Course   plain   = finished(mesh, loading, options);
    options.initial_stress = InitialStress::mapped;
    Wishes wishes;
    wishes.initial_stress = [](const Snapshot &s) {
      EXPECT_EQ(s.cell_state.size(), 6u);
      return std::vector<Eigen::Matrix2d>(s.cell_state.size(), Eigen::Matrix2d::Identity());
    };
    const Course mapped = course(mesh, loading, options, wishes);
    EXPECT_NEAR((mapped.end().mean_stress - plain.end().mean_stress).norm(), 0, 1e-9);
  }

  // Cells with alternately 20 % more and less stress come to rest and keep their stress as far as equilibrium allows.
  TEST(Panel, MappedStressComesToRest)
  {
    const QuadMesh mesh    = rectangle(8, 12, 2.);
    Options        options = perfectly_plastic(LawKind::mohr_coulomb, 30, 0, 0.1);
    options.initial_stress = InitialStress::mapped;
    options.platens        = Platens::smooth;
    Wishes wishes;
    wishes.initial_stress = [](const Snapshot &s) {
      std::vector<Eigen::Matrix2d> stress;
      for (std::size_t c = 0; c < s.cells.size(); ++c)
        stress.push_back((c % 2 == 0 ? 1.2 : 0.8) * Eigen::Matrix2d::Identity());
      return stress;
    };
    const Course c = course(mesh, straight_loading(1, {0, -12}, {0}), options, wishes);
    ASSERT_EQ(c.report.status, Status::finished) << c.report.message;
    EXPECT_NEAR(c.end().mean_stress(0, 0), 1, 1e-3);
    double least = 9, largest = 0;
    for (const CellState &cell : c.snapshots.front().cell_state)
      {
        least   = std::min(least, cell.stress(1, 1));
        largest = std::max(largest, cell.stress(1, 1));
      }
    EXPECT_GT(largest - least, 0.02);
    EXPECT_LT(largest - least, 0.4);
  }

  Options critical_state(const double solid_fraction)
  {
    Options options;
    options.material.hardening            = kind_of<CriticalStateHardening>;
    options.material.solid_fraction_start = solid_fraction;
    options.material.mobilisation_strain  = 0.02;
    options.material.internal_length      = 2;
    options.max_step                      = 2.5e-3;
    return options;
  }

  // One set of parameters: a dense sample softens and dilates, a loose one hardens and contracts.
  TEST(CriticalStatePanel, DependsOnTheDensity)
  {
    const QuadMesh mesh  = rectangle(14, 20, 2.);
    const Loading  shear = straight_loading(1, {0, -20}, {0.08});
    const Course   dense = finished(mesh, shear, critical_state(0.86)), loose = finished(mesh, shear, critical_state(0.79));
    double         peak = 0;
    for (const HistoryRow &row : dense.rows)
      peak = std::max(peak, row.stress_ratio);
    EXPECT_GT(peak, 1.2 * 0.267); // value of steady flow with this cohesion
    EXPECT_LT(dense.end().stress_ratio, 0.85 * peak);
    EXPECT_LT(dense.end().volumetric_strain, -0.01);
    EXPECT_GT(loose.end().volumetric_strain, 0.01);
    EXPECT_LT(loose.end().stress_ratio, 0.28);
    // Corners under rough platens, which the sides cannot reach, collapse: rarely in dense grains, more often in loose ones.
    const auto most_unstable = [](const Course &c) {
      double most = 0;
      for (const HistoryRow &row : c.rows)
        most = std::max(most, row.unstable_share);
      return most;
    };
    EXPECT_GT(most_unstable(loose), 4 * most_unstable(dense));
  }

  // With an internal length the element size does not matter, with or without softening.
  TEST(CriticalStatePanel, DoesNotDependOnTheMesh)
  {
    std::vector<double> strength, volume;
    for (const double size : {3., 1.5})
      {
        const Course c = finished(rectangle(18, 24, size), straight_loading(1, {24, -24}, {0.03}), critical_state(0.86));
        strength.push_back(c.end().stress_ratio);
        volume.push_back(c.end().volumetric_strain);
      }
    EXPECT_NEAR(strength[1] / strength[0], 1, 0.02);
    EXPECT_NEAR(volume[1] / volume[0], 1, 0.04);
  }

  // A uniform solid fraction mapped cell by cell gives the same result as one given as a number.
  TEST(CriticalStatePanel, MapsTheSolidFraction)
  {
    const QuadMesh mesh    = rectangle(8, 12, 2.);
    const Loading  loading = straight_loading(1, {12, -12}, {0.01});
    const Course   given   = finished(mesh, loading, critical_state(0.85));
    Options        mapped  = critical_state(0.85);
    mapped.material.solid_fraction_start.reset();
    Panel panel(mesh, {}, loading, mapped);
    panel.set_initial_solid_fraction(std::vector<double>(mesh.cells.size(), 0.85));
    ASSERT_EQ(panel.prepare(), Status::finished);
    ASSERT_EQ(panel.advance_to(1), Status::finished);
    EXPECT_NEAR((panel.snapshot().mean_stress - given.snapshots.back().mean_stress).norm(), 0, 1e-9);
    for (const CellState &cell : panel.snapshot().cell_state)
      {
        EXPECT_GT(cell.friction_angle, asin(0.1) * 180 / M_PI) << "mobilised by now";
        EXPECT_NEAR(cell.solid_fraction, 0.85 * std::exp(cell.plastic_strain.trace()), 2e-5);
        EXPECT_NE(cell.solid_fraction, 0.85);
      }
    Panel without(mesh, {}, loading, mapped);
    EXPECT_THROW((void)without.prepare(), std::invalid_argument);
  }

  TEST(Panel, WrongInputIsRefusedByName)
  {
    const auto refuses = [](const auto &spoilt, const std::string &word) {
      diptych::tests::expect_refused({word}, [&] { validate(spoilt); });
    };
    refuses(straight_loading(-1, {0, -1}, {0.01}), "pressure");
    refuses(straight_loading(1, {0, -1}, {}), "stages");
    refuses(straight_loading(1, {0, -1}, {0.01, 0.005}), "stages");
    Loading loading       = straight_loading(1, {0, -1}, {0.01});
    loading.platens[1][1] = force(-1);
    EXPECT_NO_THROW(validate(loading));
    loading.platens[0][1] = force(1);
    refuses(loading, "both platens");
    loading.platens[0][1] = {true, {}};
    refuses(loading, "force");
    Options options;
    EXPECT_NO_THROW(validate(options));
    options.min_step = 1;
    refuses(options, "min_step");
    options         = {};
    options.element = Displacement::q1_bbar;
    refuses(options, "q1_bbar");
    options      = {};
    options.mesh = "rectangle";
    refuses(options, "rectangle_width");
  }

  TEST(Panel, LoadingsThatTheMeshCannotCarryAreRefused)
  {
    const QuadMesh straight = rectangle(4, 6, 2.);
    Loading        loading  = with_sides(straight_loading(1, {0, -6}, {0.001}), PeriodicSides());
    Options        options  = elastic();
    options.refinement      = Refinement::adaptive;
    EXPECT_THROW((void)course(straight, loading, options), std::invalid_argument);
    loading.lateral = PeriodicSides{std::nullopt};
    EXPECT_THROW((void)course(straight, loading, elastic()), std::invalid_argument) << "rough platens cannot stretch";
    EXPECT_EQ(course(straight, loading, with(elastic(), Platens::smooth, Kinematics::updated)).report.status, Status::finished);
    options                = elastic();
    options.initial_stress = InitialStress::mapped;
    loading                = straight_loading(1, {0, -6}, {0.001});
    EXPECT_THROW((void)course(straight, loading, options), std::invalid_argument) << "no stress was given";
    Wishes too_few;
    too_few.initial_stress = [](const Snapshot &) { return std::vector<Eigen::Matrix2d>(5); };
    EXPECT_THROW((void)course(straight, loading, options, too_few), std::invalid_argument);
    QuadMesh torn = straight;
    torn.boundary.pop_back();
    EXPECT_THROW((void)course(torn, loading, elastic()), std::invalid_argument);
  }
} // namespace
