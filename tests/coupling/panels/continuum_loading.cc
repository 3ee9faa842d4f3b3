// diptych: tests of the continuum's counterparts of the grains' loadings and stresses
// SPDX-License-Identifier: LGPL-2.1-or-later
#include "coupling/panels/continuum_loading.h"
#include "continuum/mesh/mesh.h"
#include "discrete/files/text_file.h"
#include "coupling/panels/initial_stress.h"
#include "tests/common.h"
#include "tests/coupling/synthetic_samples.h"

namespace
{
  using namespace diptych;
  using namespace diptych::coupling;
  using namespace diptych::tests;
  using diptych::discrete::LoadingMode;

  const ContinuumSample sample{75, 50, 0.8}; // height, width of the platen, solid fraction

  // With d = 1, P = 1 and density 1 the strain rate equals the inertial number.
  Scene scene_with(const LoadingMode mode)
  {
    Scene scene;
    scene.loading.mode            = mode;
    scene.loading.inertial_number = 0.01;
    return scene;
  }

  double at(const continuum::Drive &drive, const double progress)
  {
    return drive.value ? drive.value(progress) : 0;
  }

  TEST(ContinuumLoading, DescentGoesDownByTheHeightAndSidewaysByItsRatio)
  {
    Scene scene                            = scene_with(LoadingMode::descent);
    scene.loading.horizontal_over_vertical = -0.5;
    const continuum::Loading loading       = continuum_loading(scene, sample);
    EXPECT_DOUBLE_EQ(at(loading.platens[1][0], 0.02), -0.75); // -0.5 x 75 x 0.02
    EXPECT_DOUBLE_EQ(at(loading.platens[1][1], 0.02), -1.5);
    EXPECT_EQ(at(loading.platens[0][0], 0.02), 0);
    EXPECT_EQ(loading.stages.front(), scene.loading.stage_strain);
    EXPECT_EQ(loading.stages.back(), scene.loading.axial_strain);
    EXPECT_TRUE(std::holds_alternative<continuum::SidePressure>(loading.lateral));
  }

  TEST(ContinuumLoading, ShearKeepsTheHeightAndPlaneShearCarriesPressureTimesWidth)
  {
    const continuum::Loading shear = continuum_loading(scene_with(LoadingMode::shear), sample);
    EXPECT_DOUBLE_EQ(at(shear.platens[1][0], 0.1), 7.5);
    EXPECT_FALSE(shear.platens[1][1].is_force);
    EXPECT_EQ(at(shear.platens[1][1], 0.1), 0);
    Scene scene                   = scene_with(LoadingMode::plane_shear);
    scene.loading.normal_pressure = 2;
    const continuum::Loading free = continuum_loading(scene, sample);
    EXPECT_DOUBLE_EQ(at(free.platens[1][0], 0.1), 7.5);
    EXPECT_TRUE(free.platens[1][1].is_force);
    EXPECT_DOUBLE_EQ(at(free.platens[1][1], 0.1), -100);
  }

  TEST(ContinuumLoading, VelocitiesOfATableAreIntegratedExactly)
  {
    const Folder folder;
    discrete::write_text(folder / "drive.csv", "time,velocity\n1,0\n3,4\n4,-2\n");
    discrete::write_text(folder / "early.csv", "time,velocity\n-1,1\n1,3\n");
    Scene scene                    = scene_with(LoadingMode::time);
    scene.discrete.drives.upper_x  = "velocity " + folder / "drive.csv";
    scene.discrete.drives.lower_y  = "velocity 0.5";
    scene.discrete.drives.upper_y  = "force -3";
    const continuum::Loading moved = continuum_loading(scene, sample);
    // 0 until 1; 4 (t-1)^2/4 until 3, which gives 4; the trapezium 4 -> -2 in one unit adds 1; then -2 per unit.
    for (const auto &[t, x] : {std::pair{0.5, 0.}, {2., 1.}, {3., 4.}, {3.5, 5.25}, {4., 5.}, {6., 1.}})
      EXPECT_NEAR(at(moved.platens[1][0], t), x, 1e-12) << "at time " << t;
    EXPECT_DOUBLE_EQ(at(moved.platens[0][1], 3), 1.5);
    EXPECT_TRUE(moved.platens[1][1].is_force);
    EXPECT_EQ(at(moved.platens[1][1], 7), -3);

    scene.discrete.drives.lower_x = "velocity " + folder / "early.csv"; // from the start of the loading: int_0^1 (2 + t) = 2.5
    const auto early              = continuum_loading(scene, sample).platens[0][0];
    EXPECT_NEAR(at(early, 0), 0, 1e-15);
    EXPECT_NEAR(at(early, 1), 2.5, 1e-12);
  }

  TEST(ContinuumLoading, InOtherModesAWallFollowsTheTimeOfTheProgress)
  {
    Scene scene                   = scene_with(LoadingMode::descent);
    scene.discrete.drives.lower_x = "velocity 0.2";
    // Progress 0.05 at the strain rate 0.01 is time 5.
    EXPECT_NEAR(at(continuum_loading(scene, sample).platens[0][0], 0.05), 1, 1e-12);
  }

  TEST(ContinuumLoading, SidesMoveByTheirSpeedOverTheStrainRate)
  {
    Scene scene                          = scene_with(LoadingMode::descent);
    scene.discrete.lateral.lateral       = discrete::Lateral::rigid_walls;
    const auto pressed                   = continuum_loading(scene, sample).lateral;
    scene.discrete.lateral.side_motion   = discrete::SideMotion::velocity;
    scene.discrete.lateral.side_velocity = 0.3;
    const auto moved                     = continuum_loading(scene, sample).lateral;
    scene.discrete.drives.right_x        = "velocity -0.1";
    const auto driven                    = continuum_loading(scene, sample).lateral;
    EXPECT_FALSE(std::get<continuum::RigidSides>(pressed).widening);
    EXPECT_DOUBLE_EQ(std::get<continuum::RigidSides>(moved).widening(1.), 30);
    EXPECT_DOUBLE_EQ(std::get<continuum::RigidSides>(driven).widening(1.), -10);
    scene.discrete.drives.right_x  = "auto";
    scene.discrete.lateral.lateral = discrete::Lateral::periodic;
    scene.loading.mode             = LoadingMode::time; // the progress is the time
    EXPECT_DOUBLE_EQ(*std::get<continuum::PeriodicSides>(continuum_loading(scene, sample).lateral).widening, 0.3);
    scene.discrete.lateral.side_motion = discrete::SideMotion::pressure;
    EXPECT_FALSE(std::get<continuum::PeriodicSides>(continuum_loading(scene, sample).lateral).widening);
    scene.discrete.lateral.lateral = discrete::Lateral::none;
    EXPECT_TRUE(std::holds_alternative<continuum::FreeSides>(continuum_loading(scene, sample).lateral));
  }

  // Grains of density 3 fill 0.8 of the area: 3 x 0.8 x (0.5, -2).
  TEST(ContinuumLoading, WeightFollowsFromTheGrains)
  {
    Scene scene                       = scene_with(LoadingMode::descent);
    scene.sample.density              = 3;
    scene.discrete.stepping.gravity_x = 0.5;
    scene.discrete.stepping.gravity_y = -2;
    EXPECT_LT((continuum_loading(scene, sample).body_force - Eigen::Vector2d(1.2, -4.8)).norm(), 1e-14);
  }

  TEST(ContinuumLoading, RejectsLoadingsWithoutCounterpartByTheirKey)
  {
    using Change                                              = std::function<void(Scene &)>;
    const std::vector<std::pair<std::string, Change>> refused = {
      {"discrete/drive_upper_y", [](Scene &s) { s.discrete.drives.upper_y = "velocity -1"; }},
      {"discrete/drive_upper_x", [](Scene &s) { s.loading.mode = LoadingMode::shear, s.discrete.drives.upper_x = "velocity 1"; }},
      {"discrete/drive_lower_x",
       [](Scene &s) { s.continuum.platens = continuum::Platens::smooth, s.discrete.drives.lower_x = "velocity 1"; }},
      {"loading/mode", [](Scene &s) { s.continuum.platens = continuum::Platens::smooth, s.loading.mode = LoadingMode::shear; }},
      {"discrete/drive_lower_y",
       [](Scene &s) {
         s.loading.mode            = LoadingMode::time;
         s.discrete.drives.lower_y = "force 1", s.discrete.drives.upper_y = "force -1";
       }},
      {"continuum/max_step", [](Scene &s) { s.loading.axial_strain = 100, s.continuum.min_step = s.continuum.max_step = 9e-6; }},
      {"discrete/drive_lower_y",
       [](Scene &s) { s.loading.mode = LoadingMode::plane_shear, s.discrete.drives.lower_y = "force 1"; }},
      {"discrete/drive_lower_x",
       [](Scene &s) {
         s.loading.mode            = LoadingMode::time;
         s.discrete.drives.lower_x = "force 1", s.discrete.drives.upper_x = "force -1";
       }},
      {"discrete/drive_left_x", [](Scene &s) { s.discrete.drives.left_x = "velocity 1"; }},
      {"discrete/drive_right_y", [](Scene &s) { s.discrete.drives.right_y = "velocity 1"; }},
      {"discrete/drive_right_x", [](Scene &s) { s.discrete.drives.right_x = "force -1"; }},
      {"continuum/platens", [](Scene &s) { s.discrete.lateral.lateral = discrete::Lateral::periodic; }},
      {"continuum/refinement",
       [](Scene &s) {
         s.discrete.lateral.lateral     = discrete::Lateral::periodic,
         s.discrete.lateral.side_motion = discrete::SideMotion::velocity;
         s.continuum.refinement         = continuum::Refinement::adaptive;
       }},
      {"continuum/mesh", [](Scene &s) { s.continuum.mesh = "no_such.msh"; }},
      {"continuum/element_size",
       [](Scene &s) {
         s.continuum.mesh = "rectangle", s.continuum.refinement = continuum::Refinement::adaptive;
         s.continuum.rectangle_width = s.continuum.rectangle_height = 3; // 2 x 2 elements before refinement
       }},
      {"continuum/platen_width",
       [](Scene &s) {
         s.continuum.mesh            = "rectangle";
         s.continuum.rectangle_width = s.continuum.rectangle_height = 5, s.continuum.platen_width = 6;
       }},
      {"continuum/element_size", [](Scene &s) { s.sample.grains = 60, s.continuum.element_size = 15; }},
      {"comparison/coarse_element_size", [](Scene &s) { s.sample.grains = 60, s.comparison.coarse_element_size = 100; }},
      {"continuum/mesh", [](Scene &s) { s.continuum.mesh = "somewhere"; }},
      {"continuum/initial_stress",
       [](Scene &s) { s.continuum.mesh = "rectangle", s.continuum.initial_stress = continuum::InitialStress::mapped; }}};
    EXPECT_NO_THROW(require_continuum(scene_with(LoadingMode::descent)));
    for (const auto &[key, change] : refused)
      {
        Scene scene = scene_with(LoadingMode::descent);
        change(scene);
        const std::string told = refusal<SceneError>([&] { require_continuum(scene); });
        EXPECT_EQ(told.rfind(key, 0), 0u) << key << " is not the first key of the message: " << told;
      }
  }

  TEST(ContinuumLoading, ComparisonNeedsAPlatenThatMovesInEveryStage)
  {
    const auto check   = [](const Scene &scene) { require_platen_travel(scene); };
    const auto refused = [&](const Scene &scene, const std::string &word) {
      expect_refused<SceneError>({word}, [&] { check(scene); });
    };
    Scene scene          = scene_with(LoadingMode::time);
    scene.loading.stages = {0.5, 1};
    refused(scene, "rests from time 0 to 0.5");
    scene.discrete.drives.upper_y = "velocity 0";
    refused(scene, "discrete/drive_upper_y");
    for (const char *moving : {"force -3", "velocity -0.1"})
      {
        scene.discrete.drives.upper_y = moving;
        EXPECT_NO_THROW(check(scene));
      }
    const Folder folder;
    discrete::write_text(folder / "rest.csv", "time,velocity\n0,-0.1\n0.4,-0.1\n0.45,0\n2,0\n");
    scene.discrete.drives.upper_y = "velocity " + folder / "rest.csv";
    refused(scene, "rests from time 0.5 to 1");
    scene.loading.stages = {0.3, 1};
    EXPECT_NO_THROW(check(scene));
    EXPECT_NO_THROW(check(scene_with(LoadingMode::descent)));
  }

  TEST(ContinuumLoading, MeasuresAMeshWithItsPlaten)
  {
    const ContinuumSample sample = measured(continuum::rectangle_mesh({12, 8, 4, 1}), 0.8);
    EXPECT_NEAR(sample.height, 8, 1e-12);
    EXPECT_NEAR(sample.platen_width, 4, 1e-12);
    EXPECT_EQ(sample.solid_fraction, 0.8);
  }

  // Both panels have the same loading variable and take the same time for it.
  TEST(ContinuumLoading, BothPanelsHaveTheSameLoadingVariable)
  {
    for (const auto &[mode, loading_variable] : {std::pair{LoadingMode::descent, continuum::LoadingVariable::axial_strain},
                                                 {LoadingMode::shear, continuum::LoadingVariable::shear_strain},
                                                 {LoadingMode::plane_shear, continuum::LoadingVariable::shear_strain},
                                                 {LoadingMode::time, continuum::LoadingVariable::time}})
      {
        const continuum::Loading loading = continuum_loading(scene_with(mode), sample);
        EXPECT_EQ(loading.loading_variable, loading_variable);
        EXPECT_EQ(loading.time_per_progress, mode == LoadingMode::time ? 1 : 100);
        EXPECT_EQ(discrete::name_of(discrete::loading_variable_of(mode)), continuum::name_of(loading_variable));
      }
  }

  // Nine-node cells of 1 x 1 over [0, nx] x [0, ny].
  continuum::Snapshot cells(const unsigned int nx, const unsigned int ny = 2)
  {
    continuum::Snapshot s;
    for (unsigned int j = 0; j < 2 * ny + 1; ++j)
      for (unsigned int i = 0; i < 2 * nx + 1; ++i)
        s.position.emplace_back(0.5 * i, 0.5 * j);
    s.cells = synthetic::nine_node_cells(nx, ny);
    return s;
  }

  // Two columns of two discs between platens, each carrying the force (0.3, 2) downwards. On the width of one cell this is
  // sigma_yy = 2, sigma_xy = 0.3 (force x, normal y) and sigma_yx = 0, so the symmetric part has 0.15.
  TEST(InitialStress, IsTheGrainsSymmetricStressOrThePressureWithoutGrains)
  {
    discrete::Snapshot grains;
    for (const double x : {0.5, 1.5})
      for (const double y : {0.5, 1.5})
        {
          grains.position.emplace_back(x, y);
          grains.radius.push_back(0.5);
          grains.mean_spin_term.push_back(0);
        }
    const Eigen::Vector2d force(0.3, 2);
    for (const int column : {0, 2})
      {
        const double x = column == 0 ? 0.5 : 1.5;
        grains.window_forces.push_back({column, 4, {x, 0}, {0, 1}, force});            // force of the lower platen
        grains.window_forces.push_back({column, column + 1, {x, 1}, {0, -1}, -force}); // force of the upper disc
        grains.window_forces.push_back({column + 1, 5, {x, 2}, {0, -1}, -force});      // force of the upper platen
      }
    const auto stress = grain_stress_on_cells(grains, cells(3), 7);
    ASSERT_EQ(stress.size(), 6u);
    Eigen::Matrix2d expected;
    expected << 0, 0.15, 0.15, 2;
    for (const std::size_t k : {0, 1, 3, 4})
      EXPECT_LT((stress[k] - expected).norm(), 1e-12) << "cell " << k;
    for (const std::size_t k : {2, 5}) // beside the grains
      EXPECT_LT((stress[k] - 7 * Eigen::Matrix2d::Identity()).norm(), 1e-12) << "cell " << k;
  }

  // One disc per cell, larger ones on the left; one in ten is missing. The field must follow the two halves and not the single
  // holes.
  TEST(InitialSolidFraction, FollowsTheSampleAndNotSingleGrains)
  {
    const unsigned int  n = 40;
    discrete::Snapshot  grains;
    std::mt19937        random(1);
    std::vector<double> cell_by_cell;
    for (unsigned int j = 0; j < n; ++j)
      for (unsigned int i = 0; i < n; ++i)
        {
          cell_by_cell.push_back(0);
          if (random() % 10 == 0)
            continue;
          grains.position.emplace_back(i + 0.5, j + 0.5);
          grains.radius.push_back(i < n / 2 ? 0.5 : 0.45);
          cell_by_cell.back() = M_PI * grains.radius.back() * grains.radius.back();
        }
    grains.area         = n * n;
    const auto fraction = grain_solid_fraction_on_cells(grains, cells(n, n));
    double     mean = 0, expected = 0;
    for (std::size_t k = 0; k < fraction.size(); ++k)
      mean += fraction[k] / double(n * n), expected += cell_by_cell[k] / double(n * n);
    EXPECT_NEAR(mean, expected, 1e-12);
    for (const bool left : {true, false})
      {
        double own = 0, squares = 0;
        int    cells_seen = 0;
        for (unsigned int j = 6; j < n - 6; ++j)
          for (unsigned int i = left ? 6 : n / 2 + 6; i < (left ? n / 2 - 6 : n - 6); ++i, ++cells_seen)
            own += fraction[j * n + i], squares += std::pow(fraction[j * n + i], 2);
        own /= cells_seen;
        EXPECT_NEAR(own, (left ? M_PI / 4 : 0.81 * M_PI / 4) * 0.9, 0.02) << left;
        EXPECT_LT(std::sqrt(squares / cells_seen - own * own), 0.05) << "single cells scatter by 0.24";
      }
  }
} // namespace
