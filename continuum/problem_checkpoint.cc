// diptych: the walk of a problem along its load path, put down and taken up again
// SPDX-License-Identifier: LGPL-2.1-or-later
#include "continuum/problem_checkpoint.h"

#include <algorithm>
#include <fstream>
#include <iterator>
#include <set>
#include <sstream>
#include <stdexcept>

#include <deal.II/base/mpi.h>

#include "continuum/cell_records.h"

namespace diptych::continuum
{
  using namespace dealii;

  namespace
  {
    // FNV-1a, 64 bits.
    unsigned long long digest(const std::string &bytes)
    {
      unsigned long long hash = 14695981039346656037ull;
      for (const unsigned char byte : bytes)
        hash = (hash ^ byte) * 1099511628211ull;
      return hash;
    }

    std::string text_of(const std::optional<double> &value)
    {
      if (!value)
        return "none";
      std::ostringstream out;
      out.precision(17);
      out << *value;
      return out.str();
    }

    // Writes name = value for every option that shapes the result.
    struct NamingVisitor
    {
      using Range   = std::array<double, 2>;
      using Choices = std::vector<std::string>;

      std::ostringstream &out;

      void operator()(const std::string &name, double value, const char *, Range, const char *) const { write(name, value); }
      void operator()(const std::string &name, int value, const char *, Range, const char *) const { write(name, value); }
      void operator()(const std::string &name, const std::string &value, const char *, const Choices &, const char *) const
      {
        write(name, value);
      }
      void operator()(const std::string &name, const std::optional<double> &value, const char *, Range, const char *) const
      {
        write(name, text_of(value));
      }
      void operator()(const std::string &name, const std::vector<double> &values, const char *, Range, const char *) const
      {
        for (const double value : values)
          write(name, value);
      }

    private:
      template <class Value> void write(const std::string &name, const Value &value) const
      {
        if (name != "checkpoint_minutes")
          out << name << '=' << value << '\n';
      }
    };

    std::vector<std::string> owned_cells(const Discretisation &mesh)
    {
      std::vector<std::string> ids;
      for (const auto &cell : mesh.triangulation.active_cell_iterators())
        if (cell->is_locally_owned())
          ids.push_back(cell->id().to_string());
      return ids;
    }

    // Divides cells until the active ones are those of the checkpoint.
    void refine_to(Discretisation &mesh, const std::set<std::string> &wanted)
    {
      while (true)
        {
          bool flagged = false;
          for (const auto &cell : mesh.triangulation.active_cell_iterators())
            if (cell->is_locally_owned() && wanted.count(cell->id().to_string()) == 0)
              {
                if (cell->level() > 20)
                  throw std::runtime_error("the checkpoint's cells are not those of this mesh");
                cell->set_refine_flag();
                flagged = true;
              }
          if (Utilities::MPI::max(int(flagged), MPI_COMM_WORLD) == 0)
            return;
          mesh.triangulation.execute_coarsening_and_refinement();
          mesh.distribute();
        }
    }
  } // namespace

  std::string fingerprint(const std::string &msh_file, const double mean_diameter, const Loading &loading, const Options &options)
  {
    std::ostringstream out;
    out.precision(17);
    std::ifstream mesh(msh_file, std::ios::binary);
    out << "mesh " << digest({std::istreambuf_iterator<char>(mesh), {}}) << '\n'
        << mean_diameter << ' ' << loading.pressure << ' ' << loading.lateral.index() << ' ' << loading.body_force.transpose();
    for (const auto &platen : loading.platens)
      for (const auto &drive : platen)
        {
          out << ' ' << drive.is_force;
          for (const double decade : {1e-5, 1e-4, 1e-3, 1e-2, 1e-1, 1., 10., 100.})
            for (int k = 10; k < 100; ++k)
              out << ' ' << (drive.value ? drive.value(k * decade) : 0.);
        }
    if (const auto *rigid = std::get_if<RigidSides>(&loading.lateral))
      out << ' ' << text_of(rigid->widening);
    if (const auto *periodic = std::get_if<PeriodicSides>(&loading.lateral))
      out << ' ' << text_of(periodic->widening);
    out << '\n';
    Options copy = options;
    visit_parameters(copy, NamingVisitor{out});
    return std::to_string(digest(out.str()));
  }

  Checkpoint make_checkpoint(const BoundaryValueProblem &problem, const LoadDriver &driver)
  {
    const auto         &mesh = problem.discretisation();
    std::vector<double> values;
    for (const auto &record : make_records(problem, driver.state().last_increment))
      values.insert(values.end(), record.begin(), record.end());
    const auto ids   = Utilities::MPI::gather(MPI_COMM_WORLD, owned_cells(mesh));
    const auto parts = Utilities::MPI::gather(MPI_COMM_WORLD, values);

    Checkpoint checkpoint;
    checkpoint.values_per_cell = record_length(mesh.reference);
    std::map<std::string, const double *> row_of;
    for (std::size_t p = 0; p < ids.size(); ++p)
      for (std::size_t k = 0; k < ids[p].size(); ++k)
        row_of[ids[p][k]] = &parts[p][k * checkpoint.values_per_cell];
    for (const auto &[id, row] : row_of)
      {
        checkpoint.cells.push_back(id);
        checkpoint.values.insert(checkpoint.values.end(), row, row + checkpoint.values_per_cell);
      }
    const auto &state  = driver.state();
    checkpoint.scalars = {{"progress", problem.progress()},
                          {"step", state.step},
                          {"last_step", state.last_step},
                          {"point_cpu_s", problem.seconds().points},
                          {"assembly_cpu_s", problem.seconds().assembly},
                          {"geometry_cpu_s", problem.seconds().geometry},
                          {"solve_cpu_s", driver.linear_solver().cpu_s()}};
    checkpoint.counts  = {{"steps", state.count.steps},
                          {"cut_backs", state.count.cut_backs},
                          {"newton_iterations", state.count.newton_iterations},
                          {"refinements", state.count.refinements},
                          {"linear_iterations", driver.linear_solver().linear_iterations()},
                          {"factorisations", driver.linear_solver().factorisations()}};
    return checkpoint;
  }

  void restore(const Checkpoint &checkpoint, BoundaryValueProblem &problem, LoadDriver &driver)
  {
    auto                 &mesh = problem.discretisation();
    std::set<std::string> wanted(checkpoint.cells.begin(), checkpoint.cells.end());
    refine_to(mesh, wanted);
    if (checkpoint.values_per_cell != record_length(mesh.reference) ||
        mesh.triangulation.n_global_active_cells() != checkpoint.cells.size())
      throw std::runtime_error("the checkpoint's cells are not those of this mesh");
    problem.rebuild();
    std::vector<CellRecord> records;
    for (const auto &id : owned_cells(mesh))
      {
        const auto at  = std::lower_bound(checkpoint.cells.begin(), checkpoint.cells.end(), id) - checkpoint.cells.begin();
        const auto row = checkpoint.values.begin() + at * checkpoint.values_per_cell;
        records.emplace_back(row, row + checkpoint.values_per_cell);
      }
    auto        restored = read_records(problem, records, checkpoint.scalars.at("progress"));
    DriverState state;
    state.last_increment = std::move(restored.last_increment);
    state.step           = checkpoint.scalars.at("step");
    state.last_step      = checkpoint.scalars.at("last_step");
    state.count          = {int(checkpoint.counts.at("steps")), int(checkpoint.counts.at("cut_backs")),
                            int(checkpoint.counts.at("newton_iterations")), int(checkpoint.counts.at("refinements"))};
    problem.adopt(std::move(restored.state));
    problem.go_on_counting(
      {checkpoint.scalars.at("point_cpu_s"), checkpoint.scalars.at("assembly_cpu_s"), checkpoint.scalars.at("geometry_cpu_s")});
    driver.restart(std::move(state));
    driver.go_on_counting(int(checkpoint.counts.at("linear_iterations")), int(checkpoint.counts.at("factorisations")),
                          checkpoint.scalars.at("solve_cpu_s"));
  }
} // namespace diptych::continuum
