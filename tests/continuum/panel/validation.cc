// diptych: the continuum panel against closed forms and published codes of others
// SPDX-License-Identifier: LGPL-2.1-or-later
#include <numeric>

#include "continuum/laws/material_point.h"
#include "tests/continuum/continuum_scenes.h"
#include "tests/continuum/problem_scenes.h"

namespace
{
  using namespace diptych::continuum::tests;

  constexpr double E = 500, nu = 0.2, G = E / (2 * (1 + nu)); // defaults of ElasticOptions

  const std::vector<std::pair<LawKind, Displacement>> plastic_elements = {
    {LawKind::mohr_coulomb, Displacement::q2},           {LawKind::mohr_coulomb, Displacement::q1_bbar},
    {LawKind::drucker_prager, Displacement::q2},         {LawKind::drucker_prager, Displacement::q1_bbar},
    {LawKind::cosserat_mohr_coulomb, Displacement::q2},  {LawKind::cosserat_drucker_prager, Displacement::q2},
    {LawKind::gradient_drucker_prager, Displacement::q2}};

  bool is_cone(const LawKind law)
  {
    return law == LawKind::drucker_prager || law == LawKind::cosserat_drucker_prager || law == LawKind::gradient_drucker_prager;
  }

  Options one_element(const std::pair<LawKind, Displacement> &kind, const double dilatancy, const double cohesion)
  {
    Options options   = perfectly_plastic(kind.first, 30, dilatancy, cohesion);
    options.element   = kind.second;
    options.platens   = Platens::smooth;
    options.tolerance = 1e-9;
    return options;
  }

  // Plane strain between smooth platens: s1 = s3 Kp + 2 c sqrt(Kp), Kp = (1 + sin phi)/(1 - sin phi) = 3 at 30 degrees. At s3 =
  // 1 this is 3 + 0.2 sqrt 3 = 3.346410 and 3 + 0.02 sqrt 3 = 3.034641.
  TEST(Validation, OneElementReachesTheClosedFormStrengthInSmallStrainAndOnTheMovedShape)
  {
    const QuadMesh mesh = rectangle(1, 1, 1.);
    for (const Kinematics geometry : {Kinematics::small_strain, Kinematics::updated})
      for (const auto &kind : plastic_elements)
        for (const auto &[cohesion, expected] : {std::pair{0.1, 3.346410}, std::pair{0.01, 3.034641}})
          for (const double dilatancy : {0., 10., 30.})
            {
              if (is_cone(kind.first) && dilatancy < 30)
                continue;
              Options options  = one_element(kind, dilatancy, cohesion);
              options.geometry = geometry;
              SCOPED_TRACE(name_of(kind.first) + ", " + name_of(kind.second) + ", c " + std::to_string(cohesion) + ", psi " +
                           std::to_string(dilatancy) + ", " + name_of(geometry));
              const Course c = finished(mesh, straight_loading(1, {0, -1}, {0.05}), options);
              EXPECT_NEAR(c.end().mean_stress(0, 0), 1, 1e-6);
              EXPECT_NEAR(c.end().mean_stress(1, 1), expected, 3e-6);
            }
  }

  // On the plateau all strain is plastic: d eps_v/d gamma = -sin psi with d eps_v = d e1 + d e3, d gamma = d e1 - d e3. Hence
  // the volume grows by d eps_v/d e1 = -2 sin psi/(1 - sin psi), in logarithmic strains: -0.4202 at psi = 10.
  TEST(Validation, OneElementDilatesByItsAngle)
  {
    const QuadMesh mesh = rectangle(1, 1, 1.);
    for (const auto &kind : plastic_elements)
      {
        const Course c = finished(mesh, straight_loading(1, {0, -1}, {0.1, 0.12}), with_steps(one_element(kind, 10, 0.01), 5e-4));
        const double lower = c.snapshots[0].area, upper = c.snapshots[1].area;
        const double sine = std::sin(10 * M_PI / 180);
        EXPECT_NEAR(std::log(upper / lower) / -std::log(0.88 / 0.90), 2 * sine / (1 - sine), 2e-5)
          << name_of(kind.first) << ", " << name_of(kind.second);
      }
  }

  // Smooth platens, constant angles: a material point gives the exact stress and volume, the platen force is its axial stress
  // times its present width. Half the step leaves a quarter of the error in force and volume.
  TEST(Validation, ForceAndVolumeAreOfSecondOrderInTheStep)
  {
    const Options             options = one_element({LawKind::mohr_coulomb, Displacement::q2}, 10, 0.01);
    const PointPath           path    = named_path(NamedPath::drained, {1., 0.2, 1e-3});
    const MaterialPointReport exact   = drive_material_point(options.law, options.material, {}, path);
    const MaterialPointRow   &end     = exact.rows.back();
    const double              force   = end.syy * (1 - end.lateral_strain);
    double                    before[2]{};
    for (const double step : {0.02, 0.01, 0.005, 0.0025})
      {
        const HistoryRow row =
          finished(rectangle(1, 1, 1.), straight_loading(1, {0, -1}, {0.2}), with_steps(options, step)).end();
        const double error[2] = {-row.upper_platen_force.y() / force - 1, row.volumetric_strain / end.volumetric_strain - 1};
        for (const unsigned int k : {0u, 1u})
          {
            if (step < 0.02)
              {
                EXPECT_NEAR(before[k] / error[k], 4, 0.3) << step << ", " << error[k];
              }
            before[k] = error[k];
          }
      }
    EXPECT_LT(std::abs(before[0]), 2e-5);
    EXPECT_LT(std::abs(before[1]), 2e-4);
  }

  // Elastic plane strain at constant lateral pressure: d s_yy = E/(1 - nu^2) d eps, to first order in the strain.
  TEST(Validation, ElasticPlaneStrainModulus)
  {
    const QuadMesh mesh = rectangle(2, 3, 1.);
    for (const Kinematics geometry : {Kinematics::updated, Kinematics::small_strain})
      for (const Displacement element : {Displacement::q2, Displacement::q1_bbar})
        {
          Options options = with(elastic(), Platens::smooth, geometry);
          options.element = element;
          const Course c  = finished(mesh, straight_loading(1, {0, -3}, {1e-4}), options);
          EXPECT_NEAR((c.end().mean_stress(1, 1) - 1) / 1e-4, E / (1 - nu * nu), 1e-3 * E)
            << name_of(geometry) << ", " << name_of(element);
        }
  }

  // The two geometries differ by the strain times the stress. In a run from elastic to plastic this is less than 1 % at 0.2 %
  // strain, and more at 8 %.
  TEST(Validation, GeometriesAgreeAtSmallStrainOnly)
  {
    const QuadMesh mesh    = rectangle(12, 20, 4.);
    const Loading  loading = straight_loading(1, {20, -20}, {0.002, 0.08});
    const Options  options = perfectly_plastic(LawKind::mohr_coulomb, 25, 0, 0.05);
    const Course   updated = finished(mesh, loading, with(options, Platens::rough, Kinematics::updated)),
                 small     = finished(mesh, loading, with(options, Platens::rough, Kinematics::small_strain));
    const auto difference  = [&](const std::size_t k) {
      const Eigen::Vector2d a = updated.snapshots[k].upper_platen_force, b = small.snapshots[k].upper_platen_force;
      return (a - b).norm() / b.norm();
    };
    EXPECT_LT(difference(0), 0.01);
    EXPECT_GT(difference(1), 0.02);
  }

  // Elastic Cosserat layer, omega = 0 at both walls: G_eff/G = 1/(1 - 2 Gc tanh(lam H/2)/((G + Gc) lam H)), with lam^2 = 4 G
  // Gc/ (M (G + Gc)), Gc = G/2 and M = 2 G l^2: lam = sqrt(2/3)/l. With H = 20 l: 1/(1 - 2/3 x 1/16.3299 x tanh(8.165)) =
  // 1.042562. With free rotations there is no layer at the walls, and the stiffness is that of the classical continuum.
  TEST(Validation, ElasticCosseratLayerIsStiffened)
  {
    const QuadMesh mesh                 = rectangle(0.5, 20, 0.25);
    Options        options              = perfectly_plastic(LawKind::cosserat_mohr_coulomb, 30, 0, 1e6);
    options.material.couple_shear_ratio = 0.5;
    options.material.internal_length    = 1;
    options.tolerance                   = 1e-8;
    const Loading loading               = with_sides(straight_loading(1, {20, 0}, {1e-3}), PeriodicSides{0.});
    for (const auto &[rotation, expected] : {std::pair{PlatenRotation::held, 1.042562}, std::pair{PlatenRotation::free, 1.}})
      for (const Kinematics geometry : {Kinematics::small_strain, Kinematics::updated})
        {
          options.platen_rotation = rotation;
          options.geometry        = geometry;
          const Course c          = finished(mesh, loading, with_steps(options, 1e-3));
          EXPECT_NEAR(c.end().upper_platen_force.x() / (0.5 * G * 1e-3), expected, 1e-4)
            << name_of(rotation) << ", " << name_of(geometry);
        }
  }

  // Hypoelastic simple shear to gamma = 1, where the stress rotates with the spin (Jaumann): s_xy = G sin gamma, s_xx = -s_yy =
  // G (1 - cos gamma), tension positive. Steps of d gamma have a first-order error of about G d gamma/2. The extrapolation to
  // zero step length is the closed form.
  TEST(Validation, StressTurnsWithTheMaterialInSimpleShear)
  {
    const QuadMesh mesh      = rectangle(2, 2, 2.);
    const Loading  loading   = with_sides(straight_loading(1, {2, 0}, {1}), PeriodicSides{0.});
    const auto     stress_at = [&](const double step) {
      return Eigen::Matrix3d(finished(mesh, loading, with_steps(elastic(), step)).end().mean_stress);
    };
    const Eigen::Matrix3d coarse = stress_at(0.02), fine = stress_at(0.01), limit = 2 * fine - coarse;
    const double          s_xy = -G * std::sin(1.), s_xx = 1 - G * (1 - std::cos(1.)), s_yy = 1 + G * (1 - std::cos(1.));
    EXPECT_NEAR(limit(0, 1), s_xy, 2e-4 * G);
    EXPECT_NEAR(limit(0, 0), s_xx, 2e-4 * G);
    EXPECT_NEAR(limit(1, 1), s_yy, 2e-4 * G);
    EXPECT_NEAR(fine(0, 1), s_xy, 0.01 * G);
    EXPECT_NEAR(fine(0, 0), s_xx, 0.01 * G);
  }

  // Simple shear under constant normal stress, psi = 0. There is no plastic strain normal to the flow. Hence the planes of
  // shear are those of the largest shear stress (Davis 1968): s_xx = s_yy = s and tau = s sin phi + c cos phi = 0.5 + 0.01 x
  // 0.866025.
  TEST(Validation, SimpleShearStrengthIsThatOfDavis)
  {
    const QuadMesh mesh    = rectangle(2, 2, 2.);
    Loading        loading = with_sides(straight_loading(1, {2, 0}, {0.1}), PeriodicSides{0.});
    loading.platens[1][1]  = force(-2);
    for (const auto &[law, element] : plastic_elements)
      {
        Options options = one_element({law, element}, 0, 0.01);
        options         = with(options, Platens::rough, Kinematics::small_strain);
        const Course c  = finished(mesh, loading, options);
        EXPECT_NEAR(c.end().mean_stress(1, 1), 1, 1e-6) << name_of(law);
        EXPECT_NEAR(c.end().mean_stress(0, 0), 1, 2e-3) << name_of(law);
        EXPECT_NEAR(-c.end().mean_stress(0, 1), 0.508660, 2e-4) << name_of(law) << ", " << name_of(element);
        EXPECT_NEAR(c.end().upper_platen_force.x(), 2 * 0.508660, 4e-4) << name_of(law);
      }
  }

  // A sample of 12 x 24 elements at its limit, psi = 0, whose volume cannot change: an element that locks is too strong.
  // Between smooth platens the closed form at phi = 20, c = 0.1, s3 = 1 is Kp = 2.039607, Kp + 0.2 sqrt(Kp) = 2.325236.
  // Between rough platens both elements agree.
  TEST(Validation, ElementsDoNotLock)
  {
    const QuadMesh mesh = rectangle(12, 24, 1.);
    for (const Platens platens : {Platens::smooth, Platens::rough})
      {
        double stress[2];
        for (const bool q2 : {false, true})
          {
            Options options = perfectly_plastic(LawKind::mohr_coulomb, 20, 0, 0.1);
            options         = with_steps(with(options, platens, Kinematics::small_strain), 2e-3);
            options.element = q2 ? Displacement::q2 : Displacement::q1_bbar;
            const Course c  = finished(mesh, straight_loading(1, {0, -24}, {0.016, 0.02}), options);
            stress[q2]      = -c.snapshots[1].upper_platen_force.y() / 12;
            EXPECT_NEAR(stress[q2], -c.snapshots[0].upper_platen_force.y() / 12, 3e-4) << "the limit is reached";
          }
        EXPECT_NEAR(stress[0], stress[1], 0.02 * stress[1]) << name_of(platens);
        if (platens == Platens::smooth)
          {
            EXPECT_NEAR(stress[0], 2.325236, 1e-4);
            EXPECT_NEAR(stress[1], 2.325236, 1e-4);
          }
        else
          {
            EXPECT_GT(std::min(stress[0], stress[1]), 2.325236) << "rough platens confine";
          }
      }
  }

  // A square of 24 x 24 between rough platens, 16 x 16 elements with 9 nodes, small strain, 40 equal steps to 2 % axial strain.
  // E = 500 and nu = 0.2 are the defaults. The pressure on the sides is 1 and falls as the height does: 1 - strain on the
  // initial shape.
  Course after_forty_steps(const LawKind law,
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
    return finished(rectangle(side, side, side / 16), loading, options);
  }

  // The codes give 1 - V/V0 of the moved nodes; `volumetric_strain` of small strain is the mean trace.
  double lost_area(const Snapshot &s)
  {
    return 1 - std::accumulate(s.weight.begin(), s.weight.end(), 0.) / (24 * 24);
  }

  // Friction 30 degrees, cohesion 0.1. Returns to the edges and to the apex of the pyramid occur near the corners.
  TEST(Published, AssociatedMohrCoulombCarriesTheForceOfSysalasCode)
  {
    const Course c = after_forty_steps(LawKind::mohr_coulomb, 30, 0.1, 0);
    EXPECT_NEAR(-c.end().upper_platen_force.y(), 103.959039, 1e-6);
    EXPECT_NEAR(lost_area(c.snapshots.back()), -0.0293904, 1e-7);
  }

  // Dilatancy 10 degrees; the upper platen moves down at 45 degrees.
  TEST(Published, NonAssociatedMohrCoulombCarriesTheForceOfSysalasCodeAtFortyFiveDegrees)
  {
    const Course c = after_forty_steps(LawKind::mohr_coulomb, 10, 0.1, 1);
    EXPECT_NEAR(-c.end().upper_platen_force.y(), 94.574584, 1e-6);
    EXPECT_NEAR(c.end().upper_platen_force.x(), 1.70665, 1e-5);
    EXPECT_NEAR(lost_area(c.snapshots.back()), -0.0016055, 1e-7);
  }

  TEST(Published, AssociatedDruckerPragerCarriesTheForceOfTheCodeOfCermakSysalaAndValdman)
  {
    const Course c = after_forty_steps(LawKind::drucker_prager, 30, 0.1, 0);
    EXPECT_NEAR(-c.end().upper_platen_force.y(), 103.363899977, 5e-7);
    EXPECT_NEAR(lost_area(c.snapshots.back()), -0.0236368692, 1e-9);
  }

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
    constexpr double     height  = 20;
    const Loading        loading = with_sides(straight_loading(1, {height, 0}, {1}), PeriodicSides{0.});
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
