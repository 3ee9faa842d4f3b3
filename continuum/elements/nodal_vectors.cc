// diptych: distributed vectors and their entries on this process
// SPDX-License-Identifier: LGPL-2.1-or-later
#include "continuum/elements/nodal_vectors.h"

namespace diptych::continuum
{
  using namespace dealii;

  DistributedVector zero_vector(const Discretisation &mesh)
  {
    return DistributedVector(mesh.owned, mesh.communicator());
  }

  std::vector<double> relevant_values(const Discretisation &mesh, const DistributedVector &vector)
  {
    DistributedVector ghosted(mesh.owned, mesh.relevant, mesh.communicator());
    ghosted = vector;
    std::vector<types::global_dof_index> indices;
    mesh.relevant.fill_index_vector(indices);
    std::vector<double> values(indices.size());
    ghosted.extract_subvector_to(indices, values);
    return values;
  }

  DistributedVector owned_values(const Discretisation &mesh, const std::vector<double> &relevant)
  {
    auto vector = zero_vector(mesh);
    for (const auto dof : mesh.owned)
      vector[dof] = relevant[mesh.relevant.index_within_set(dof)];
    vector.compress(VectorOperation::insert);
    return vector;
  }

  DistributedVector assembled(const Discretisation &mesh, const std::vector<double> &relevant)
  {
    auto                                 vector = zero_vector(mesh);
    std::vector<types::global_dof_index> indices;
    mesh.relevant.fill_index_vector(indices);
    vector.add(indices, relevant);
    vector.compress(VectorOperation::add);
    return vector;
  }

  std::vector<std::vector<double>> gathered(const std::vector<double> &mine, const MPI_Comm communicator)
  {
    const int n = int(dealii::Utilities::MPI::n_mpi_processes(communicator)), length = int(mine.size());
    if (n == 1)
      return {mine};
    const auto       lengths = dealii::Utilities::MPI::gather(communicator, length);
    std::vector<int> starts(lengths.size(), 0);
    for (std::size_t k = 1; k < starts.size(); ++k)
      starts[k] = starts[k - 1] + lengths[k - 1];
    std::vector<double> all(lengths.empty() ? 0 : std::size_t(starts.back() + lengths.back()));
    MPI_Gatherv(mine.data(), length, MPI_DOUBLE, all.data(), lengths.data(), starts.data(), MPI_DOUBLE, 0, communicator);
    std::vector<std::vector<double>> parts;
    for (std::size_t k = 0; k < starts.size(); ++k)
      parts.emplace_back(all.begin() + starts[k], all.begin() + starts[k] + lengths[k]);
    return parts;
  }

  void condense(const Discretisation &mesh, const AffineConstraints<double> &constraints, std::vector<double> &relevant)
  {
    for (const auto &line : constraints.get_lines())
      if (mesh.relevant.is_element(line.index))
        {
          const auto   from  = mesh.relevant.index_within_set(line.index);
          const double force = relevant[from];
          relevant[from]     = 0;
          if (force != 0)
            for (const auto &[master, weight] : line.entries)
              relevant[mesh.relevant.index_within_set(master)] += weight * force;
        }
  }
} // namespace diptych::continuum
