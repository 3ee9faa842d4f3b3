// diptych: mesh refinement where plastic strain concentrates
// SPDX-License-Identifier: LGPL-2.1-or-later
#include "continuum/equilibrium/refinement.h"

#include <algorithm>
#include <optional>
#include <set>

#include <deal.II/distributed/cell_data_transfer.templates.h>
#include <deal.II/grid/grid_tools.h>

#include "continuum/equilibrium/cell_records.h"

namespace diptych::continuum
{
  using namespace dealii;

  namespace
  {
    // Flags the cells above the threshold with their neighbours by a vertex. Returns whether any process flagged a cell.
    bool flag_cells(BoundaryValueProblem &problem, const RefinementRule &rule, const std::vector<double> &increments)
    {
      auto        &mesh    = problem.discretisation();
      const double mine    = increments.empty() ? 0. : *std::max_element(increments.begin(), increments.end());
      const double largest = Utilities::MPI::max(mine, mesh.communicator());
      if (!(largest > 0))
        return false;
      std::vector<bool> in_band(mesh.triangulation.n_active_cells(), false), near_band(mesh.triangulation.n_vertices(), false);
      std::size_t       c = 0;
      for (const auto &cell : mesh.triangulation.active_cell_iterators())
        if (cell->is_locally_owned())
          in_band[cell->active_cell_index()] = increments[c++] > rule.threshold * largest;
      // The ring of neighbours continues across the borders of processes.
      using CellIterator = Triangulation<2>::active_cell_iterator;
      GridTools::exchange_cell_data_to_ghosts<bool, Triangulation<2>>(
        mesh.triangulation, [&](const CellIterator &cell) { return std::optional<bool>(in_band[cell->active_cell_index()]); },
        [&](const CellIterator &cell, const bool &value) { in_band[cell->active_cell_index()] = value; });
      for (const auto &cell : mesh.triangulation.active_cell_iterators())
        if (in_band[cell->active_cell_index()])
          for (const unsigned int v : cell->vertex_indices())
            near_band[cell->vertex_index(v)] = true;
      bool flagged = false;
      for (const auto &cell : mesh.triangulation.active_cell_iterators())
        if (cell->is_locally_owned() && cell->level() < rule.levels)
          for (const unsigned int v : cell->vertex_indices())
            if (near_band[cell->vertex_index(v)])
              {
                cell->set_refine_flag();
                flagged = true;
              }
      return Utilities::MPI::max(int(flagged), mesh.communicator()) == 1;
    }
  } // namespace

  std::vector<double> plastic_increments(const BoundaryValueProblem &problem)
  {
    const auto         &mesh = problem.discretisation();
    std::vector<double> increments;
    for (std::size_t c = 0; c < mesh.cells.size(); ++c)
      {
        double sum = 0;
        for (unsigned int q = 0; q < mesh.reference.n_points; ++q)
          sum += problem.last_flow()[c * mesh.reference.n_points + q];
        increments.push_back(sum / mesh.reference.n_points);
      }
    return increments;
  }

  std::optional<DividedCells> refine(BoundaryValueProblem      &problem,
                                     const RefinementRule      &rule,
                                     const std::vector<double> &increments,
                                     LastMotion                &last)
  {
    if (!flag_cells(problem, rule, increments))
      return std::nullopt;
    auto      &mesh     = problem.discretisation();
    const auto records  = make_records(problem, last);
    const auto progress = problem.progress();

    mesh.triangulation.prepare_coarsening_and_refinement();
    DividedCells divided;
    for (const auto &cell : mesh.triangulation.active_cell_iterators())
      if (cell->is_locally_owned() && cell->refine_flag_set())
        divided.push_back(cell->id().to_string());
    std::vector<CellRecord> sent(mesh.triangulation.n_active_cells());
    std::size_t             c = 0;
    for (const auto &cell : mesh.triangulation.active_cell_iterators())
      if (cell->is_locally_owned())
        sent[cell->active_cell_index()] = records[c++];
    parallel::distributed::CellDataTransfer<2, 2, std::vector<CellRecord>> transfer(mesh.triangulation);
    transfer.prepare_for_coarsening_and_refinement(sent);
    mesh.triangulation.execute_coarsening_and_refinement();
    std::vector<CellRecord> received(mesh.triangulation.n_active_cells(), CellRecord(record_length(problem)));
    transfer.unpack(received);

    mesh.distribute();
    problem.rebuild();
    std::vector<CellRecord> mine;
    for (const auto &cell : mesh.triangulation.active_cell_iterators())
      if (cell->is_locally_owned())
        mine.push_back(std::move(received[cell->active_cell_index()]));
    auto restored = read_records(problem, mine, progress);
    last          = std::move(restored.last);
    problem.adopt(std::move(restored.state));
    return divided;
  }

  void divide_again(Discretisation &mesh, const Divisions &divisions)
  {
    for (const DividedCells &divided : divisions)
      {
        const std::set<std::string> wanted(divided.begin(), divided.end());
        for (const auto &cell : mesh.triangulation.active_cell_iterators())
          if (cell->is_locally_owned() && wanted.count(cell->id().to_string()) > 0)
            cell->set_refine_flag();
        mesh.triangulation.execute_coarsening_and_refinement();
      }
    if (!divisions.empty())
      mesh.distribute();
  }
} // namespace diptych::continuum
