// diptych: sparse LU factors in single precision, a preconditioner
// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <vector>

#include <deal.II/base/aligned_vector.h>
#include <deal.II/lac/trilinos_sparse_matrix.h>
#include <deal.II/lac/trilinos_vector.h>

namespace diptych::continuum
{
  // Multifrontal LU of a matrix with a symmetric pattern on one process (Duff & Reid, ACM TOMS 9, 1983). CHOLMOD orders the
  // unknowns by METIS' nested dissection and finds the supernodes, blocks of unknowns with the same rows below them. Each block
  // is eliminated as a dense matrix by BLAS. Pivots are sought within a block; one that is too small is enlarged. The factors
  // have seven digits at best, so they only precondition an iteration.
  class SupernodalLu
  {
  public:
    using Vector = dealii::TrilinosWrappers::MPI::Vector;

    SupernodalLu();

    // False: an entry of the matrix is not finite.
    [[nodiscard]] bool factorise(const dealii::TrilinosWrappers::SparseMatrix &matrix);
    void               solve(Vector &x, const Vector &b) const;

    void forget_pattern() { blocks.clear(); } // the next matrix has a new pattern

  private:
    // Unknowns first ... first + width - 1 in the order of elimination, and the unknowns below that they reach.
    struct Block
    {
      int              first, width, parent; // parent: the block that takes its update; -1: none
      std::vector<int> below;                // ascending
      std::vector<int> below_in_parent;      // their positions in the parent's front
      std::vector<int> entries, places;      // of the matrix: index of the value, position in the front
      std::size_t      factors = 0;          // start of the factors of this block
      int              size() const { return width + int(below.size()); }
    };

    void analyse(const int *row_start, const int *columns, int n);
    void place_entries(const int *row_start, const int *columns, const std::vector<int> &position);
    void eliminate(Block &block, const double *values, float smallest_pivot);

    std::vector<int>                     order; // of elimination: unknown of each position
    std::vector<Block>                   blocks;
    dealii::AlignedVector<float>         factors, front, work;
    std::vector<std::vector<float>>      updates; // of each block, until its parent takes them
    std::vector<std::vector<int>>        children;
    std::vector<int>                     pivots;
    mutable dealii::AlignedVector<float> unknowns, gathered;
  };
} // namespace diptych::continuum
