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
