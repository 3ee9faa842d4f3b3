// diptych: where a law from a library failed
// SPDX-License-Identifier: LGPL-2.1-or-later
#include "continuum/equilibrium/law_failure.h"

#include <sstream>

#include <deal.II/base/mpi.h>

namespace diptych::continuum
{
  using namespace dealii;

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

  LibraryLaw::Failure law_failure(const Law &law, const MPI_Comm communicator)
  {
    const auto *library = std::get_if<LibraryLaw>(&law);
    if (library == nullptr)
      return {};
    const LibraryLaw::Failure &mine = library->failure();
    LibraryLaw::Failure        first{"", Utilities::MPI::max(int(mine.is_broken), communicator) == 1};
    for (const std::string &text :
         Utilities::MPI::all_gather(communicator, mine.is_broken == first.is_broken ? mine.text : std::string()))
      if (first.text.empty())
        first.text = text;
    return first;
  }
} // namespace diptych::continuum
