// diptych: tests of the stress of a periodic sample on cells
// SPDX-License-Identifier: LGPL-2.1-or-later
#include "coupling/averaging/periodic.h"
#include "tests/coupling/synthetic_samples.h"

namespace
{
  using namespace diptych;
  using namespace diptych::coupling;

  // Cells of 1 x 1 over [0, nx] x [0, ny].
  QuadMesh cells(const unsigned int nx, const unsigned int ny)
  {
    return synthetic::box_mesh({0, 0}, {nx, ny}, nx, ny);
  }

  // n discs of diameter 1 side by side at half height, all pressed by `force`. The last one touches the first across the edge.
  // `drift`: displacement of the first disc out of the cell.
  discrete::Snapshot ring(const int n, const double force, const double drift)
  {
    discrete::Snapshot s;
    s.cell_width = n;
    for (int i = 0; i < n; ++i)
      {
        s.position.emplace_back(i + 0.25 + (i == 0 ? drift : 0), 0.5);
        s.radius.push_back(0.5);
        s.mean_spin_term.push_back(0);
      }
    for (int i = 0; i < n; ++i)
      {
        discrete::ContactForce c;
        c.i = i, c.j = (i + 1) % n;
        c.shift  = std::round((s.position[i].x() + 1 - s.position[c.j].x()) / n) * n;
        c.point  = s.position[i] + Eigen::Vector2d(0.5, 0);
        c.normal = {-1, 0};
        c.force  = {-force, 0};
        s.window_forces.push_back(c);
      }
    return s;
  }

  // A force f across every vertical section of height 1 gives sigma_xx = f in every cell, whatever the period of a grain's
  // abscissa.
  TEST(PeriodicMapping, RingOfDiscsHasUniformStress)
  {
    const QuadMesh mesh = cells(6, 1);
    for (const double drift : {0., -6., 6., -24., 600.})
      {
        const MappedGrains mapped = map_grains(mesh, ring(6, 3, drift));
        for (const Eigen::Matrix2d &stress : cell_stress(mesh, mapped.moment))
          {
            EXPECT_NEAR(stress(0, 0), 3, 1e-12) << "drift " << drift;
            EXPECT_NEAR(stress(1, 1), 0, 1e-12);
          }
        EXPECT_NEAR(mapped.moment.outside_share, 0, 1e-12);
        EXPECT_TRUE(mapped.has_collar);
        EXPECT_LT(mapped.nodal_residual, 1e-13);
      }
  }

  // Six discs of area pi/4 in six cells of area 1; half of the first one lies outside on the left.
  TEST(PeriodicMapping, DiscsCoverBothSidesOfTheEdge)
  {
    for (const double drift : {0., -6., 60.})
      {
        const CellCover cover = grain_cover(cells(6, 1), ring(6, 1, drift));
        int             count = 0;
        for (std::size_t k = 0; k < 6; ++k)
          {
            EXPECT_NEAR(cover.solid_fraction[k], M_PI / 4, 1e-12) << "drift " << drift;
            count += cover.grain_count[k];
          }
        EXPECT_EQ(count, 6) << "drift " << drift;
      }
  }
} // namespace
