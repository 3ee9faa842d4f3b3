// diptych: many panels in one process: each as in a process of its own, none leaves memory behind
// SPDX-License-Identifier: LGPL-2.1-or-later
#include <fstream>

#include <unistd.h>

#include <gtest/gtest.h>

#include "tests/continuum/continuum_scenes.h"

namespace
{
  using namespace diptych::continuum;
  using namespace diptych::continuum::tests;

  // Memory of this process that it holds now [bytes].
  double held_memory()
  {
    std::ifstream in("/proc/self/statm");
    double        pages = 0, resident = 0;
    in >> pages >> resident;
    return resident * double(::sysconf(_SC_PAGESIZE));
  }

  Course one(const int k)
  {
    Options options = with_steps({}, 2e-3);
    options.law     = k % 3 == 0 ? LawKind::cosserat_mohr_coulomb : k % 3 == 1 ? LawKind::mohr_coulomb : LawKind::drucker_prager;
    options.material.friction_angle_peak = 18 + k % 5;
    options.linear_solver                = k % 4 == 3 ? LinearChoice::amg : LinearChoice::direct;
    options.refinement                   = k % 2 ? Refinement::adaptive : Refinement::uniform;
    options.refinement_threshold         = 0.5;
    return course(rectangle(24, 24, 3.), straight_loading(1, {24, -24}, {0, 0.012}), options);
  }

  // The 60th panel with the parameters of the first is the first, which was made in a fresh process.
  TEST(ManyPanels, GiveTheBitsOfAFreshProcessAndKeepNoMemory)
  {
    const Course fresh  = one(0);
    double       before = 0;
    for (int k = 1; k < 60; ++k)
      {
        const Course c = one(k);
        ASSERT_EQ(c.report.status, Status::finished) << k << ": " << c.report.message;
        if (k == 11)
          before = held_memory();
      }
    const double grown = held_memory() - before;
    const Course again = one(60);
    ASSERT_EQ(again.rows.size(), fresh.rows.size());
    for (std::size_t k = 0; k < fresh.rows.size(); ++k)
      {
        EXPECT_EQ(again.rows[k].mean_stress, fresh.rows[k].mean_stress);
        EXPECT_EQ(again.rows[k].upper_platen_force, fresh.rows[k].upper_platen_force);
      }
    EXPECT_EQ(again.snapshots.back().position, fresh.snapshots.back().position);
    EXPECT_LT(grown, 8e6) << "of " << before << " bytes after 11 panels";
  }

  // Two panels side by side, one of them on a communicator of its own, walk as each alone.
  TEST(ManyPanels, DoNotKnowOfEachOther)
  {
    const QuadMesh mesh    = rectangle(14, 20, 4.);
    const Loading  loading = straight_loading(1, {20, -20}, {0.002, 0.004});
    Options        soft = with_steps({}, 1e-3), stiff = soft;
    stiff.material.elastic.youngs_modulus = 2000;
    MPI_Comm own;
    MPI_Comm_dup(MPI_COMM_SELF, &own);
    {
      Panel a(mesh, Units(), loading, soft), b(mesh, Units(), loading, stiff, {}, own);
      EXPECT_EQ(a.prepare(), Status::finished);
      EXPECT_EQ(b.prepare(), Status::finished);
      for (const int stage : {1, 2})
        {
          EXPECT_EQ(a.advance_to(stage), Status::finished);
          EXPECT_EQ(b.advance_to(stage), Status::finished);
        }
      EXPECT_EQ(a.snapshot().mean_stress, finished(mesh, loading, soft).snapshots.back().mean_stress);
      EXPECT_EQ(b.snapshot().mean_stress, finished(mesh, loading, stiff).snapshots.back().mean_stress);
      EXPECT_NE(a.snapshot().mean_stress, b.snapshot().mean_stress);
    }
    MPI_Comm_free(&own);
  }
} // namespace
