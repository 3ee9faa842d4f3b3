// diptych: the consistent tangent as a sparse matrix
// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <vector>

#include <deal.II/lac/affine_constraints.h>
#include <deal.II/lac/trilinos_sparse_matrix.h>

#include "continuum/elements/discretisation.h"
#include "continuum/elements/element_kernels.h"

namespace diptych::continuum
{
  // Adds element matrices directly to the compressed rows, whose positions are looked up once per mesh. A tangent then takes
  // half the time of the general way through constraints (benchmarks/continuum_cost, h = 2 and 1). The general way remains for
  // elements with hanging nodes or several masters, and for distributed matrices.
  class TangentMatrix
  {
  public:
    void reinit(const Discretisation                    &mesh,
                const dealii::AffineConstraints<double> &constraints,
                const CheckStop                         &check_stop = {});

    void                          clear();
    template <class Element> void add(std::size_t cell, const ElementMatrix<Element> &K);
    void                          add(dealii::types::global_dof_index dof, double stiffness); // on the diagonal
    void                          finish(); // must be called before the matrix is read

    const dealii::TrilinosWrappers::SparseMatrix &matrix() const { return sparse; }

  private:
    void look_up_places();
    int  place(dealii::types::global_dof_index row, dealii::types::global_dof_index column) const;
    void add_through_constraints(std::size_t cell, const double *K, unsigned int row_length);

    const Discretisation                    *mesh        = nullptr;
    const dealii::AffineConstraints<double> *constraints = nullptr;
    dealii::TrilinosWrappers::SparseMatrix   sparse;
    double                                  *values    = nullptr; // values of all rows, on one process
    int                                     *row_start = nullptr, *columns = nullptr;
    std::vector<int>                         places;        // n_dofs^2 per cell; -1: entry is dropped; empty on several processes
    std::vector<bool>                        general;       // per cell: uses the general way
    std::vector<int>                         unit_diagonal; // positions of the constrained dofs
  };

  template <class Element> void TangentMatrix::add(const std::size_t cell, const ElementMatrix<Element> &K)
  {
    if (general[cell])
      return add_through_constraints(cell, K.data(), row_length<Element>);
    const int *to = &places[cell * Element::n_dofs * Element::n_dofs];
    for (unsigned int i = 0; i < Element::n_dofs; ++i)
      for (unsigned int j = 0; j < Element::n_dofs; ++j, ++to)
        if (*to >= 0)
          values[*to] += K[i * row_length<Element> + j];
  }
} // namespace diptych::continuum
