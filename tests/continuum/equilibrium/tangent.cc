// diptych: tangent of the whole problem against differences of its residual, its two ways of assembly, its factors
// SPDX-License-Identifier: LGPL-2.1-or-later
#include <type_traits>

#include <deal.II/lac/full_matrix.h>

#include "continuum/equilibrium/supernodal_lu.h"
#include "tests/continuum/problem_scenes.h"

namespace
{
  using namespace diptych::continuum::tests;

  const double E = ElasticOptions().youngs_modulus;

  struct Scene
  {
    std::string name;
    Loading     loading;
    Platens     platens = Platens::rough;
    bool        hanging = false;
  };

  // Prescribed, tied, tied under a force, periodic, of free width (three masters), hanging.
  std::vector<Scene> scenes()
  {
    Loading pressure = straight_loading(5, {3, -3}, {1}), rigid = pressure, periodic = pressure, width = pressure,
            plane       = pressure;
    rigid.lateral       = RigidSides();
    periodic.lateral    = PeriodicSides{0.};
    width.lateral       = PeriodicSides{std::nullopt};
    plane.lateral       = PeriodicSides{0.};
    plane.platens[1][1] = force(-15);
    return {{"pressure", pressure, Platens::rough, false},
            {"rigid", rigid, Platens::smooth, false},
            {"periodic", periodic, Platens::rough, false},
            {"free width", width, Platens::smooth, false},
            {"free platen", plane, Platens::rough, false},
            {"hanging", pressure, Platens::rough, true},
            {"hanging, rigid", rigid, Platens::smooth, true},
            {"frictional", pressure, Platens::frictional, false},
            {"frictional, rigid", rigid, Platens::frictional, false},
            {"frictional, periodic", periodic, Platens::frictional, false}};
  }

  struct Comparison
  {
    double error     = 0; // largest, in units of E
    int    n_plastic = 0, n_elastic = 0, n_columns = 0;
  };

  // `size` of the random displacements makes some points yield, but brings none to the apex.
  Comparison compare(BoundaryValueProblem &problem, const double size)
  {
    problem.begin_step(1e-3);
    auto u = random_increment(problem, size, 3);
    problem.impose(u);
    EXPECT_EQ(problem.evaluate(u).n_failed, 0u);
    Comparison result;
    int        n_apex = 0;
    for (const MaterialUpdate &update : problem.last_update())
      {
        n_apex += update.regime == Regime::apex;
        ++(update.regime == Regime::elastic ? result.n_elastic : result.n_plastic);
      }
    EXPECT_EQ(n_apex, 0) << "at the apex the tangent has an intended extra stiffness";
    const auto        &K           = problem.assemble_tangent();
    const auto        &constraints = problem.correction_constraints();
    const unsigned int n           = problem.discretisation().dof_handler.n_dofs();
    constexpr double   h           = 1e-8;
    for (unsigned int j = 0; j < n; ++j)
      {
        if (constraints.is_constrained(j))
          continue;
        ++result.n_columns;
        auto direction = problem.zero_vector();
        direction[j]   = h;
        direction.compress(dealii::VectorOperation::insert);
        constraints.distribute(direction);
        auto up = u, down = u;
        up += direction;
        down -= direction;
        (void)problem.evaluate(up);
        const auto r_up = problem.negative_residual();
        (void)problem.evaluate(down);
        const auto &r_down = problem.negative_residual();
        for (unsigned int i = 0; i < n; ++i)
          {
            const double difference = -(r_up[i] - r_down[i]) / (2 * h);
            const double entry      = constraints.is_constrained(i) ? 0. : K.el(i, j);
            result.error            = std::max(result.error, std::abs(entry - difference) / E);
          }
      }
    return result;
  }

  TEST(Tangent, ProblemTangentAgreesWithDifferencesOfTheResidual)
  {
    const QuadMesh file = distorted_mesh(3, 3);
    for (const auto &[law, element] : {std::pair<LawKind, Displacement>{LawKind::linear_elastic, Displacement::q2},
                                       {LawKind::mohr_coulomb, Displacement::q2},
                                       {LawKind::mohr_coulomb, Displacement::q1_bbar},
                                       {LawKind::drucker_prager, Displacement::q1_bbar},
                                       {LawKind::drucker_prager, Displacement::q2},
                                       {LawKind::cosserat_mohr_coulomb, Displacement::q2},
                                       {LawKind::cosserat_drucker_prager, Displacement::q2},
                                       {LawKind::gradient_drucker_prager, Displacement::q2}})
      for (const Scene &scene : scenes())
        {
          if (element == Displacement::q2 && law != LawKind::mohr_coulomb && law != LawKind::cosserat_mohr_coulomb &&
              law != LawKind::gradient_drucker_prager && scene.hanging)
            continue; // hanging nodes do not depend on the law
          Options options = with({}, scene.platens, Kinematics::updated);
          options.law     = law;
          options.element = element;
          BoundaryValueProblem problem(file, Units(), scene.loading, options);
          if (scene.hanging)
            refine_around(problem, {1, 1}, 0.5);
          const double     size = (element == Displacement::q2 ? 2.5e-3 : 6e-3) * (scene.hanging ? 0.5 : 1);
          const Comparison c    = compare(problem, size);
          EXPECT_LT(c.error, 1e-6) << name_of(law) << ", " << name_of(element) << ", " << scene.name;
          EXPECT_GT(c.n_columns, 10);
          EXPECT_GT(c.n_elastic, 0) << name_of(law) << ", " << name_of(element) << ", " << scene.name;
          EXPECT_EQ(c.n_plastic > 0, law != LawKind::linear_elastic)
            << name_of(law) << ", " << name_of(element) << ", " << scene.name;
        }
  }

  // Each element has its own random matrix. Direct addition and the way through the constraints fill the same matrix.
  TEST(Tangent, FastAndGeneralAssemblyFillTheSameMatrix)
  {
    const QuadMesh file = distorted_mesh(3, 3);
    for (const ElementKind kind : {ElementKind::q2, ElementKind::q1_mean_dilation, ElementKind::q2_cosserat})
      for (const Scene &scene : scenes())
        {
          Discretisation mesh(file, kind, MPI_COMM_WORLD);
          if (scene.hanging)
            {
              mesh.triangulation.begin_active()->set_refine_flag();
              mesh.triangulation.execute_coarsening_and_refinement();
              mesh.distribute();
            }
          const BoundaryConditions conditions(mesh, scene.loading, {scene.platens == Platens::rough, false, true});
          const auto              &constraints = conditions.correction();
          TangentMatrix            tangent;
          tangent.reinit(mesh, constraints);
          tangent.clear();
          const unsigned int         n = mesh.dof_handler.n_dofs();
          dealii::FullMatrix<double> general(n, n);
          std::mt19937               random(17);
          with_element(kind, [&](const auto chosen) {
            using Element = std::decay_t<decltype(chosen)>;
            for (std::size_t c = 0; c < mesh.cells.size(); ++c)
              {
                ElementMatrix<Element>                       K{};
                dealii::FullMatrix<double>                   full(Element::n_dofs, Element::n_dofs);
                std::vector<dealii::types::global_dof_index> dofs(mesh.cells[c].dofs.begin(),
                                                                  mesh.cells[c].dofs.begin() + Element::n_dofs);
                for (unsigned int i = 0; i < Element::n_dofs; ++i)
                  for (unsigned int j = 0; j < Element::n_dofs; ++j)
                    full(i, j) = K[i * row_length<Element> + j] = double(random()) / double(random.max()) - 0.5;
                tangent.add<Element>(c, K);
                constraints.distribute_local_to_global(full, dofs, general);
              }
          });
          tangent.finish();
          double worst = 0, largest = 0;
          for (unsigned int i = 0; i < n; ++i)
            for (unsigned int j = 0; j < n; ++j)
              {
                if (constraints.is_constrained(i) || constraints.is_constrained(j))
                  {
                    if (i != j)
                      {
                        EXPECT_EQ(tangent.matrix().el(i, j), 0);
                      }
                    continue;
                  }
                worst   = std::max(worst, std::abs(tangent.matrix().el(i, j) - general(i, j)));
                largest = std::max(largest, std::abs(general(i, j)));
              }
          EXPECT_LT(worst, 1e-13) << scene.name;
          EXPECT_GT(largest, 0.4);
        }
  }

  // Tangents of a softening law, not symmetric, with prescribed, tied and hanging unknowns; then a second matrix on the same
  // pattern.
  TEST(SupernodalLu, SolvesToSinglePrecision)
  {
    Loading rigid = straight_loading(5, {12, -12}, {1});
    rigid.lateral = RigidSides();
    for (const LawKind law : {LawKind::mohr_coulomb, LawKind::cosserat_drucker_prager})
      for (const bool hanging : {false, true})
        {
          const Options        options = with(softening(law), Platens::smooth, Kinematics::updated);
          BoundaryValueProblem problem(rectangle(12, 12, 1.), Units(), rigid, options);
          if (hanging)
            refine_around(problem, {6, 6}, 1);
          SupernodalLu lu;
          for (const double size : {0., 2e-3})
            {
              problem.begin_step(1e-3);
              auto u = random_increment(problem, size, 7);
              problem.impose(u);
              (void)problem.evaluate(u);
              const auto &K = problem.assemble_tangent();
              auto        b = problem.zero_vector(), x = b, r = b;
              for (unsigned int i = 0; i < b.size(); ++i)
                b[i] = std::sin(1. + i);
              b.compress(dealii::VectorOperation::insert);
              ASSERT_TRUE(lu.factorise(K));
              lu.solve(x, b);
              K.vmult(r, x);
              r -= b;
              EXPECT_LT(r.l2_norm(), 2e-3 * b.l2_norm()) << name_of(law) << ", " << hanging << ", " << size;
            }
        }
  }
} // namespace
