// diptych: kinematics and kernels of elements: increments, virtual work, patch test, rotation of stress
// SPDX-License-Identifier: LGPL-2.1-or-later
#include <type_traits>

#include "continuum/elements/element_kernels.h"
#include "continuum/elements/increment.h"
#include "continuum/equilibrium/point_operations.h"
#include "continuum/laws/elasticity.h"
#include "tests/continuum/problem_scenes.h"
#include "tests/common.h"

namespace
{
  using namespace diptych::continuum::tests;

  constexpr ElementKind kinds[] = {ElementKind::q2, ElementKind::q1_mean_dilation, ElementKind::q2_cosserat};

  struct Random
  {
    std::mt19937 generator{5};
    double       operator()() { return 2. * double(generator()) / double(generator.max()) - 1; }
  };

  template <class Element> ElementVector<Element> random_vector(Random &random)
  {
    ElementVector<Element> u;
    for (double &value : u)
      value = random();
    return u;
  }

  template <class Element> double dot(const ElementVector<Element> &a, const ElementVector<Element> &b)
  {
    double sum = 0;
    for (unsigned int i = 0; i < Element::n_dofs; ++i)
      sum += a[i] * b[i];
    return sum;
  }

  // Calls action(element, reference element, cell, random numbers) for every cell of a distorted mesh of every kind of element.
  template <class Action> void for_every_element(const Action &action)
  {
    const QuadMesh file = distorted_mesh(3, 3);
    for (const ElementKind kind : kinds)
      {
        const Discretisation mesh(file, kind, MPI_COMM_WORLD);
        const Geometry       geometry = geometry_at(mesh, positions(mesh, std::vector<double>(mesh.relevant.n_elements(), 0.)));
        with_element(kind, [&](const auto element) {
          Random random;
          for (const CellGeometry &cell : geometry.cells)
            action(element, mesh.reference, cell, random);
        });
      }
  }

  // Virtual work: f . u = sum of stress . strain(u) area, for every stress and every u, on a distorted element. A classical
  // element has no work of couple stress.
  TEST(Element, NodalForcesDoTheWorkOfTheStress)
  {
    for_every_element([](const auto element, const ReferenceElement &reference, const CellGeometry &cell, Random &random) {
      using Element            = std::decay_t<decltype(element)>;
      const auto             u = random_vector<Element>(random);
      ElementVector<Element> f{};
      double                 work = 0;
      for (unsigned int p = 0; p < Element::n_points; ++p)
        {
          PiolaStress stress;
          for (unsigned int k = 0; k < motions_of<Element>; ++k)
            stress[k] = random();
          add_force<Element>(reference, cell, p, stress, f);
          work += cell.points[p].area * (stress * motion_at<Element>(reference, cell, p, u));
        }
      EXPECT_NEAR(dot<Element>(f, u), work, 1e-12);
      EXPECT_GT(std::abs(work), 1e-6);
    });
  }

  // K u = B^T (D (B u)) for every D, symmetric or not.
  TEST(Element, StiffnessIsThatOfItsOwnKernels)
  {
    for_every_element([](const auto element, const ReferenceElement &reference, const CellGeometry &cell, Random &random) {
      using Element            = std::decay_t<decltype(element)>;
      constexpr unsigned int n = motions_of<Element>;
      const auto             u = random_vector<Element>(random);
      ElementVector<Element> f{};
      ElementMatrix<Element> K{};
      for (unsigned int p = 0; p < Element::n_points; ++p)
        {
          PiolaTangent D;
          for (unsigned int i = 0; i < n; ++i)
            for (unsigned int j = 0; j < n; ++j)
              D[i][j] = random();
          add_stiffness<Element>(reference, cell, p, D, K);
          add_force<Element>(reference, cell, p, PiolaStress(D * motion_at<Element>(reference, cell, p, u)), f);
        }
      for (unsigned int i = 0; i < Element::n_dofs; ++i)
        {
          double sum = 0;
          for (unsigned int j = 0; j < Element::n_dofs; ++j)
            sum += K[i * row_length<Element> + j] * u[j];
          EXPECT_NEAR(sum, f[i], 1e-12);
        }
    });
  }

  // Mean dilation: for any displacement the four points of an element have the same volume strain, but different shear.
  TEST(Element, MeanDilationIsOneVolumeStrainPerElement)
  {
    for_every_element([](const auto element, const ReferenceElement &reference, const CellGeometry &cell, Random &random) {
      using Element = std::decay_t<decltype(element)>;
      if constexpr (std::is_same_v<Element, Q1MeanDilation>)
        {
          const auto   u      = random_vector<Element>(random);
          const Motion first  = motion_at<Element>(reference, cell, 0, u);
          double       change = 0;
          for (unsigned int p = 1; p < Element::n_points; ++p)
            {
              const Motion m = motion_at<Element>(reference, cell, p, u);
              EXPECT_NEAR(m[0] + m[3], first[0] + first[3], 1e-13);
              change = std::max(change, std::abs(m[0] - m[3] - first[0] + first[3]));
            }
          EXPECT_GT(change, 0.01);
        }
    });
  }

  Options of_element(const ElementKind kind)
  {
    Options options = kind == ElementKind::q2_cosserat ? perfectly_plastic(LawKind::cosserat_mohr_coulomb, 30, 0, 1e6)
                                                       : elastic();
    options.element = kind == ElementKind::q1_mean_dilation ? Displacement::q1_bbar : Displacement::q2;
    return options;
  }

  // Patch test: a linear displacement on distorted elements, also with hanging nodes. It gives its constant stress at every
  // point and no force on any inner node.
  TEST(Element, LinearDisplacementIsReproducedOnDistortedElements)
  {
    const QuadMesh  file = distorted_mesh(5, 4);
    Eigen::Matrix2d A;
    A << 1e-3, 2e-3, -0.5e-3, -3e-3;
    for (const ElementKind kind : kinds)
      for (const bool hanging : {false, true})
        {
          const Loading        loading = with_sides(straight_loading(0, {0, 0}, {1}), FreeSides());
          const Options        options = of_element(kind);
          BoundaryValueProblem problem(file, Units(), loading, options);
          if (hanging)
            refine_around(problem, {1, 1}, 0.5);
          const auto &mesh = problem.discretisation();
          problem.begin_step(0);
          const auto u = linear_field(problem, A);
          (void)problem.evaluate(u);

          Motion motion;
          motion[0] = A(0, 0), motion[1] = A(0, 1), motion[2] = A(1, 0), motion[3] = A(1, 1);
          motion[4]             = (A(1, 0) - A(0, 1)) / 2;
          const Strain strain   = Increment(motion, true).strain();
          const Stress expected = std::visit([](const auto &law) { return law.elastic_tangent(); }, problem.law()) * strain;
          for (const MaterialUpdate &update : problem.last_update())
            for (unsigned int k = 0; k < n_components; ++k)
              EXPECT_NEAR(update.state.stress[k], expected[k], 1e-11);

          std::set<unsigned int> outer;
          for (const BoundaryEdge &edge : mesh.edges)
            outer.insert({edge.nodes[0], edge.nodes[1], edge.nodes[mesh.reference.n_nodes > 4 ? 2 : 0]});
          double       inside = 0, outside = 0;
          unsigned int n_hanging = 0;
          for (unsigned int k = 0; k < mesh.nodes.size(); ++k)
            for (const auto dof : mesh.nodes[k].dofs)
              {
                (outer.count(k) ? outside : inside) = std::max(outer.count(k) ? outside : inside,
                                                               std::abs(problem.negative_residual()[dof]));
                n_hanging += !outer.count(k) && problem.correction_constraints().is_constrained(dof);
              }
          EXPECT_LT(inside, 1e-12);
          EXPECT_GT(outside, 0.1);
          EXPECT_EQ(n_hanging > 0, hanging);
        }
  }

  // A quarter turn in steps of one degree, with hardly any stiffness. Afterwards xx and yy are exchanged, and the couple stress
  // is rotated as a vector.
  TEST(Element, StressTurnsWithTheMaterial)
  {
    const QuadMesh file                     = distorted_mesh(2, 2);
    Loading        loading                  = straight_loading(1, {0, 0}, {1});
    loading.lateral                         = RigidSides{[](double) { return 0.; }};
    Options options                         = perfectly_plastic(LawKind::cosserat_mohr_coulomb, 30, 0, 1e6);
    options.material.elastic.youngs_modulus = 1e-3;
    BoundaryValueProblem problem(file, Units(), loading, options);
    auto                 state = problem.committed();
    for (MaterialState &point : state.points)
      {
        point.stress[xx] = -1, point.stress[yy] = -3, point.stress[xy] = 0.5, point.stress[relative_rotation] = 0.25;
        point.stress[curvature_x] = 1, point.stress[curvature_y] = 0.2;
        point.stress_zz = -2;
      }
    problem.adopt(state);
    const double    step = M_PI / 180;
    Eigen::Matrix2d turn;
    turn << std::cos(step), -std::sin(step), std::sin(step), std::cos(step);
    for (int k = 0; k < 90; ++k)
      {
        const auto x         = positions(problem.discretisation(), problem.committed().displacement);
        auto       increment = problem.zero_vector();
        for (std::size_t n = 0; n < x.size(); ++n)
          {
            const Eigen::Vector2d u    = turn * x[n] - x[n];
            const Node           &node = problem.discretisation().nodes[n];
            for (unsigned int c = 0; c < 2; ++c)
              increment[node.dofs[c]] = u[c];
            if (node.rotation != dealii::numbers::invalid_dof_index)
              increment[node.rotation] = step;
          }
        increment.compress(dealii::VectorOperation::insert);
        problem.begin_step(problem.progress());
        (void)problem.evaluate(increment);
        problem.commit();
      }
    for (const MaterialState &point : problem.committed().points)
      {
        EXPECT_NEAR(point.stress[xx], -3, 1e-9);
        EXPECT_NEAR(point.stress[yy], -1, 1e-9);
        EXPECT_NEAR(point.stress[xy], -0.5, 1e-9);
        EXPECT_NEAR(point.stress[relative_rotation], 0.25, 1e-9);
        EXPECT_NEAR(point.stress[curvature_x], -0.2, 1e-9);
        EXPECT_NEAR(point.stress[curvature_y], 1, 1e-9);
        EXPECT_NEAR(point.stress_zz, -2, 1e-9);
      }
  }

  using namespace diptych::continuum;

  // A rotation by any angle gives no strain, and the force of a stress on the turned sample is the turned force.
  TEST(Increment, RigidRotationGivesNoStrainAndTurnsTheForce)
  {
    for (const double angle : {0.3, -1.2})
      {
        const double c = std::cos(angle), s = std::sin(angle);
        Motion       motion;
        motion[0] = c - 1, motion[1] = -s, motion[2] = s, motion[3] = c - 1, motion[4] = angle;
        const Increment increment(motion, true);
        EXPECT_LT(increment.strain().norm(), 1e-15);
        EXPECT_NEAR(increment.angle(), angle, 1e-15);

        Stress stress;
        stress[xx] = -1, stress[yy] = -3, stress[xy] = 0.5, stress[relative_rotation] = 0.2, stress[curvature_x] = 0.7;
        const PiolaStress at_start = Increment(Motion(), true).force(stress), now = increment.force(stress);
        for (const unsigned int normal : {0u, 1u})
          {
            EXPECT_NEAR(now[normal], c * at_start[normal] - s * at_start[2 + normal], 1e-14);
            EXPECT_NEAR(now[2 + normal], s * at_start[normal] + c * at_start[2 + normal], 1e-14);
          }
        for (const unsigned int k : {4u, 5u, 6u})
          EXPECT_NEAR(now[k], at_start[k], 1e-14);
      }
  }

  // Hypoelastic simple shear with the Jaumann rate (Dienes, Acta Mech. 32, 1979): s_xy = G sin(shear), s_xx = -s_yy = G (1 -
  // cos(shear)). Twice as many steps leave a quarter of the error.
  TEST(Increment, SimpleShearConvergesToTheClosedFormWithOrderTwo)
  {
    ElasticModuli moduli;
    moduli.shear = 1, moduli.plane_bulk = 1.5;
    const Tangent elastic = elastic_tangent(moduli);
    double        before  = 0;
    for (const int n : {8, 16, 32, 64})
      {
        MaterialState state;
        Motion        motion; // simple shear keeps the gradient from one shape to the next
        motion[1] = 1. / n;
        for (int k = 0; k < n; ++k)
          {
            const Increment increment(motion, true);
            state.stress += elastic * increment.strain();
            turn(state, increment.angle());
          }
        const double error = std::hypot(state.stress[xy] - std::sin(1.), state.stress[xx] - (1 - std::cos(1.)));
        if (n > 8)
          {
            EXPECT_NEAR(before / error, 4, 0.05);
          }
        before = error;
      }
    EXPECT_LT(before, 1e-4);
  }
} // namespace
