// diptych: the continuum panel against published codes of others (benchmarks/referee)
// SPDX-License-Identifier: LGPL-2.1-or-later
#include "tests/continuum/continuum_scenes.h"

namespace
{
  using namespace diptych::continuum;
  using namespace diptych::continuum::tests;

  // A square of 24 x 24 between rough platens, 16 x 16 elements with 9 nodes, small strain, 40 equal steps to 2 % axial strain.
  // E = 500 and nu = 0.2 are the defaults. The pressure on the sides is 1 and falls as the height does: 1 - strain on the
  // initial shape.
  HistoryRow after_forty_steps(const LawKind law,
                               const double  dilatancy,
                               const double  cohesion,
                               const double  horizontal_over_vertical)
  {
    constexpr double side = 24, strain = 0.02;
    Options          options = perfectly_plastic(law, 30, dilatancy, cohesion);
    options                  = with_steps(with(options, Platens::rough, Kinematics::small_strain), strain / 40);
    options.tolerance        = 1e-8;
    Loading loading          = straight_loading(1, {horizontal_over_vertical * side, -side}, {strain});
    loading.side_pressure    = [](const double progress) { return 1 - progress; };
    return finished(rectangle(side, side, side / 16), loading, options).end();
  }

  // Friction 30 degrees, cohesion 0.1. Returns to the edges and to the apex of the pyramid occur near the corners.
  TEST(Published, AssociatedMohrCoulombCarriesTheForceOfSysalasCode)
  {
    const HistoryRow end = after_forty_steps(LawKind::mohr_coulomb, 30, 0.1, 0);
    EXPECT_NEAR(-end.upper_platen_force.y(), 103.959039, 1e-6);
    EXPECT_NEAR(end.volumetric_strain, -0.0293904, 1e-7);
  }

  // Dilatancy 10 degrees; the upper platen moves down at 45 degrees.
  TEST(Published, NonAssociatedMohrCoulombCarriesTheForceOfSysalasCodeAtFortyFiveDegrees)
  {
    const HistoryRow end = after_forty_steps(LawKind::mohr_coulomb, 10, 0.1, 1);
    EXPECT_NEAR(-end.upper_platen_force.y(), 94.574584, 1e-6);
    EXPECT_NEAR(end.upper_platen_force.x(), 1.70665, 1e-5);
    EXPECT_NEAR(end.volumetric_strain, -0.0016055, 1e-7);
  }

  TEST(Published, AssociatedDruckerPragerCarriesTheForceOfTheCodeOfCermakSysalaAndValdman)
  {
    const HistoryRow end = after_forty_steps(LawKind::drucker_prager, 30, 0.1, 0);
    EXPECT_NEAR(-end.upper_platen_force.y(), 103.363899977, 5e-7);
    EXPECT_NEAR(end.volumetric_strain, -0.0236368692, 1e-9);
  }
} // namespace
