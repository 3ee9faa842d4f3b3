// diptych: a row of the history of the continuum panel, positive in compression
// SPDX-License-Identifier: LGPL-2.1-or-later
#include <algorithm>
#include <cmath>

#include <deal.II/base/mpi.h>

#include "continuum/panel/point_values.h"
#include "continuum/panel/sample_state.h"

namespace diptych::continuum
{
  using dealii::Utilities::MPI::sum;

  namespace
  {
    double stress_ratio(const Eigen::Matrix3d &stress)
    {
      const double s = (stress(0, 0) + stress(1, 1)) / 2;
      return std::hypot((stress(0, 0) - stress(1, 1)) / 2, (stress(0, 1) + stress(1, 0)) / 2) / s;
    }

    void sum_up(Eigen::Matrix3d &matrix, const MPI_Comm communicator)
    {
      for (int k = 0; k < 9; ++k)
        matrix.data()[k] = sum(matrix.data()[k], communicator);
    }

    // Part of the mean sxx that the platens cause on problem.geometry().
    double platen_sxx(const BoundaryValueProblem &problem)
    {
      const auto &mesh     = problem.discretisation();
      const auto &moved    = problem.committed().displacement;
      const auto  position = positions(mesh, problem.moves() ? moved : std::vector<double>(moved.size(), 0.));
      const auto  forces   = problem.platen_node_forces();
      double      moment   = 0;
      for (std::size_t i = 0; i < mesh.nodes.size(); ++i)
        if (const auto dof = mesh.nodes[i].dofs[0]; mesh.owned.is_element(dof))
          moment -= position[i].x() * forces[mesh.relevant.index_within_set(dof)];
      return sum(moment, mesh.communicator()) / sum(problem.geometry().area, mesh.communicator());
    }

    // Mean trace of the small strain on the initial shape, positive in compression; the divergence of the place itself is 2.
    double mean_trace(const BoundaryValueProblem &problem, const std::vector<Eigen::Vector2d> &position)
    {
      const auto &mesh     = problem.discretisation();
      const auto &geometry = problem.geometry();
      double      dilation = 0;
      for (std::size_t c = 0; c < geometry.cells.size(); ++c)
        for (unsigned int q = 0; q < mesh.reference.n_points; ++q)
          {
            const PointGeometry &point      = geometry.cells[c].points[q];
            double               divergence = -2;
            for (unsigned int node = 0; node < mesh.reference.n_nodes; ++node)
              {
                const Eigen::Vector2d &x = position[mesh.cells[c].nodes[node]];
                divergence += point.gradient[node][0] * x.x() + point.gradient[node][1] * x.y();
              }
            dilation += point.area * divergence;
          }
      return 0 - sum(dilation, mesh.communicator()) / sum(geometry.area, mesh.communicator());
    }

    void add_point_sums(const BoundaryValueProblem &problem, HistoryRow &row)
    {
      const auto  &mesh     = problem.discretisation();
      const auto  &state    = problem.committed();
      const auto  &geometry = problem.geometry();
      const auto   position = positions(mesh, state.displacement);
      const double bottom   = mesh.origin.y() + problem.platen_travel(false).y(),
                   height   = mesh.origin.y() + mesh.extent.y() + problem.platen_travel(true).y() - bottom;
      double area = 0, core_area = 0, yielding = 0, unreliable = 0, not_intermediate = 0, viscous = 0, dissipation = 0,
             largest = 0, unstable = 0;
      for (std::size_t i = 0; i < state.points.size(); ++i)
        {
          const auto  &point = state.points[i];
          const auto   cell = i / mesh.reference.n_points, q = i % mesh.reference.n_points;
          const double w      = geometry.cells[cell].points[q].area;
          const auto   stress = compression_positive(point, mesh.kind == ElementKind::q2_cosserat);
          double       y      = -bottom;
          for (unsigned int node = 0; node < mesh.reference.n_nodes; ++node)
            y += mesh.reference.shape[q][node] * position[mesh.cells[cell].nodes[node]].y();
          area += w;
          row.mean_stress += w * stress;
          if (std::abs(y - 0.5 * height) < 0.25 * height)
            {
              core_area += w;
              row.core_stress += w * stress;
            }
          not_intermediate += w * zz_is_not_intermediate(point);
          dissipation += w * point.dissipation;
          largest = std::max(largest, point.equivalent_plastic_strain);
          unreliable += w * (problem.last_update()[i].verdict == Verdict::unreliable);
          if (problem.last_update()[i].regime == Regime::elastic)
            continue;
          yielding += w;
          unstable += w * problem.last_instability()[i];
          const double strength = std::visit([&](const auto &law) { return law.shear_strength(point); }, problem.law());
          viscous += strength > 0 ? w * point.overstress / strength : 0;
        }
      area = sum(area, mesh.communicator());
      sum_up(row.mean_stress, mesh.communicator());
      sum_up(row.core_stress, mesh.communicator());
      row.core_stress = (row.core_stress + row.core_stress.transpose()).eval() / 2 /
                        std::max(sum(core_area, mesh.communicator()), 1e-300);
      row.mean_stress /= area;
      yielding                          = sum(yielding, mesh.communicator());
      row.plastic_share                 = yielding / area;
      row.viscous_share                 = sum(viscous, mesh.communicator()) / std::max(yielding, 1e-300);
      row.unstable_share                = sum(unstable, mesh.communicator()) / area;
      row.unreliable_share              = sum(unreliable, mesh.communicator()) / area;
      row.share_zz_not_intermediate     = sum(not_intermediate, mesh.communicator()) / area;
      row.dissipation                   = sum(dissipation, mesh.communicator());
      row.max_equivalent_plastic_strain = dealii::Utilities::MPI::max(largest, mesh.communicator());
      const double moved_area           = sum(problem.moved_geometry().area, mesh.communicator());
      row.volumetric_strain = problem.moves() ? 1 - moved_area / problem.initial_area() : mean_trace(problem, position);
      row.width             = moved_area / height;
    }

    void add_localisation(const BoundaryValueProblem &problem, HistoryRow &row)
    {
      Localisation least;
      for (const auto &place : problem.committed().localisation)
        if (place.determinant < least.determinant)
          least = place;
      for (const auto &other : dealii::Utilities::MPI::all_gather(problem.discretisation().communicator(),
                                                                  std::vector<double>{least.determinant, least.angle_deg}))
        if (other[0] < row.least_acoustic_determinant)
          {
            row.least_acoustic_determinant = other[0];
            row.localisation_angle         = other[1];
          }
    }
  } // namespace

  HistoryRow make_history_row(const BoundaryValueProblem &problem, const LoadDriver &driver, const Loading &loading)
  {
    const auto &mesh  = problem.discretisation();
    const auto &count = driver.state().count;
    HistoryRow  row;
    row.step = count.steps;
    set_progress(problem, loading, row);
    add_point_sums(problem, row);
    add_localisation(problem, row);
    row.stress_ratio       = stress_ratio(row.mean_stress);
    row.lower_platen_force = problem.platen_force(false);
    row.upper_platen_force = problem.platen_force(true);
    row.platen_sxx         = platen_sxx(problem);
    row.friction_work      = problem.committed().friction_work;
    row.n_cells            = int(mesh.triangulation.n_global_active_cells());
    row.n_unknowns         = int(mesh.dof_handler.n_dofs());
    row.newton_iterations  = count.newton_iterations;
    row.linear_iterations  = driver.linear_solver().linear_iterations();
    row.factorisations     = driver.linear_solver().factorisations();
    row.cut_backs          = count.cut_backs;
    row.point_cpu_s        = problem.seconds().points;
    row.assembly_cpu_s     = problem.seconds().assembly;
    row.geometry_cpu_s     = problem.seconds().geometry;
    row.solve_cpu_s        = driver.linear_solver().cpu_s();
    return row;
  }
} // namespace diptych::continuum
