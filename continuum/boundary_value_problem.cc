// diptych: equilibrium of the sample, residual and consistent tangent on trial states
// SPDX-License-Identifier: LGPL-2.1-or-later
#include "continuum/boundary_value_problem.h"

#include <cmath>
#include <ctime>

#include <deal.II/dofs/dof_tools.h>
#include <deal.II/lac/full_matrix.h>
#include <deal.II/lac/trilinos_sparsity_pattern.h>

namespace diptych::continuum
{
  using namespace dealii;

  namespace
  {
    double cpu_seconds()
    {
      return double(std::clock()) / CLOCKS_PER_SEC;
    }

    // Symmetric gradient of nodal values at one point of a cell.
    SymmetricTensor<2, 2> strain_at(const CellGeometry &cell, const unsigned int q, const std::array<double, dofs_per_cell> &u)
    {
      double xx = 0, yy = 0, xy = 0;
      for (unsigned int node = 0; node < nodes_per_cell; ++node)
        {
          const auto &g = cell.gradients[q][node];
          xx += g[0] * u[2 * node];
          yy += g[1] * u[2 * node + 1];
          xy += g[1] * u[2 * node] + g[0] * u[2 * node + 1];
        }
      SymmetricTensor<2, 2> strain;
      strain[0][0] = xx;
      strain[1][1] = yy;
      strain[0][1] = xy / 2;
      return strain;
    }

    std::array<double, dofs_per_cell> gather(const CellGeometry &cell, const std::vector<double> &values)
    {
      std::array<double, dofs_per_cell> u;
      for (unsigned int i = 0; i < dofs_per_cell; ++i)
        u[i] = values[cell.local_dofs[i]];
      return u;
    }

    // force += B^T stress weight
    void add_stress(const CellGeometry          &cell,
                    const unsigned int           q,
                    const SymmetricTensor<2, 2> &stress,
                    std::vector<double>         &force)
    {
      for (unsigned int node = 0; node < nodes_per_cell; ++node)
        {
          const auto f = stress * cell.gradients[q][node] * cell.weights[q];
          force[cell.local_dofs[2 * node]] += f[0];
          force[cell.local_dofs[2 * node + 1]] += f[1];
        }
    }

    // K += B^T D B weight, D acting on (xx, yy, 2 xy).
    void add_stiffness(const CellGeometry &cell, const unsigned int q, const SymmetricTensor<4, 2> &c, FullMatrix<double> &K)
    {
      const double w       = cell.weights[q];
      const double D[3][3] = {{w * c[0][0][0][0], w * c[0][0][1][1], w * c[0][0][0][1]},
                              {w * c[1][1][0][0], w * c[1][1][1][1], w * c[1][1][0][1]},
                              {w * c[0][1][0][0], w * c[0][1][1][1], w * c[0][1][0][1]}};
      double       DB[3][dofs_per_cell];
      for (unsigned int b = 0; b < nodes_per_cell; ++b)
        for (unsigned int k = 0; k < 3; ++k)
          {
            const auto &g    = cell.gradients[q][b];
            DB[k][2 * b]     = D[k][0] * g[0] + D[k][2] * g[1];
            DB[k][2 * b + 1] = D[k][1] * g[1] + D[k][2] * g[0];
          }
      for (unsigned int a = 0; a < nodes_per_cell; ++a)
        {
          const double gx = cell.gradients[q][a][0], gy = cell.gradients[q][a][1];
          double      *row_x = &K(2 * a, 0), *row_y = &K(2 * a + 1, 0);
          for (unsigned int j = 0; j < dofs_per_cell; ++j)
            {
              row_x[j] += gx * DB[0][j] + gy * DB[2][j];
              row_y[j] += gy * DB[1][j] + gx * DB[2][j];
            }
        }
    }
  } // namespace

  BoundaryValueProblem::BoundaryValueProblem(const std::string &msh_file, const Loading &loading, const Law &law)
      : mesh(msh_file, loading.platens == "rough"),
        law(law),
        pressure(loading.pressure),
        platen_travel(loading.upper_platen_travel),
        committed(mesh.cells.size() * points_per_cell),
        trial(committed.size()),
        committed_displacement(mesh.relevant.n_elements(), 0.),
        trial_increment(committed_displacement),
        external(committed_displacement)
  {
    for (auto &point : committed)
      {
        point.stress    = -pressure * unit_symmetric_tensor<2>();
        point.stress_zz = -pressure;
      }
    TrilinosWrappers::SparsityPattern pattern(mesh.owned, mesh.owned, mesh.relevant, MPI_COMM_WORLD);
    DoFTools::make_sparsity_pattern(mesh.dof_handler, pattern, mesh.constraints, false,
                                    Utilities::MPI::this_mpi_process(MPI_COMM_WORLD));
    pattern.compress();
    matrix.reinit(pattern);

    (void)evaluate(zero_vector());
    initial_internal_force = internal_force();
  }

  DistributedVector BoundaryValueProblem::zero_vector() const
  {
    return DistributedVector(mesh.owned, MPI_COMM_WORLD);
  }

  DistributedVector BoundaryValueProblem::platen_increment(const double d_axial_strain) const
  {
    auto increment = zero_vector();
    for (const auto &entry : mesh.platen_dofs)
      if (entry.upper && entry.moves && mesh.owned.is_element(entry.dof))
        increment[entry.dof] = d_axial_strain * platen_travel[entry.component];
    increment.compress(VectorOperation::insert);
    return increment;
  }

  // f_a = +-P (1 - eps_axial) int N_a dy along the edge, y of the initial mesh: the total is the pressure times the current
  // height, spread as on the initial side. The moved y of the edge itself would be wrong in small strain: where a band
  // leaves the sample it folds over as soon as the jump exceeds an element, and the pressure would pull there. The integrand
  // is cubic in the edge's own coordinate, so that two Gauss points are exact.
  void BoundaryValueProblem::set_lateral_load(const double axial_strain, const double share)
  {
    for (std::size_t i = 0; i < external.size(); ++i)
      external[i] = (1 - share) * initial_internal_force[i];
    for (const auto &edge : mesh.sides)
      for (const double xi : {-1 / std::sqrt(3.), 1 / std::sqrt(3.)})
        {
          const std::array<double, 3> value{xi * (xi - 1) / 2, xi * (xi + 1) / 2, 1 - xi * xi},
            slope{xi - 0.5, xi + 0.5, -2 * xi};
          double dy = 0;
          for (unsigned int k = 0; k < 3; ++k)
            dy += slope[k] * mesh.node_position[edge.nodes[k]].y();
          for (unsigned int k = 0; k < 3; ++k)
            external[mesh.node_local_dofs[edge.nodes[k]][0]] += share * edge.inward * pressure * (1 - axial_strain) * value[k] *
                                                                dy;
        }
  }

  std::vector<double> BoundaryValueProblem::relevant_values(const DistributedVector &vector) const
  {
    DistributedVector ghosted(mesh.owned, mesh.relevant, MPI_COMM_WORLD);
    ghosted = vector;
    std::vector<types::global_dof_index> indices;
    mesh.relevant.fill_index_vector(indices);
    std::vector<double> values(indices.size());
    ghosted.extract_subvector_to(indices, values);
    return values;
  }

  DistributedVector BoundaryValueProblem::assembled(const std::vector<double> &local) const
  {
    auto                                 vector = zero_vector();
    std::vector<types::global_dof_index> indices;
    mesh.relevant.fill_index_vector(indices);
    vector.add(indices, local);
    vector.compress(VectorOperation::add);
    return vector;
  }

  template <class L> void BoundaryValueProblem::update_points(const L &chosen_law, const std::vector<double> &increment)
  {
    for (std::size_t c = 0; c < mesh.cells.size(); ++c)
      {
        const auto u = gather(mesh.cells[c], increment);
        for (unsigned int q = 0; q < points_per_cell; ++q)
          {
            const std::size_t point = c * points_per_cell + q;
            trial[point]            = chosen_law.update(committed[point], strain_at(mesh.cells[c], q, u));
          }
      }
  }

  std::vector<double> BoundaryValueProblem::internal_force() const
  {
    std::vector<double> force(external.size(), 0.);
    for (std::size_t c = 0; c < mesh.cells.size(); ++c)
      for (unsigned int q = 0; q < points_per_cell; ++q)
        add_stress(mesh.cells[c], q, trial[c * points_per_cell + q].state.stress, force);
    return force;
  }

  Imbalance BoundaryValueProblem::evaluate(const DistributedVector &increment)
  {
    const double start = cpu_seconds();
    trial_increment    = relevant_values(increment);
    std::visit([&](const auto &chosen) { update_points(chosen, trial_increment); }, law);

    auto force = internal_force();
    for (std::size_t i = 0; i < force.size(); ++i)
      force[i] -= external[i];
    nodal_force = assembled(force);
    rhs         = nodal_force;
    rhs *= -1;
    mesh.constraints.set_zero(rhs);
    rhs.compress(VectorOperation::insert);

    Imbalance imbalance;
    imbalance.residual = rhs.l2_norm();
    imbalance.scale    = std::sqrt(std::max(0., std::pow(nodal_force.l2_norm(), 2) - std::pow(imbalance.residual, 2)));
    for (const auto &point : trial)
      imbalance.n_failed += point.verdict == Verdict::failed;
    imbalance.n_failed = Utilities::MPI::sum(imbalance.n_failed, MPI_COMM_WORLD);
    cpu_s += cpu_seconds() - start;
    return imbalance;
  }

  DistributedVector BoundaryValueProblem::linearised_residual(const DistributedVector &increment) const
  {
    const auto          values = relevant_values(increment);
    std::vector<double> force(external.size(), 0.);
    for (std::size_t c = 0; c < mesh.cells.size(); ++c)
      {
        const auto u = gather(mesh.cells[c], values);
        for (unsigned int q = 0; q < points_per_cell; ++q)
          add_stress(mesh.cells[c], q, trial[c * points_per_cell + q].tangent * strain_at(mesh.cells[c], q, u), force);
      }
    auto result = assembled(force);
    result += nodal_force;
    result *= -1;
    mesh.constraints.set_zero(result);
    result.compress(VectorOperation::insert);
    return result;
  }

  const TrilinosWrappers::SparseMatrix &BoundaryValueProblem::assemble_tangent()
  {
    // A point at the apex has hardly any stiffness, and a patch of them would make the matrix singular. A thousandth of
    // the elastic one changes the way of the iterations, not where they end.
    const SymmetricTensor<4, 2> floor =
      1e-3 * std::visit([](const auto &chosen) { return chosen.update(MaterialState(), SymmetricTensor<2, 2>()).tangent; }, law);
    const double                         start = cpu_seconds();
    FullMatrix<double>                   K(dofs_per_cell, dofs_per_cell);
    std::vector<types::global_dof_index> dofs(dofs_per_cell);
    matrix = 0;
    for (std::size_t c = 0; c < mesh.cells.size(); ++c)
      {
        K = 0;
        for (unsigned int q = 0; q < points_per_cell; ++q)
          {
            const auto &point = trial[c * points_per_cell + q];
            add_stiffness(mesh.cells[c], q, point.regime == Regime::apex ? point.tangent + floor : point.tangent, K);
          }
        dofs.assign(mesh.cells[c].dofs.begin(), mesh.cells[c].dofs.end());
        mesh.constraints.distribute_local_to_global(K, dofs, matrix);
      }
    matrix.compress(VectorOperation::add);
    cpu_s += cpu_seconds() - start;
    return matrix;
  }

  void BoundaryValueProblem::commit(const double axial_strain)
  {
    for (std::size_t i = 0; i < committed.size(); ++i)
      committed[i] = trial[i].state;
    for (std::size_t i = 0; i < committed_displacement.size(); ++i)
      committed_displacement[i] += trial_increment[i];
    committed_axial_strain   = axial_strain;
    committed_platen_force   = {trial_platen_force(false), trial_platen_force(true)};
    committed_yielding_share = trial_yielding_share();
  }

  Eigen::Vector2d BoundaryValueProblem::trial_platen_force(const bool upper) const
  {
    Eigen::Vector2d force = Eigen::Vector2d::Zero();
    for (const auto &entry : mesh.platen_dofs)
      if (entry.upper == upper && mesh.owned.is_element(entry.dof))
        force[entry.component] += nodal_force[entry.dof];
    for (unsigned int c = 0; c < 2; ++c)
      force[c] = Utilities::MPI::sum(force[c], MPI_COMM_WORLD);
    return force;
  }

  double BoundaryValueProblem::trial_yielding_share() const
  {
    double yielding = 0;
    for (std::size_t i = 0; i < trial.size(); ++i)
      if (trial[i].regime != Regime::elastic)
        yielding += mesh.cells[i / points_per_cell].weights[i % points_per_cell];
    return Utilities::MPI::sum(yielding, MPI_COMM_WORLD) / Utilities::MPI::sum(mesh.area, MPI_COMM_WORLD);
  }
} // namespace diptych::continuum
