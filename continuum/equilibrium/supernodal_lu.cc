// diptych: sparse LU factors in single precision, a preconditioner
// SPDX-License-Identifier: LGPL-2.1-or-later
#include "continuum/equilibrium/supernodal_lu.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <new>

#include <dlfcn.h>

#include <Epetra_CrsMatrix.h>

#include <deal.II/lac/lapack_templates.h>

#include <suitesparse/cholmod.h>

namespace diptych::continuum
{
  namespace
  {
    // OpenBLAS would distribute the small dense blocks over all cores. That costs a third more CPU time (33000 unknowns, two
    // cores), and the bits depend on the number of threads. Other BLAS libraries neither have nor need this function.
    void use_one_blas_thread()
    {
      if (void *function = dlsym(RTLD_DEFAULT, "openblas_set_num_threads"))
        reinterpret_cast<void (*)(int)>(function)(1);
    }

    // A dense block within columns that lie `stride` apart.
    struct Columns
    {
      float *data;
      int    stride;
    };

    // C = alpha A B + beta C, with A^T and B^T if `transpose` is "T". C has m x n entries, A has k columns.
    void multiply(const char                   *transpose,
                  const std::array<int, 3>     &mnk,
                  const std::array<float, 2>   &factors,
                  const std::array<Columns, 3> &abc)
    {
      const auto &[m, n, k]     = mnk;
      const auto &[alpha, beta] = factors;
      const auto &[A, B, C]     = abc;
      if (m > 0 && n > 0)
        dealii::gemm(transpose, transpose, &m, &n, &k, &alpha, A.data, &A.stride, B.data, &B.stride, &beta, C.data, &C.stride);
    }
  } // namespace

  SupernodalLu::SupernodalLu()
  {
    use_one_blas_thread();
    // Without room for its buffer OpenBLAS would ask for it without end; this throws std::bad_alloc.
    static const std::size_t buffer = [] {
      std::vector<char> room;
      room.reserve(std::size_t(1) << 27);
      return room.capacity();
    }();
    static_cast<void>(buffer);
  }

  // Rows of the matrix from the diagonal on are the columns of its lower half, because the pattern is symmetric.
  void SupernodalLu::analyse(const int *row_start, const int *columns, const int n)
  {
    cholmod_common common;
    cholmod_start(&common);
    common.nmethods           = 1;
    common.method[0].ordering = CHOLMOD_METIS;
    common.supernodal         = CHOLMOD_SUPERNODAL;
    common.print              = 0;
    cholmod_sparse *half      = cholmod_allocate_sparse(n, n, row_start[n], 1, 1, -1, CHOLMOD_PATTERN, &common);
    auto           *start = static_cast<int *>(half->p), *rows = static_cast<int *>(half->i);
    start[0] = 0;
    for (int i = 0; i < n; ++i)
      {
        const int *row = columns + row_start[i], *end = columns + row_start[i + 1];
        rows         = std::copy_if(row, end, rows, [&](const int j) { return j >= i; });
        start[i + 1] = int(rows - static_cast<int *>(half->i));
      }
    half->sorted           = 0;
    cholmod_factor *factor = cholmod_analyze(half, &common);
    if (factor == nullptr)
      throw std::bad_alloc();

    const auto *permutation = static_cast<const int *>(factor->Perm), *super = static_cast<const int *>(factor->super),
               *pointer = static_cast<const int *>(factor->pi), *row = static_cast<const int *>(factor->s);
    order.assign(permutation, permutation + n);
    blocks.clear();
    std::size_t entries = 0;
    for (std::size_t b = 0; b < factor->nsuper; ++b)
      {
        Block block;
        block.first = super[b];
        block.width = super[b + 1] - super[b];
        block.below.assign(row + pointer[b] + block.width, row + pointer[b + 1]);
        block.factors = entries;
        entries += (std::size_t(block.size()) + block.below.size()) * block.width;
        blocks.push_back(std::move(block));
      }
    cholmod_free_factor(&factor, &common);
    cholmod_free_sparse(&half, &common);
    cholmod_finish(&common);

    factors.resize_fast(entries);
    std::vector<int> position(n);
    for (int k = 0; k < n; ++k)
      position[order[k]] = k;
    place_entries(row_start, columns, position);
  }

  void SupernodalLu::place_entries(const int *row_start, const int *columns, const std::vector<int> &position)
  {
    const int        n = int(order.size());
    std::vector<int> block_of(n), local(n);
    for (std::size_t b = 0; b < blocks.size(); ++b)
      for (int k = 0; k < blocks[b].width; ++k)
        block_of[blocks[b].first + k] = int(b);
    children.assign(blocks.size(), {});
    const auto number = [&](const Block &block) {
      for (int k = 0; k < block.width; ++k)
        local[block.first + k] = k;
      for (std::size_t k = 0; k < block.below.size(); ++k)
        local[block.below[k]] = block.width + int(k);
    };
    int largest = 0;
    for (std::size_t b = 0; b < blocks.size(); ++b)
      {
        Block &block = blocks[b];
        largest      = std::max(largest, block.size());
        block.parent = block.below.empty() ? -1 : block_of[block.below.front()];
        if (block.parent >= 0)
          children[block.parent].push_back(int(b));
        number(block);
        for (int k = block.first; k < block.first + block.width; ++k)
          {
            const int i = order[k];
            for (int e = row_start[i]; e < row_start[i + 1]; ++e)
              {
                const int j = position[columns[e]];
                if (j < block.first)
                  continue;
                block.entries.push_back(e);
                block.places.push_back(local[k] + block.size() * local[j]);
                if (j < block.first + block.width)
                  continue;
                const int  row   = columns[e];
                const int *other = std::find(columns + row_start[row], columns + row_start[row + 1], i);
                block.entries.push_back(int(other - columns));
                block.places.push_back(local[j] + block.size() * local[k]);
              }
          }
      }
    for (std::size_t p = 0; p < blocks.size(); ++p)
      {
        number(blocks[p]);
        for (const int child : children[p])
          {
            blocks[child].below_in_parent.clear();
            for (const int row : blocks[child].below)
              blocks[child].below_in_parent.push_back(local[row]);
          }
      }
    front.resize_fast(std::size_t(largest) * largest);
    work.resize_fast(std::size_t(64) * largest);
    unknowns.resize_fast(n);
    gathered.resize_fast(largest);
    pivots.resize(largest);
    updates.resize(blocks.size());
  }

  // The front [A B; C D] of a block becomes the inverse of A, A^-1 B, C A^-1, and the update D - C A^-1 B.
  void SupernodalLu::eliminate(Block &block, const double *values, const float smallest_pivot)
  {
    const int m = block.size(), k = block.width, n = m - k;
    float    *F = front.data();
    std::fill(F, F + std::size_t(m) * m, 0.f);
    for (std::size_t e = 0; e < block.entries.size(); ++e)
      F[block.places[e]] = float(values[block.entries[e]]);
    for (const int c : children[&block - blocks.data()])
      {
        const auto  &place = blocks[c].below_in_parent;
        const int    size  = int(place.size());
        const float *from  = updates[c].data();
        for (int j = 0; j < size; ++j, from += size)
          {
            float *column = F + std::size_t(m) * place[j];
            for (int i = 0; i < size; ++i)
              column[place[i]] += from[i];
          }
        updates[c] = {};
      }
    dealii::types::blas_int info = 0;
    dealii::getrf(&k, &k, F, &m, pivots.data(), &info);
    for (int i = 0; i < k; ++i)
      {
        float &pivot = F[std::size_t(i) * (m + 1)];
        if (std::abs(pivot) < smallest_pivot)
          pivot = std::copysign(smallest_pivot, pivot);
      }
    const int n_work = int(work.size());
    dealii::getri(&k, F, &m, pivots.data(), work.data(), &n_work, &info);

    float *upper = &factors[block.factors], *lower = upper + std::size_t(m) * k; // [A^-1, -A^-1 B] transposed; C A^-1
    for (int i = 0; i < k; ++i)
      for (int j = 0; j < k; ++j)
        upper[i + std::size_t(m) * j] = F[j + std::size_t(m) * i];
    const Columns A{F, m}, B{F + std::size_t(m) * k, m}, C{F + k, m}, D{F + std::size_t(m) * k + k, m};
    multiply("T", {n, k, k}, {-1, 0}, {B, A, {upper + k, m}});
    multiply("N", {n, k, k}, {1, 0}, {C, A, {lower, n}});
    if (n == 0)
      return;
    multiply("N", {n, n, k}, {-1, 1}, {Columns{lower, n}, B, D});
    auto &update = updates[&block - blocks.data()];
    update.resize(std::size_t(n) * n);
    for (int j = 0; j < n; ++j)
      std::copy(D.data + std::size_t(m) * j, D.data + std::size_t(m) * j + n, update.data() + std::size_t(n) * j);
  }

  bool SupernodalLu::factorise(const dealii::TrilinosWrappers::SparseMatrix &matrix)
  {
    int    *row_start = nullptr, *columns = nullptr;
    double *values = nullptr;
    auto   &crs    = const_cast<Epetra_CrsMatrix &>(matrix.trilinos_matrix());
    crs.ExtractCrsDataPointers(row_start, columns, values);
    const int n = crs.NumMyRows();
    if (blocks.empty())
      analyse(row_start, columns, n);
    double largest = 0;
    for (int e = 0; e < row_start[n]; ++e)
      if (!(std::abs(values[e]) <= largest))
        largest = std::abs(values[e]);
    if (!std::isfinite(largest))
      return false;
    for (Block &block : blocks)
      eliminate(block, values, float(1e-7 * largest));
    return true;
  }

  void SupernodalLu::solve(Vector &x, const Vector &b) const
  {
    float        *y    = unknowns.data();
    const double *from = b.begin();
    for (std::size_t k = 0; k < order.size(); ++k)
      y[k] = float(from[order[k]]);
    const char  no = 'N', yes = 'T';
    const int   one  = 1;
    const float plus = 1, zero = 0;
    for (const Block &block : blocks)
      {
        const int m = block.size(), k = block.width, n = m - k;
        if (n == 0)
          continue;
        dealii::gemv(&no, &n, &k, &plus, &factors[block.factors + std::size_t(m) * k], &n, y + block.first, &one, &zero,
                     gathered.data(), &one);
        for (int i = 0; i < n; ++i)
          y[block.below[i]] -= gathered[i];
      }
    for (auto block = blocks.rbegin(); block != blocks.rend(); ++block)
      {
        const int m = block->size(), k = block->width;
        std::copy(y + block->first, y + block->first + k, gathered.data());
        for (int i = k; i < m; ++i)
          gathered[i] = y[block->below[i - k]];
        dealii::gemv(&yes, &m, &k, &plus, &factors[block->factors], &m, gathered.data(), &one, &zero, y + block->first, &one);
      }
    double *to = x.begin();
    for (std::size_t k = 0; k < order.size(); ++k)
      to[order[k]] = y[k];
  }
} // namespace diptych::continuum
