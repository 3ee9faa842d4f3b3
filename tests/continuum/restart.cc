// diptych: a course interrupted and taken up again is the course that was not
// SPDX-License-Identifier: LGPL-2.1-or-later
#include <gtest/gtest.h>

#include "continuum/problem_checkpoint.h"
#include "continuum/sample_state.h"
#include "tests/continuum/problem_scenes.h"

namespace
{
  using namespace diptych::continuum;
  using namespace diptych::continuum::tests;

  struct CheckpointFile
  {
    std::string path = temporary_path(".h5");
    ~CheckpointFile() { std::filesystem::remove(path); }
  };

  Options options_of(const std::string &law, const bool adaptive)
  {
    Options options = with_steps({}, 1e-3);
    options.law     = law;
    if (adaptive)
      {
        options.refinement           = "adaptive";
        options.refinement_threshold = 0.5;
      }
    return options;
  }

  void expect_same_end(const HistoryRow &a, const HistoryRow &b)
  {
    EXPECT_EQ(a.axial_strain, b.axial_strain);
    EXPECT_EQ(a.step, b.step);
    EXPECT_EQ(a.n_cells, b.n_cells);
    EXPECT_NEAR(a.stress_ratio, b.stress_ratio, 1e-4 * b.stress_ratio);
    EXPECT_NEAR((a.upper_platen_force - b.upper_platen_force).norm(), 0, 1e-4 * b.upper_platen_force.norm());
    EXPECT_NEAR(a.volumetric_strain, b.volumetric_strain, 1e-4 * std::abs(b.volumetric_strain) + 1e-7);
    EXPECT_NEAR(a.dissipation, b.dissipation, 1e-4 * b.dissipation);
    EXPECT_NEAR(a.max_equivalent_plastic_strain, b.max_equivalent_plastic_strain, 1e-3 * b.max_equivalent_plastic_strain);
  }

  // Through the problem itself: half the way, put down, taken up by a fresh problem, the other half. The state comes back bit by
  // bit, side contact and divided elements included.
  TEST(Restart, TakesUpTheStateBitByBit)
  {
    const MeshFile mesh(24, 24, 4.);
    const Loading  loading = straight_loading(1, {24, -24}, {1});
    for (const bool adaptive : {false, true})
      for (const std::string law : {"cosserat_mohr_coulomb", "mohr_coulomb"})
        {
          const Options        options = options_of(law, adaptive);
          BoundaryValueProblem whole(mesh.path, 1., loading, options);
          LoadDriver           driver(whole, options);
          ASSERT_EQ(driver.equilibrate(), "");
          ASSERT_EQ(driver.advance(0.008, [] { return true; }), "");
          const Checkpoint checkpoint = make_checkpoint(whole, driver);

          BoundaryValueProblem fresh(mesh.path, 1., loading, options);
          LoadDriver           second(fresh, options);
          restore(checkpoint, fresh, second);
          EXPECT_EQ(fresh.progress(), whole.progress());
          EXPECT_EQ(fresh.committed().displacement, whole.committed().displacement);
          EXPECT_EQ(second.state().last_increment, driver.state().last_increment);
          ASSERT_EQ(fresh.committed().points.size(), whole.committed().points.size());
          for (std::size_t k = 0; k < fresh.committed().points.size(); ++k)
            EXPECT_EQ((fresh.committed().points[k].stress - whole.committed().points[k].stress).norm(), 0);
          if (adaptive)
            {
              EXPECT_GT(whole.discretisation().cells.size(), 36u);
            }
          for (auto *one : {&driver, &second})
            ASSERT_EQ(one->advance(0.016, [] { return true; }), "");
          expect_same_end(make_history_row(fresh, second), make_history_row(whole, driver));
        }
  }

  // Through files: stopped on request after some steps, resumed: only what is new is told, and the end is that of the course that
  // was not interrupted.
  TEST(Restart, AResumedRunEndsAsTheUninterruptedOne)
  {
    const MeshFile       mesh(24, 24, 4.);
    const Loading        loading = straight_loading(1, {24, -24}, {0, 0.004, 0.012});
    const Options        options = options_of("cosserat_mohr_coulomb", true);
    const Course         whole   = finished(mesh.path, loading, options);
    const CheckpointFile file;
    Callbacks            callbacks;
    callbacks.checkpoint_file = file.path;
    int asked                 = 0;
    callbacks.stop_requested  = [&] { return ++asked == 7; };
    const Course first        = course(mesh.path, loading, options, callbacks);
    EXPECT_EQ(first.report.status, Status::stopped_by_user);
    ASSERT_EQ(first.rows.size(), 7u);
    callbacks.stop_requested = {};
    callbacks.resume         = true;
    const Course second      = course(mesh.path, loading, options, callbacks);
    ASSERT_EQ(second.report.status, Status::finished) << second.report.message;
    EXPECT_EQ(first.rows.size() + second.rows.size(), whole.rows.size());
    EXPECT_EQ(second.rows.front().step, first.rows.back().step + 1);
    ASSERT_EQ(second.snapshots.size(), 1u) << "only the last stage was still to come";
    EXPECT_EQ(second.snapshots[0].axial_strain, 0.012);
    EXPECT_EQ(second.report.steps, whole.report.steps);
    EXPECT_EQ(second.report.localisation_strain.has_value(), whole.report.localisation_strain.has_value());
    expect_same_end(second.end(), whole.end());
  }

  TEST(Restart, AForeignCheckpointIsRefused)
  {
    const MeshFile       mesh(8, 8, 2.), other_mesh(8, 8, 4.);
    const Loading        loading = straight_loading(1, {8, -8}, {0.002});
    const Options        options = options_of("mohr_coulomb", false);
    const CheckpointFile file;
    Callbacks            callbacks;
    callbacks.checkpoint_file = file.path;
    callbacks.stop_requested  = [] { return true; };
    (void)run(mesh.path, 1., loading, options, callbacks);
    ASSERT_TRUE(std::filesystem::exists(file.path));
    callbacks.stop_requested = {};
    callbacks.resume         = true;
    Options softer           = options;
    softer.material.elastic.youngs_modulus /= 2;
    Loading squeezed     = loading;
    squeezed.pressure    = 2;
    Loading faster       = loading;
    faster.platens[1][0] = travel(9);
    EXPECT_THROW((void)run(mesh.path, 1., loading, softer, callbacks), std::runtime_error);
    EXPECT_THROW((void)run(mesh.path, 1., squeezed, options, callbacks), std::runtime_error);
    EXPECT_THROW((void)run(mesh.path, 1., faster, options, callbacks), std::runtime_error);
    EXPECT_THROW((void)run(mesh.path, 2., loading, options, callbacks), std::runtime_error);
    EXPECT_THROW((void)run(other_mesh.path, 1., loading, options, callbacks), std::runtime_error);
    Loading further          = loading; // what may change: where it ends, and how often it is put down
    further.stages           = {0.003};
    Options rarer            = options;
    rarer.checkpoint_minutes = 99;
    EXPECT_EQ(run(mesh.path, 1., further, rarer, callbacks).status, Status::finished);
  }

  // Two platens that differ nowhere but between the places where a table of a few values would look.
  TEST(Restart, FingerprintsTellDrivesApart)
  {
    const MeshFile mesh(8, 8, 4.);
    Loading        plain = straight_loading(1, {0, -8}, {0.02}), wavy = plain;
    wavy.platens[1][1].value = [](const double t) { return -8 * t + (t > 0.002 && t < 0.008 ? 1e-3 : 0.); };
    EXPECT_EQ(fingerprint(mesh.path, 1., plain, {}), fingerprint(mesh.path, 1., straight_loading(1, {0, -8}, {0.03}), {}));
    EXPECT_NE(fingerprint(mesh.path, 1., plain, {}), fingerprint(mesh.path, 1., wavy, {}));
  }
} // namespace
