// diptych: the consistent tangent as a sparse matrix
// SPDX-License-Identifier: LGPL-2.1-or-later
#include "continuum/equilibrium/tangent_matrix.h"

#include <algorithm>
#include <cmath>

#include <deal.II/dofs/dof_tools.h>
#include <deal.II/lac/full_matrix.h>
#include <deal.II/lac/trilinos_sparsity_pattern.h>

#include <Epetra_CrsMatrix.h>

namespace diptych::continuum
{
  using namespace dealii;

  void TangentMatrix::reinit(const Discretisation            &mesh,
                             const AffineConstraints<double> &constraints,
                             const CheckStop                 &check_stop)
  {
    this->mesh        = &mesh;
    this->constraints = &constraints;
    TrilinosWrappers::SparsityPattern pattern(mesh.owned, mesh.owned, mesh.relevant, mesh.communicator());
    DoFTools::make_sparsity_pattern(mesh.dof_handler, pattern, constraints, false,
                                    Utilities::MPI::this_mpi_process(mesh.communicator()));
    call(check_stop);
    pattern.compress();
    call(check_stop);
    sparse.reinit(pattern);
    call(check_stop);
    const bool one_process = Utilities::MPI::n_mpi_processes(mesh.communicator()) == 1;
    general.assign(mesh.cells.size(), !one_process);
    places.clear();
    unit_diagonal.clear();
    if (one_process)
      look_up_places();
  }

  int TangentMatrix::place(const types::global_dof_index row, const types::global_dof_index column) const
  {
    const int *begin = columns + row_start[row], *end = columns + row_start[row + 1];
    const int *found = std::find(begin, end, int(column));
    return found == end ? -1 : int(found - columns);
  }

  void TangentMatrix::look_up_places()
  {
    sparse.compress(VectorOperation::add);
    auto &crs = const_cast<Epetra_CrsMatrix &>(sparse.trilinos_matrix());
    crs.OptimizeStorage();
    crs.ExtractCrsDataPointers(row_start, columns, values);
    for (const auto dof : mesh->relevant)
      if (constraints->is_constrained(dof))
        unit_diagonal.push_back(place(dof, dof));

    // A dof maps to itself, to nothing (prescribed), or to one other dof with weight 1 (tied). In all other cases its element
    // takes the general way.
    const auto n_dofs = mesh->reference.n_dofs;
    places.assign(mesh->cells.size() * n_dofs * n_dofs, -1);
    std::vector<types::global_dof_index> target(n_dofs);
    for (std::size_t c = 0; c < mesh->cells.size(); ++c)
      {
        const auto &dofs = mesh->cells[c].dofs;
        for (unsigned int i = 0; i < n_dofs; ++i)
          {
            target[i] = dofs[i];
            if (!constraints->is_constrained(dofs[i]))
              continue;
            const auto &entries = *constraints->get_constraint_entries(dofs[i]);
            general[c]          = general[c] || entries.size() > 1 || (entries.size() == 1 && entries[0].second != 1.);
            target[i]           = entries.empty() ? numbers::invalid_dof_index : entries[0].first;
          }
        for (unsigned int i = 0; i < n_dofs && !general[c]; ++i)
          for (unsigned int j = 0; j < n_dofs; ++j)
            if (target[i] != numbers::invalid_dof_index && target[j] != numbers::invalid_dof_index)
              places[(c * n_dofs + i) * n_dofs + j] = place(target[i], target[j]);
      }
  }

  void TangentMatrix::clear()
  {
    sparse = 0;
  }

  void TangentMatrix::add_through_constraints(const std::size_t cell, const double *K, const unsigned int row_length)
  {
    const auto                           n = mesh->reference.n_dofs;
    FullMatrix<double>                   full(n, n);
    std::vector<types::global_dof_index> dofs(mesh->cells[cell].dofs.begin(), mesh->cells[cell].dofs.begin() + n);
    for (unsigned int i = 0; i < n; ++i)
      for (unsigned int j = 0; j < n; ++j)
        full(i, j) = K[i * row_length + j];
    constraints->distribute_local_to_global(full, dofs, sparse);
  }

  void TangentMatrix::add(const types::global_dof_index dof, const double stiffness)
  {
    FullMatrix<double> full(1, 1);
    full(0, 0) = stiffness;
    constraints->distribute_local_to_global(full, {dof}, sparse);
  }

  // Rows of constrained dofs contain only a diagonal of the size of the other entries, so their solution is zero.
  void TangentMatrix::finish()
  {
    sparse.compress(VectorOperation::add);
    if (places.empty())
      return;
    double largest = 0;
    for (int k = 0; k < sparse.trilinos_matrix().NumMyNonzeros(); ++k)
      largest = std::max(largest, std::abs(values[k]));
    for (const int diagonal : unit_diagonal)
      values[diagonal] = largest;
  }
} // namespace diptych::continuum
