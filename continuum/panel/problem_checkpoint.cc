// diptych: checkpoint and restart of a problem on its loading path
// SPDX-License-Identifier: LGPL-2.1-or-later
#include "continuum/panel/problem_checkpoint.h"

#include <algorithm>
#include <stdexcept>

#include <deal.II/base/mpi.h>

#include "continuum/equilibrium/cell_records.h"
#include "continuum/require.h"

namespace diptych::continuum
{
  using namespace dealii;

  namespace
  {
    std::vector<std::string> owned_cells(const Discretisation &mesh)
    {
      std::vector<std::string> ids;
      for (const auto &cell : mesh.triangulation.active_cell_iterators())
        if (cell->is_locally_owned())
          ids.push_back(cell->id().to_string());
      return ids;
    }

    std::size_t values_per_cell(const BoundaryValueProblem &problem)
    {
      return record_length(problem) + 2 * problem.discretisation().reference.n_points;
    }

    std::vector<double> rows_of(const BoundaryValueProblem &problem, const LoadDriver &driver)
    {
      const auto          n_points = problem.discretisation().reference.n_points;
      std::vector<double> values;
      std::size_t         point = 0;
      for (const auto &record : make_records(problem, driver.state().last))
        {
          values.insert(values.end(), record.begin(), record.end());
          for (unsigned int q = 0; q < n_points; ++q, ++point)
            {
              const Localisation &place = problem.committed().localisation[point];
              values.insert(values.end(), {place.determinant, place.angle_deg});
            }
        }
      return values;
    }

    Divisions all_divisions(const Divisions &mine, const MPI_Comm communicator)
    {
      Divisions all(mine.size());
      for (const auto &part : Utilities::MPI::gather(communicator, mine))
        for (std::size_t k = 0; k < part.size(); ++k)
          all[k].insert(all[k].end(), part[k].begin(), part[k].end());
      return all;
    }

    template <class T> void broadcast(T &value, const MPI_Comm communicator)
    {
      value = Utilities::MPI::broadcast(communicator, value);
    }
    void broadcast(Eigen::Vector2d &value, const MPI_Comm communicator)
    {
      const auto sent = Utilities::MPI::broadcast(communicator, std::vector<double>{value.x(), value.y()});
      value           = {sent[0], sent[1]};
    }
    void broadcast(std::optional<double> &value, const MPI_Comm communicator)
    {
      const auto sent = Utilities::MPI::broadcast(communicator, value ? std::vector<double>{*value} : std::vector<double>());
      value           = sent.empty() ? std::nullopt : std::optional<double>(sent[0]);
    }
  } // namespace

  Checkpoint make_checkpoint(const BoundaryValueProblem &problem, const LoadDriver &driver)
  {
    const auto &mesh  = problem.discretisation();
    const auto &state = driver.state();
    const auto  ids   = Utilities::MPI::gather(mesh.communicator(), owned_cells(mesh));
    const auto  parts = gathered(rows_of(problem, driver), mesh.communicator());

    Checkpoint c;
    c.values_per_cell = int(values_per_cell(problem));
    std::map<std::string, const double *> row_of;
    for (std::size_t p = 0; p < ids.size(); ++p)
      for (std::size_t k = 0; k < ids[p].size(); ++k)
        row_of[ids[p][k]] = &parts[p][k * std::size_t(c.values_per_cell)];
    for (const auto &[id, row] : row_of)
      {
        c.cells.push_back(id);
        c.values.insert(c.values.end(), row, row + c.values_per_cell);
      }
    c.divisions         = all_divisions(state.divisions, mesh.communicator());
    c.progress          = problem.progress();
    c.step              = state.step;
    c.last_step         = state.last_step;
    c.motion_is_smooth  = state.is_smooth;
    c.platen_force      = problem.committed().platen_force;
    c.friction_work     = problem.committed().friction_work;
    c.steps             = state.count.steps;
    c.cut_backs         = state.count.cut_backs;
    c.newton_iterations = state.count.newton_iterations;
    c.refinements       = state.count.refinements;
    c.linear_iterations = driver.linear_solver().linear_iterations();
    c.factorisations    = driver.linear_solver().factorisations();
    c.point_cpu_s       = problem.seconds().points;
    c.assembly_cpu_s    = problem.seconds().assembly;
    c.geometry_cpu_s    = problem.seconds().geometry;
    c.solve_cpu_s       = driver.linear_solver().cpu_s();

    KeptPreconditioner kept   = driver.linear_solver().kept();
    c.preconditioner_is_stale = kept.is_stale;
    c.factorised_matrix       = std::move(kept.factorised);
    c.rigid_modes             = std::move(kept.rigid_modes);
    return c;
  }

  Checkpoint of_first_process(Checkpoint checkpoint, const MPI_Comm communicator)
  {
    if (Utilities::MPI::n_mpi_processes(communicator) > 1)
      visit_entries(checkpoint, [&](const char *, auto &value) { broadcast(value, communicator); });
    return checkpoint;
  }

  void restore(const Checkpoint &c, BoundaryValueProblem &problem, LoadDriver &driver)
  {
    auto &mesh = problem.discretisation();
    divide_again(mesh, c.divisions);
    const std::size_t length = values_per_cell(problem);
    require(c.values_per_cell == int(length) && mesh.triangulation.n_global_active_cells() == c.cells.size() &&
              c.values.size() == c.cells.size() * length,
            "the checkpoint belongs to another mesh: number or size of its cells differ");
    problem.rebuild();
    std::vector<CellRecord>   records;
    std::vector<Localisation> localisation;
    for (const auto &id : owned_cells(mesh))
      {
        const auto found = std::lower_bound(c.cells.begin(), c.cells.end(), id);
        require(found != c.cells.end() && *found == id, "the checkpoint belongs to another mesh: it has no cell ", id);
        const double *row = &c.values[std::size_t(found - c.cells.begin()) * length], *end = row + length;
        records.emplace_back(row, row + record_length(problem));
        for (row += record_length(problem); row < end; row += 2)
          localisation.push_back({row[0], row[1]});
      }
    auto restored                = read_records(problem, records, c.progress);
    restored.state.localisation  = std::move(localisation);
    restored.state.platen_force  = c.platen_force;
    restored.state.friction_work = c.friction_work;
    problem.adopt(std::move(restored.state));
    problem.go_on_counting({c.point_cpu_s, c.assembly_cpu_s, c.geometry_cpu_s});

    DriverState state;
    state.last        = std::move(restored.last);
    state.divisions   = Utilities::MPI::this_mpi_process(mesh.communicator()) == 0 ? c.divisions : Divisions(c.divisions.size());
    state.step        = c.step;
    state.last_step   = c.last_step;
    state.is_smooth   = c.motion_is_smooth;
    state.count.steps = c.steps;
    state.count.cut_backs         = c.cut_backs;
    state.count.newton_iterations = c.newton_iterations;
    state.count.refinements       = c.refinements;
    driver.restart(std::move(state));
    auto &solver = driver.linear_solver();
    require(solver.take_up({c.preconditioner_is_stale, c.factorised_matrix, c.rigid_modes}, problem.tangent_matrix()),
            "the matrices of the checkpoint belong to another mesh or loading");
    solver.go_on_counting(c.linear_iterations, c.factorisations, c.solve_cpu_s);
  }
} // namespace diptych::continuum
