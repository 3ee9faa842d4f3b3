// diptych: elements and laws in a problem without platens and sides: a thick cylinder under inner pressure
// SPDX-License-Identifier: LGPL-2.1-or-later
#include <type_traits>

#include <Eigen/SparseLU>

#include "continuum/elements/element_kernels.h"
#include "continuum/laws/mohr_coulomb.h"
#include "tests/continuum/continuum_scenes.h"
#include "tests/continuum/laws/law_states.h"

namespace
{
  using namespace diptych::continuum::tests;

  // Quarter of a cylinder in small strain, without weight and initial stress. All nodes of the inner arc move outwards by the
  // same amount. The cuts are planes of symmetry, the outer arc is free.
  class Cylinder
  {
  public:
    Cylinder(const QuadMesh &quads, const ElementKind kind, const LawOptions &options)
        : mesh(quads, kind, MPI_COMM_SELF),
          geometry(geometry_at(mesh, positions(mesh, std::vector<double>(mesh.relevant.n_elements(), 0.)))),
          law(options),
          committed(mesh.cells.size() * mesh.reference.n_points),
          trial(committed.size()),
          is_held(mesh.dof_handler.n_dofs(), false)
    {
      for (const Node &node : mesh.boundary_nodes(lower_platen))
        is_held[node.dofs[1]] = true;
      for (const Node &node : mesh.boundary_nodes(left_side))
        is_held[node.dofs[0]] = true;
      for (const Node &node : mesh.boundary_nodes(right_side))
        is_held[node.dofs[0]] = is_held[node.dofs[1]] = true;
    }

    // Widens the hole by one step. Returns the pressure on it, from the nodal forces over the length of the arc.
    double widen(const double step)
    {
      Eigen::VectorXd u = Eigen::VectorXd::Zero(is_held.size());
      for (const Node &node : mesh.boundary_nodes(right_side))
        for (unsigned int c = 0; c < 2; ++c)
          u[node.dofs[c]] = step * node.initial.normalized()[c];
      for (int iteration = 0; iteration < 40; ++iteration)
        {
          evaluate(u);
          double residual = 0;
          for (Eigen::Index i = 0; i < force.size(); ++i)
            residual = std::max(residual, is_held[i] ? 0. : std::abs(force[i]));
          if (residual < 1e-9)
            {
              committed  = trial;
              double sum = 0;
              for (const Node &node : mesh.boundary_nodes(right_side))
                sum += Eigen::Vector2d(force[node.dofs[0]], force[node.dofs[1]]).dot(node.initial.normalized());
              return sum / (M_PI / 2);
            }
          Eigen::SparseLU<Eigen::SparseMatrix<double>> factors(stiffness);
          Eigen::VectorXd                              rhs = -force;
          for (Eigen::Index i = 0; i < rhs.size(); ++i)
            if (is_held[i])
              rhs[i] = 0;
          u += factors.solve(rhs);
        }
      ADD_FAILURE() << "no equilibrium";
      return 0;
    }

  private:
    void evaluate(const Eigen::VectorXd &u)
    {
      force = Eigen::VectorXd::Zero(u.size());
      std::vector<Eigen::Triplet<double>> entries;
      with_element(mesh.kind, [&](const auto chosen) {
        using Element = std::decay_t<decltype(chosen)>;
        for (std::size_t c = 0; c < mesh.cells.size(); ++c)
          {
            const auto            &dofs = mesh.cells[c].dofs;
            ElementVector<Element> local, f{};
            ElementMatrix<Element> K{};
            for (unsigned int i = 0; i < Element::n_dofs; ++i)
              local[i] = u[dofs[i]];
            for (unsigned int p = 0; p < Element::n_points; ++p)
              {
                const std::size_t k = c * Element::n_points + p;
                const Increment   increment(motion_at<Element>(mesh.reference, geometry.cells[c], p, local), false);
                const auto        update = law.update(committed[k], increment.strain(), 0);
                EXPECT_NE(update.verdict, Verdict::failed);
                trial[k] = update.state;
                add_force<Element>(mesh.reference, geometry.cells[c], p, increment.force(update.state.stress), f);
                add_stiffness<Element>(mesh.reference, geometry.cells[c], p,
                                       increment.tangent(update.state.stress, update.tangent), K);
              }
            for (unsigned int i = 0; i < Element::n_dofs; ++i)
              {
                force[dofs[i]] += f[i];
                for (unsigned int j = 0; j < Element::n_dofs; ++j)
                  if (!is_held[dofs[i]] && !is_held[dofs[j]])
                    entries.emplace_back(dofs[i], dofs[j], K[i * row_length<Element> + j]);
              }
          }
      });
      for (std::size_t i = 0; i < is_held.size(); ++i)
        if (is_held[i])
          entries.emplace_back(i, i, 1.);
      stiffness.resize(u.size(), u.size());
      stiffness.setFromTriplets(entries.begin(), entries.end());
    }

    Discretisation              mesh;
    Geometry                    geometry;
    MohrCoulomb                 law;
    std::vector<MaterialState>  committed, trial;
    std::vector<bool>           is_held;
    Eigen::VectorXd             force;
    Eigen::SparseMatrix<double> stiffness;
  };

  // Widening the hole makes s_r the major and s_theta the minor stress. With q = s + c cot phi the strength is q_r = Kp
  // q_theta. Equilibrium, d s_r/dr = -(s_r - s_theta)/r, then reads d q_r/dr = -(1 - 1/Kp) q_r/r: q_r ~ r^-(1 - 1/Kp). Without
  // outer pressure q_r(b) = c cot phi, so p = c cot phi ((b/a)^(1 - 1/Kp) - 1). For phi = 30, c = 1 this is 1.7320508 (2^(2/3)
  // - 1) = 1.017408. The elastic solution before is p = 2 G (u/a) (1 - a^2/b^2)/(1 + (1 - 2 nu) a^2/b^2) = 416.67 x 0.75/1.15
  // u, u = 1e-4.
  TEST(Validation, ThickCylinderCarriesItsPlasticPressure)
  {
    const QuadMesh mesh = read_mesh(DIPTYCH_SOURCE_DIR "/meshes/thick_cylinder.geo");
    for (const ElementKind kind : {ElementKind::q2, ElementKind::q1_mean_dilation})
      for (const double dilatancy : {0., 30.})
        {
          Cylinder cylinder(mesh, kind, constant(30, dilatancy, 1));
          double   before = 0, pressure = cylinder.widen(1e-4);
          EXPECT_NEAR(pressure, 416.6667 * 0.75 / 1.15 * 1e-4, 0.005 * pressure) << "elastic";
          for (int k = 0; k < 12; ++k)
            {
              before   = pressure;
              pressure = cylinder.widen(2e-3);
            }
          EXPECT_NEAR(pressure, 1.017408, 0.005 * 1.017408);
          EXPECT_NEAR(pressure, before, 1e-3) << "the whole cylinder flows";
        }
  }
} // namespace
