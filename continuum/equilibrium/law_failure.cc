// diptych: where a law from a library failed
// SPDX-License-Identifier: LGPL-2.1-or-later
#include "continuum/equilibrium/boundary_value_problem.h"

#include <sstream>

#include <deal.II/base/mpi.h>

namespace diptych::continuum
{
  using namespace dealii;

  namespace
  {
    // "element 3, point 1 (x = 0.5, y = 2)", an element of this process.
    std::string name_of_point(const Discretisation      &mesh,
                              const std::vector<double> &displacement,
                              const std::size_t          cell,
                              const unsigned int         point)
    {
      Eigen::Vector2d x = Eigen::Vector2d::Zero();
      for (unsigned int k = 0; k < mesh.reference.n_nodes; ++k)
        {
          const Node           &node = mesh.nodes[mesh.cells[cell].nodes[k]];
          const Eigen::Vector2d moved(displacement[node.local[0]], displacement[node.local[1]]);
          x += mesh.reference.shape[point][k] * (node.initial + moved);
        }
      std::ostringstream text;
      text << "element " << cell << ", point " << point << " (x = " << x.x() << ", y = " << x.y() << ')';
      if (Utilities::MPI::n_mpi_processes(mesh.communicator()) > 1)
        text << " of process " << Utilities::MPI::this_mpi_process(mesh.communicator());
      return text.str();
    }

  } // namespace

  std::string BoundaryValueProblem::law_failure() const
  {
    const auto *library = std::get_if<LibraryLaw>(&material);
    if (library == nullptr)
      return "";
    std::string       mine;
    const std::size_t n = mesh.reference.n_points;
    for (std::size_t i = 0; i < trial.size() && mine.empty(); ++i)
      if (trial[i].verdict == Verdict::failed)
        mine = library
                 ->failure(state.points[i], increments[i].strain(), step_end - state.progress,
                           name_of_point(mesh, state.displacement, i / n, unsigned(i % n)))
                 .text;
    for (const std::string &text : Utilities::MPI::all_gather(mesh.communicator(), mine))
      if (!text.empty())
        return text;
    return "";
  }
} // namespace diptych::continuum
