// diptych: tests of the grains' fields on cells between two stages
// SPDX-License-Identifier: LGPL-2.1-or-later
#include "coupling/fields/fields.h"
#include "benchmarks/homogenisation/airy_network.h"
#include "discrete/contacts/internal_moment.h"
#include "tests/coupling/averaging/averaging_cases.h"
#include "tests/coupling/averaging/hexagonal_lattice.h"

namespace
{
  using namespace diptych::coupling::synthetic;

  // A snapshot of discs at rest with density 1. The given forces are those of the last step and of the window.
  discrete::Snapshot snapshot_of(const std::vector<Eigen::Vector2d>        &position,
                                 const std::vector<double>                 &radius,
                                 const std::vector<discrete::ContactForce> &contacts)
  {
    const std::size_t  n = position.size();
    discrete::Snapshot s;
    s.position = position;
    s.radius   = radius;
    s.displacement.assign(n, Eigen::Vector2d::Zero());
    s.velocity = s.displacement;
    s.rotation.assign(n, 0.);
    s.spin = s.mean_spin_term = s.rotation;
    s.rattler.assign(n, 0);
    for (const double r : radius)
      s.mass.push_back(M_PI * r * r);
    s.contacts = s.window_forces = contacts;
    s.window_time                = 1;
    s.mean_internal_moment       = discrete::internal_moments(position, contacts, s.mean_spin_term);
    return s;
  }

  discrete::Snapshot disordered(const std::uint64_t seed)
  {
    const auto network = benchmarks::airy_network({0, 0}, {20, 30}, benchmarks::pressure_wave(0.3, 12), seed);
    return snapshot_of(network.position, network.radius, network.contacts);
  }

  // Hexagonal lattice, 12 x rows, and cells of whole lattice periods over it.
  discrete::Snapshot hexagonal(const int rows)
  {
    const GrainNetwork network = periodic_lattice(12, rows);
    discrete::Snapshot s       = snapshot_of(network.position, network.radius, network.forces);
    s.cell_width               = 12;
    return s;
  }

  QuadMesh hexagonal_mesh(const unsigned int rows)
  {
    const double row_height = std::sqrt(3.) / 2;
    return box_mesh({-0.1, -0.5 * row_height}, {11.9, (rows - 0.5) * row_height}, 6, rows / 2);
  }

  using VectorField = std::function<Eigen::Vector2d(const Eigen::Vector2d &)>;

  discrete::Snapshot moved(const discrete::Snapshot &from, const VectorField &displacement, const double rotation = 0)
  {
    discrete::Snapshot to = from;
    for (std::size_t i = 0; i < to.position.size(); ++i)
      {
        to.displacement[i] += displacement(to.position[i]);
        to.velocity[i] = displacement(to.position[i]);
        to.rotation[i] += rotation;
      }
    return to;
  }

  // u = G x, and every disc rotates by half the curl, as the medium does. Gradient, strain and spin must be those of G to
  // round-off, and relative rotation and granular temperature zero, with every method and on every mesh.
  TEST(GrainFields, AffineMotionIsReproduced)
  {
    Eigen::Matrix2d gradient;
    gradient << 0.02, 0.05, -0.01, -0.03;
    const double             spin = 0.5 * (-0.01 - 0.05);
    const discrete::Snapshot from = disordered(1);
    const discrete::Snapshot to   = moved(
        from, [&](const Eigen::Vector2d &x) { return Eigen::Vector2d(gradient * x); }, spin);
    for_each_case([&](const AveragingOptions &options, const QuadMesh &mesh) {
      const GrainFields f       = grain_fields(mesh, from, to, options);
      int               covered = 0;
      for (std::size_t k = 0; k < mesh.cell.size(); ++k)
        if (f.covered[k])
          {
            ++covered;
            EXPECT_LT((f.displacement_gradient[k] - gradient).norm(), 1e-12);
            EXPECT_NEAR(f.shear_strain_increment[k], std::hypot(0.05, 0.04), 1e-12);
            EXPECT_NEAR(f.spin_increment[k], spin, 1e-12);
            if (!std::isnan(f.rotation_increment[k])) // for centroid: a cell without a centre
              {
                EXPECT_NEAR(f.rotation_increment[k], spin, 1e-12);
                EXPECT_NEAR(f.relative_rotation[k], 0, 1e-12);
                EXPECT_NEAR(f.granular_temperature[k], 0, 1e-24);
              }
          }
      EXPECT_GT(covered, 100);
    });
  }

  // A shear u_x = a y across the sides of a periodic sample. Every third grain is shifted by a period.
  TEST(GrainFields, ReproducesShearAtTheSidesOfAPeriodicSample)
  {
    const discrete::Snapshot from = hexagonal(20);
    discrete::Snapshot       to   = moved(from, [](const Eigen::Vector2d &x) { return Eigen::Vector2d(0.1 * x.y(), 0); });
    for (std::size_t i = 0; i < to.position.size(); i += 3)
      to.position[i].x() += 12, to.contacts.clear(), to.window_forces.clear();
    const GrainFields f = grain_fields(hexagonal_mesh(20), from, to, {});
    for (std::size_t k = 0; k < 60; ++k)
      {
        EXPECT_NEAR(f.displacement_gradient[k](0, 1), 0.1, 1e-12);
        EXPECT_NEAR(f.displacement_gradient[k](0, 0), 0, 1e-12);
        EXPECT_NEAR(f.granular_temperature[k], 0, 1e-24);
      }
  }

  // A sample whose period grew from 11.4 to 12, u = (0.05 x, 0) at the later places. Every third grain is shifted by a period.
  TEST(GrainFields, ReproducesTheStretchOfAPeriodicSample)
  {
    discrete::Snapshot from = hexagonal(20);
    for (std::size_t i = 0; i < from.position.size(); i += 3)
      from.position[i].x() += 12, from.contacts.clear(), from.window_forces.clear();
    const discrete::Snapshot to = moved(from, [](const Eigen::Vector2d &x) { return Eigen::Vector2d(0.05 * x.x(), 0); });
    from.cell_width             = 11.4;
    for (const Eigen::Matrix2d &gradient : grain_fields(hexagonal_mesh(20), from, to, {}).displacement_gradient)
      EXPECT_LT((gradient - Eigen::Vector2d(0.05, 0).asDiagonal().toDenseMatrix()).norm(), 1e-12);
  }

  // A common velocity adds to the velocity and changes nothing else.
  TEST(GrainFields, CommonVelocityChangesNothingElse)
  {
    const auto wave = [](const Eigen::Vector2d &x) { return Eigen::Vector2d(std::sin(x.x() + x.y()), std::cos(2 * x.y())); };
    const Eigen::Vector2d    common(40, -30);
    const discrete::Snapshot from = disordered(2), still = moved(from, wave);
    discrete::Snapshot       flying = still;
    for (Eigen::Vector2d &v : flying.velocity)
      v += common;
    const QuadMesh mesh = averaging_meshes()[1].mesh;
    for (const AveragingOptions &options : averaging_methods)
      {
        SCOPED_TRACE(name_of(options));
        const GrainFields a = grain_fields(mesh, from, still, options), b = grain_fields(mesh, from, flying, options);
        for (std::size_t k = 0; k < a.covered.size(); ++k)
          if (a.covered[k] && !std::isnan(a.granular_temperature[k]))
            {
              EXPECT_LT((b.velocity[k] - a.velocity[k] - common).norm(), 1e-11);
              EXPECT_NEAR(b.granular_temperature[k], a.granular_temperature[k], 1e-11);
              EXPECT_EQ(b.stress[k], a.stress[k]);
            }
      }
  }

  // Velocities are independent normal components of deviation 2 on a shear, so |v'|^2/2 has the mean 4 and the deviation 4. With
  // mass weights m of r = 0.3 .. 0.7, 600 grains count as 600 <m>^2/<m^2> = 500. Ten samples give 4/sqrt(5000), and three times
  // that is 4.2 % of the mean. Without the leverages the mean would be about 3 of 17 = 18 % too low.
  TEST(GrainFields, GranularTemperatureIsTheVarianceAboutTheAffineMotion)
  {
    std::mt19937_64 random(3);
    double          mean = 0;
    for (int sample = 1; sample <= 10; ++sample)
      {
        discrete::Snapshot s = disordered(sample);
        for (std::size_t i = 0; i < s.position.size(); ++i)
          {
            s.velocity[i] = Eigen::Vector2d(0.3 * s.position[i].y(), 5);
            for (int k = 0; k < 2; ++k)
              s.velocity[i][k] += 2 * normal(random);
          }
        mean += grain_fields(regular_grid({0, 0}, {20, 30}, 30), s, s, {}).granular_temperature[0] / 10;
      }
    EXPECT_NEAR(mean, 4, 0.042 * 4);
  }

  // Sums over cells equal those over grains: stress with and without the dynamic part, mass, solid area, contacts, dissipation.
  TEST(GrainFields, CellsAddUpToTheGrains)
  {
    std::mt19937_64    random(4);
    discrete::Snapshot s          = disordered(4);
    double             dissipated = 0, spin_term = 0, solid = 0;
    for (std::size_t k = 0; k < s.window_forces.size(); ++k)
      s.window_dissipation.push_back(uniform(random, 0, 1)), dissipated += s.window_dissipation.back();
    for (std::size_t i = 0; i < s.position.size(); ++i)
      {
        s.mean_spin_term[i] = uniform(random, 0, 0.2);
        spin_term += s.mean_spin_term[i], solid += M_PI * s.radius[i] * s.radius[i];
      }
    s.mean_internal_moment = discrete::internal_moments(s.position, s.window_forces, s.mean_spin_term);
    double ends            = 0; // number of contact ends on grains
    for (const auto &c : s.contacts)
      ends += c.j < int(s.position.size()) ? 2 : 1;

    for_each_case([&](const AveragingOptions &options, const QuadMesh &mesh) {
      const GrainFields         f    = grain_fields(mesh, s, s, options);
      const std::vector<double> area = cell_areas(mesh);
      EXPECT_LT(f.total_relative_error, 1e-12);
      EXPECT_NEAR(f.outside_share, 0, 1e-12);
      double sum_spin = 0, sum_dissipation = 0, sum_solid = 0, sum_ends = 0, count = 0;
      bool   complete = true; // true if every cell has a value
      for (std::size_t k = 0; k < area.size(); ++k)
        {
          complete = complete && f.covered[k] && !std::isnan(f.coordination_number[k]);
          sum_spin += area[k] * 0.5 * (f.contact_stress[k] - f.stress[k]).trace();
          sum_dissipation += area[k] * f.dissipation[k];
          sum_solid += area[k] * f.solid_fraction[k];
          sum_ends += f.grain_count[k] * f.coordination_number[k];
          count += f.grain_count[k];
        }
      EXPECT_NEAR(sum_solid, solid, 1e-10 * solid);
      EXPECT_NEAR(count, double(s.position.size()), 1e-9);
      if (!complete)
        return;
      EXPECT_NEAR(sum_spin, spin_term, 1e-10 * spin_term);
      EXPECT_NEAR(sum_dissipation, dissipated, 1e-10 * dissipated);
      EXPECT_NEAR(sum_ends, ends, 1e-10 * ends);
    });
  }

  // A lattice far from its ends: six contacts per grain, with normals in three directions 60 degrees apart. F = 1/2 1, the solid
  // fraction is pi / (2 sqrt 3), and there is no couple stress.
  TEST(GrainFields, HexagonalLattice)
  {
    const discrete::Snapshot s    = hexagonal(40);
    const QuadMesh           mesh = hexagonal_mesh(40);
    for (AveragingOptions options : averaging_methods)
      {
        options.width = 0.7;
        SCOPED_TRACE(name_of(options));
        const GrainFields f = grain_fields(mesh, s, s, options);
        for (std::size_t k = 9 * 6; k < 11 * 6; ++k)
          {
            EXPECT_NEAR(f.coordination_number[k], 6, 1e-8);
            EXPECT_LT((f.fabric[k] - 0.5 * Eigen::Matrix2d::Identity()).norm(), 1e-8);
            EXPECT_NEAR(f.solid_fraction[k], M_PI / (2 * std::sqrt(3.)), 1e-8);
            EXPECT_LT((f.stress[k] - std::sqrt(3.) * Eigen::Matrix2d::Identity()).norm(), 1e-7);
            EXPECT_LT(f.couple_stress[k].norm(), 1e-8);
          }
      }
  }

  // Two discs of radius r = 0.5 side by side, with a tangential force T = 3 upward on the left one. (x_c - x) x f = (0.5 - x) T,
  // with x from the left centre and ds = dx. This gives -T r^2/2 on the left half and +T r^2/2 on the right half, each in a cell
  // of area 4.
  TEST(GrainFields, CoupleStressOfATangentialForce)
  {
    discrete::ContactForce c{0, 1, {2, 1}, {-1, 0}, {0, 3}};
    const auto             s = snapshot_of({{1.5, 1}, {2.5, 1}}, {0.5, 0.5}, {c});
    const GrainFields      f = grain_fields(box_mesh({0, 0}, {4, 2}, 2, 1), s, s, {});
    EXPECT_NEAR(f.couple_stress[0].x(), -3 * 0.125 / 4, 1e-14);
    EXPECT_NEAR(f.couple_stress[1].x(), 3 * 0.125 / 4, 1e-14);
    EXPECT_NEAR(f.couple_stress[0].y(), 0, 1e-14);
  }

  // Three cells of 6 x 6: two are full of discs on a square lattice (solid fraction pi/4). One has a single disc and is less than
  // half as dense as the sample.
  TEST(GrainFields, CellsWithLittleCoverHaveNoValue)
  {
    std::vector<Eigen::Vector2d> position;
    for (int x = 0; x < 12; ++x)
      for (int y = 0; y < 6; ++y)
        position.emplace_back(x + 0.5, y + 0.5);
    position.emplace_back(15, 3);
    const auto        s = snapshot_of(position, std::vector<double>(73, 0.5), {{0, 1, {0.5, 1}, {0, -1}, {0, -1}}});
    const GrainFields f = grain_fields(box_mesh({0, 0}, {18, 6}, 3, 1), s, s, {});
    EXPECT_TRUE(f.covered[0] && f.covered[1] && !f.covered[2]);
    EXPECT_FALSE(std::isnan(f.velocity[0].x()));
    EXPECT_TRUE(std::isnan(f.velocity[2].x()) && std::isnan(f.stress[2](0, 0)) && std::isnan(f.standard_error[2]));
    EXPECT_NEAR(f.solid_fraction[2], M_PI / 4 / 36, 1e-12);
    EXPECT_NEAR(f.grain_count[0], 36, 1e-12);
    EXPECT_TRUE(std::isnan(f.dissipation[0])); // unknown, because the snapshot has no dissipation for its forces
  }

  // The grains' pressure moments are independent random numbers of deviation 1. The scatter of a cell's mean over 100
  // realisations must equal their average standard error. The tolerance is three times 1/sqrt(2 x 99) = 7 % of a measured
  // deviation.
  TEST(GrainFields, StandardErrorIsTheScatterOfIndependentGrains)
  {
    discrete::Snapshot s = disordered(5);
    s.contacts.clear(), s.window_forces.clear();
    const QuadMesh mesh   = regular_grid({0, 0}, {20, 30}, 5);
    constexpr int  n_runs = 100, cell = 2 * 4 + 1; // a cell away from the edge
    for (const AveragingOptions &options : averaging_methods)
      {
        std::mt19937_64 random(6);
        double          sum = 0, squares = 0, error = 0, norm_error = 0;
        for (int run = 0; run < n_runs; ++run)
          {
            for (std::size_t i = 0; i < s.position.size(); ++i)
              {
                const double pressure     = -std::log(1 - uniform(random, 0, 1)); // exponential: mean and deviation 1
                s.mean_spin_term[i]       = -pressure; // enters the stress with the factor -1, distributed like grains
                s.mean_internal_moment[i] = pressure * Eigen::Matrix2d::Identity();
              }
            const GrainFields f = grain_fields(mesh, s, s, options);
            const double      p = 0.5 * f.stress[cell].trace();
            sum += p, squares += p * p;
            error += f.standard_error[cell], norm_error += f.stress_standard_error[cell];
          }
        const double mean = sum / n_runs, deviation = std::sqrt((squares / n_runs - mean * mean) * n_runs / (n_runs - 1.));
        EXPECT_NEAR(error / n_runs / deviation, 1, 0.21) << name_of(options);
        EXPECT_NEAR(norm_error / error, std::sqrt(2.), 1e-12); // |p 1| = p sqrt 2
      }
  }

  TEST(GrainFields, RejectsSnapshotsOfDifferentGrains)
  {
    const discrete::Snapshot s     = disordered(6);
    discrete::Snapshot       fewer = s;
    fewer.rotation.pop_back();
    EXPECT_THROW((void)grain_fields(averaging_meshes()[0].mesh, fewer, s, {}), std::invalid_argument);
  }
} // namespace
