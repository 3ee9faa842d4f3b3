// diptych: what the continuum panel shows of its state, positive in compression
// SPDX-License-Identifier: LGPL-2.1-or-later
#include "continuum/sample_state.h"

#include <algorithm>
#include <cmath>

namespace diptych::continuum
{
  namespace
  {
    Eigen::Matrix3d compression_positive(const dealii::SymmetricTensor<2, 2> &t, const double zz)
    {
      Eigen::Matrix3d m;
      m << -t[0][0], -t[0][1], 0, -t[0][1], -t[1][1], 0, 0, 0, -zz;
      return m;
    }

    bool zz_is_not_intermediate(const MaterialState &point)
    {
      const double mean   = trace(point.stress) / 2;
      const double radius = std::hypot((point.stress[0][0] - point.stress[1][1]) / 2, point.stress[0][1]);
      return std::abs(point.stress_zz - mean) > radius * (1 + 1e-9) + 1e-12 * std::abs(mean);
    }

    // F = 1 + grad u at one point of a cell.
    dealii::Tensor<2, 2> deformation_gradient(const Discretisation      &mesh,
                                              const CellGeometry        &cell,
                                              const unsigned int         q,
                                              const std::vector<double> &u)
    {
      dealii::Tensor<2, 2> F = dealii::unit_symmetric_tensor<2>();
      for (unsigned int node = 0; node < nodes_per_cell; ++node)
        for (unsigned int c = 0; c < 2; ++c)
          F[c] += u[mesh.node_local_dofs[cell.nodes[node]][c]] * cell.gradients[q][node];
      return F;
    }

    // Means over one cell: stress and strain by initial area, area and node weights in the current configuration.
    CellState cell_state(const BoundaryValueProblem &problem, const std::size_t c, std::vector<double> &node_weight)
    {
      const auto &mesh = problem.discretisation();
      const auto &cell = mesh.cells[c];
      CellState   state;
      double      initial_area = 0;
      for (unsigned int q = 0; q < points_per_cell; ++q)
        {
          const auto  &point = problem.points()[c * points_per_cell + q];
          const auto   F     = deformation_gradient(mesh, cell, q, problem.displacement());
          const double w = cell.weights[q], current = w * determinant(F);
          state.stress += w * compression_positive(point.stress, point.stress_zz);
          state.strain += w * compression_positive(symmetrize(F) - dealii::unit_symmetric_tensor<2>(), 0);
          state.equivalent_plastic_strain += w * point.equivalent_plastic_strain;
          state.share_zz_not_intermediate += w * zz_is_not_intermediate(point);
          state.area += current;
          initial_area += w;
          for (unsigned int node = 0; node < nodes_per_cell; ++node)
            node_weight[cell.nodes[node]] += current * mesh.shape_values[q][node];
        }
      state.stress /= initial_area;
      state.strain /= initial_area;
      state.equivalent_plastic_strain /= initial_area;
      state.share_zz_not_intermediate /= initial_area;
      return state;
    }

    // deal.II's order of FE_Q(2) -> corners counter-clockwise, edge midpoints, centre.
    std::array<unsigned int, nodes_per_cell> vtk_order(const std::array<unsigned int, nodes_per_cell> &n)
    {
      return {n[0], n[1], n[3], n[2], n[6], n[5], n[7], n[4], n[8]};
    }

    double stress_ratio(const Eigen::Matrix3d &stress)
    {
      const double s = (stress(0, 0) + stress(1, 1)) / 2;
      return std::hypot((stress(0, 0) - stress(1, 1)) / 2, stress(0, 1)) / s;
    }
  } // namespace

  Snapshot make_snapshot(const BoundaryValueProblem &problem)
  {
    const auto &mesh = problem.discretisation();
    Snapshot    snapshot;
    snapshot.axial_strain = snapshot.time = problem.axial_strain();
    for (std::size_t node = 0; node < mesh.node_position.size(); ++node)
      {
        const auto &dofs = mesh.node_local_dofs[node];
        snapshot.displacement.emplace_back(problem.displacement()[dofs[0]], problem.displacement()[dofs[1]]);
        snapshot.position.push_back(mesh.node_position[node] + snapshot.displacement.back());
      }
    snapshot.weight.assign(mesh.node_position.size(), 0.);
    for (std::size_t c = 0; c < mesh.cells.size(); ++c)
      {
        snapshot.cells.push_back(vtk_order(mesh.cells[c].nodes));
        snapshot.cell_state.push_back(cell_state(problem, c, snapshot.weight));
        const auto &state = snapshot.cell_state.back();
        snapshot.mean_stress += state.area * state.stress;
        snapshot.area += state.area;
      }
    snapshot.mean_stress /= snapshot.area;
    snapshot.lower_platen_force = problem.platen_force(false);
    snapshot.upper_platen_force = problem.platen_force(true);
    return snapshot;
  }

  HistoryRow make_history_row(const BoundaryValueProblem &problem, const LoadDriver &driver)
  {
    const auto snapshot = make_snapshot(problem);
    HistoryRow row;
    row.step               = driver.counts().steps;
    row.axial_strain       = snapshot.axial_strain;
    row.mean_stress        = snapshot.mean_stress;
    row.stress_ratio       = stress_ratio(snapshot.mean_stress);
    row.volumetric_strain  = 1 - snapshot.area / problem.discretisation().area;
    row.lower_platen_force = snapshot.lower_platen_force;
    row.upper_platen_force = snapshot.upper_platen_force;
    row.newton_iterations  = driver.counts().newton_iterations;
    row.linear_iterations  = driver.linear_solver().linear_iterations();
    row.factorisations     = driver.linear_solver().factorisations();
    row.cut_backs          = driver.counts().cut_backs;
    row.plastic_share      = problem.yielding_share();
    for (const auto &state : snapshot.cell_state)
      row.share_zz_not_intermediate += state.area / snapshot.area * state.share_zz_not_intermediate;
    for (const auto &point : problem.points())
      row.max_equivalent_plastic_strain = std::max(row.max_equivalent_plastic_strain, point.equivalent_plastic_strain);
    row.assembly_cpu_s = problem.assembly_cpu_s();
    row.solve_cpu_s    = driver.linear_solver().cpu_s();
    return row;
  }
} // namespace diptych::continuum
