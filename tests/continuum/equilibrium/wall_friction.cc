// diptych: friction along platens and walls: limits, sliding block, slip zone of a strip, reversal, ledger
// SPDX-License-Identifier: LGPL-2.1-or-later
#include "tests/continuum/continuum_scenes.h"

namespace
{
  using namespace diptych::continuum;
  using namespace diptych::continuum::tests;

  Options frictional(Options options, const double friction, const double slip_length, const Kinematics geometry)
  {
    options.platen_friction    = friction;
    options.platen_slip_length = slip_length;
    return with_steps(with(options, Platens::frictional, geometry), 1e-3);
  }

  // No friction is smooth, also for an endless slip length. Large friction without slip is rough.
  TEST(WallFriction, HasSmoothAndRoughPlatensAsLimits)
  {
    const QuadMesh mesh    = rectangle(12, 16, 2.);
    const Loading  loading = straight_loading(1, {0, -16}, {0.01});
    const auto     force  = [&](const Options &options) { return finished(mesh, loading, options).end().upper_platen_force.y(); };
    const auto     plain  = [](const Platens platens) { return with_steps(with({}, platens, Kinematics::updated), 1e-3); };
    const double   smooth = force(plain(Platens::smooth)), rough = force(plain(Platens::rough));
    EXPECT_GT(rough / smooth, 1.05);
    EXPECT_EQ(force(frictional({}, 0, 10, Kinematics::updated)), smooth);
    EXPECT_NEAR(force(frictional({}, 0.3, 1e9, Kinematics::updated)) / smooth, 1, 1e-6);
    EXPECT_NEAR(force(frictional({}, 1e3, 0, Kinematics::updated)) / rough, 1, 1e-6);
  }

  // An elastic block under F between platens, of which the upper one moves to the right and back. The block soon slides: both
  // platens slip by half of the motion, H/2 per unit progress, so T/F = mu tanh(H/2 / (mu L)); mu for L = 0. The traction
  // reverses with the motion. For L = 0 friction takes T times the travel, less the shear of the block, which it has once
  // before it slides and twice at the reversal.
  TEST(WallFriction, BlockSlidesAndSlidesBack)
  {
    constexpr double H = 4, F = 12, mu = 0.3;
    const QuadMesh   mesh    = rectangle(12, H, 1.);
    Loading          loading = straight_loading(1, {0, 0}, {0.01, 0.02});
    loading.loading_variable = LoadingVariable::shear_strain;
    loading.platens[1]       = {Drive{false, [](const double p) { return H * std::min(p, 0.02 - p); }}, force(-F)};
    for (const double L : {0., 10.})
      {
        const Course c     = finished(mesh, loading, frictional(elastic(), mu, L, Kinematics::small_strain));
        const double work  = c.end().friction_work;
        const double T     = L > 0 ? mu * std::tanh(H / 2 / (mu * L)) * F : mu * F;
        const auto  &there = c.snapshots[0], &back = c.snapshots[1];
        EXPECT_NEAR(there.upper_platen_force.x(), T, 2e-3 * T) << L;
        EXPECT_NEAR(there.lower_platen_force.x(), -T, 2e-3 * T) << L;
        EXPECT_NEAR(back.upper_platen_force.x(), -T, 2e-3 * T) << L;
        if (L == 0)
          {
            Loading little    = loading;
            little.stages     = {1e-4};
            const Course held = finished(mesh, little, with(elastic(), Platens::rough, Kinematics::small_strain));
            const double bow  = T / held.end().upper_platen_force.x() * 1e-4 * H;
            EXPECT_NEAR(work / (T * (2 * 0.01 * H - 3 * bow)), 1, 0.02);
          }
      }
  }

  // Thin elastic strip of width W and height H under uniform strain e. In a slip zone at each end a slice is in equilibrium if
  // H d s_xx/dx = 2 mu s_yy, with s_yy = s_e + n (s_xx - P), n = nu/(1 - nu), s_e = P + E/(1 - nu^2) e. So s_yy = s_e exp(k x),
  // k = 2 mu n/H, at the distance x from the end, until nothing stretches: s_xx - P = n (s_yy - P), where s_yy = s_m =
  // (s_e - n^2 P)/(1 - n^2). The middle sticks.
  TEST(WallFriction, StripSlipsAtItsEnds)
  {
    constexpr double W = 60, H = 2, mu = 0.02, e = 2e-3, P = 1;
    const Options    options = frictional(elastic(), mu, 0, Kinematics::small_strain);
    const double     nu = options.material.elastic.poisson_ratio, n = nu / (1 - nu), k = 2 * mu * n / H;
    const double     s_e  = P + options.material.elastic.youngs_modulus / (1 - nu * nu) * e;
    const double     s_m  = (s_e - n * n * P) / (1 - n * n);
    const double     zone = std::log(s_m / s_e) / k;
    const double     more = 2 * s_e * std::expm1(k * zone) / k + s_m * (W - 2 * zone) - s_e * W; // than between smooth platens
    EXPECT_GT(zone, 3 * H);
    EXPECT_LT(zone, W / 2 - 2 * H);
    const Course c = finished(rectangle(W, H, 0.5), straight_loading(P, {0, -H}, {e}), options);
    EXPECT_NEAR((-c.end().upper_platen_force.y() - s_e * W) / more, 1, 0.03);
  }

  // Smooth platens, walls at a given width: the sample is compressed by e, and s_yy and s_xx are uniform without friction. The
  // walls slip by e y, which carries mu s_xx over the height at the wall.
  TEST(WallFriction, WallsHoldTheSampleUp)
  {
    constexpr double W = 8, H = 16, mu = 0.2, e = 2e-3;
    Loading          loading = straight_loading(1, {0, -H}, {e});
    loading.lateral          = RigidSides{[](double) { return 0.; }};
    const Course c           = finished(rectangle(W, H, 1.), loading, frictional(elastic(), mu, 0, Kinematics::small_strain));
    const double lower = c.end().lower_platen_force.y(), upper = -c.end().upper_platen_force.y();
    // The walls push the sample up with mu s_xx, which is between its values at the two platens.
    EXPECT_GT(upper - lower, mu * 2 * H * 1.);
    EXPECT_LT(upper - lower, mu * 2 * H * upper / W);
  }

  // Cells, state and friction work of a resumed run are those of an uninterrupted one.
  TEST(WallFriction, ResumesWithTheSameBits)
  {
    const QuadMesh mesh    = rectangle(12, 16, 2.);
    const Loading  loading = straight_loading(1, {8, -16}, {0.004, 0.008});
    const Options  options = frictional({}, 0.2, 12, Kinematics::updated);
    const Course   whole   = finished(mesh, loading, options);
    Wishes         wishes;
    wishes.stop_requested = [](const std::size_t n_rows) { return n_rows >= 4; };
    const Course half     = course(mesh, loading, options, wishes);
    const Course rest     = resumed(mesh, loading, options, half.checkpoint);
    EXPECT_EQ(rest.end().upper_platen_force, whole.end().upper_platen_force);
    EXPECT_EQ(rest.end().friction_work, whole.end().friction_work);
    EXPECT_GT(whole.end().friction_work, 0);
  }

  // Divided elements next to the platens: the force agrees with that on a mesh that is fine everywhere.
  TEST(WallFriction, AdaptiveMeshHasTheForceOfAFineOne)
  {
    const Loading loading = straight_loading(1, {0, -16}, {0.01});
    Options       fine    = frictional({}, 0.2, 12, Kinematics::updated);
    fine.weak_spot_strain = 0.05;
    Options      coarse   = adaptive(fine);
    const double expected = finished(rectangle(12, 16, 1.), loading, fine).end().upper_platen_force.y();
    const Course c        = finished(rectangle(12, 16, 2.), loading, coarse);
    EXPECT_GT(c.end().n_cells, 48);
    EXPECT_NEAR(c.end().upper_platen_force.y() / expected, 1, 0.02);
  }
} // namespace
