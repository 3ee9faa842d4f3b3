// diptych: sparse LU factors by UMFPACK
// SPDX-License-Identifier: LGPL-2.1-or-later
#include "continuum/equilibrium/umfpack.h"

#include <dlfcn.h>

#include <Epetra_CrsMatrix.h>

#include <suitesparse/umfpack.h>

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

    void free_symbolic(void *symbolic)
    {
      umfpack_di_free_symbolic(&symbolic);
    }
    void free_numeric(void *numeric)
    {
      umfpack_di_free_numeric(&numeric);
    }
  } // namespace

  Umfpack::Umfpack()
      : control(UMFPACK_CONTROL),
        symbolic(nullptr, &free_symbolic),
        numeric(nullptr, &free_numeric)
  {
    use_one_blas_thread();
    umfpack_di_defaults(control.data());
    control[UMFPACK_IRSTEP] = 0;
  }

  void Umfpack::forget_factors()
  {
    numeric.reset();
    values.clear();
  }

  void Umfpack::forget_pattern()
  {
    forget_factors();
    symbolic.reset();
    analysed_values.clear();
  }

  // Compressed rows are the compressed columns of the transpose, so UMFPACK factorises the transpose.
  void Umfpack::take_pattern(const dealii::TrilinosWrappers::SparseMatrix &matrix)
  {
    int    *start = nullptr, *column = nullptr;
    double *value = nullptr;
    auto   &crs   = const_cast<Epetra_CrsMatrix &>(matrix.trilinos_matrix());
    crs.ExtractCrsDataPointers(start, column, value);
    const int n = crs.NumMyRows(), n_entries = start[n];
    row_start.assign(start, start + n + 1);
    columns.assign(column, column + n_entries);
    values.assign(value, value + n_entries);
  }

  // The analysis also depends on the values.
  bool Umfpack::analyse()
  {
    const int n      = int(row_start.size()) - 1;
    void     *handle = nullptr;
    if (umfpack_di_symbolic(n, n, row_start.data(), columns.data(), values.data(), &handle, control.data(), nullptr) !=
        UMFPACK_OK)
      return false;
    symbolic.reset(handle);
    analysed_values = values;
    return true;
  }

  bool Umfpack::make_factors()
  {
    numeric.reset();
    void     *handle = nullptr;
    const int status = umfpack_di_numeric(row_start.data(), columns.data(), values.data(), symbolic.get(), &handle,
                                          control.data(), nullptr);
    numeric.reset(handle);
    if (status != UMFPACK_OK) // after a warning of singularity the factors must not be used
      forget_factors();
    return numeric != nullptr;
  }

  bool Umfpack::factorise(const dealii::TrilinosWrappers::SparseMatrix &matrix)
  {
    take_pattern(matrix);
    numeric.reset();
    return (symbolic || analyse()) && make_factors();
  }

  bool Umfpack::take_up(const dealii::TrilinosWrappers::SparseMatrix &pattern,
                        const std::vector<double>                    &analysed,
                        const std::vector<double>                    &factorised)
  {
    forget_pattern();
    take_pattern(pattern);
    const std::size_t n_entries = values.size();
    bool              done      = analysed.size() == n_entries && (factorised.empty() || factorised.size() == n_entries);
    if (done)
      {
        values = analysed;
        done   = analyse();
      }
    values.clear();
    if (done && !factorised.empty())
      {
        values = factorised;
        done   = make_factors();
      }
    return done;
  }

  void Umfpack::solve(Vector &x, const Vector &b) const
  {
    umfpack_di_solve(UMFPACK_At, row_start.data(), columns.data(), values.data(), x.begin(), b.begin(), numeric.get(),
                     control.data(), nullptr);
  }
} // namespace diptych::continuum
