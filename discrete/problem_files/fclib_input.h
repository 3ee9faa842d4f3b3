// diptych: FCLIB files as unchecked input
// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <optional>
#include <sstream>
#include <string>
#include <vector>

#include <Eigen/SparseCore>

#include "discrete/contacts/contact_problem.h"
#include "discrete/problem_files/delassus_problem.h"
#include "discrete/files/hdf5_file.h"

namespace diptych::discrete
{
  template <class... Parts> std::string text(const Parts &...parts)
  {
    std::ostringstream out;
    (out << ... << parts);
    return out.str();
  }

  // An HDF5 file as input. On any defect its functions throw std::invalid_argument with file, dataset and values.
  class FclibInput
  {
  public:
    explicit FclibInput(const std::string &path);

    [[noreturn]] void refuse(const std::string &name, const std::string &what) const;

    bool                has(const std::string &name) const { return reader_.has(name); }
    std::vector<double> numbers(const std::string &name) const; // all finite
    std::vector<double> numbers(const std::string &name, std::size_t n) const;
    std::vector<int>    integers(const std::string &name) const;
    int                 integer(const std::string &name) const;
    Eigen::VectorXd     vector(const std::string &name, std::size_t n) const;

    // Matrix stored by rows (nz = -2: p row offsets, i columns), by columns (nz = -1: p column offsets, i rows) or as nz triplets
    // (p columns, i rows). Entries at the same place are added.
    Eigen::SparseMatrix<double> matrix(const std::string &name, long n_rows, long n_columns) const;

  private:
    using Places = std::vector<std::pair<int, int>>; // (row, column) of each entry

    Places places(const std::string &name, int m, int n) const;
    Places compressed(const std::string &name, int n_lines) const;

    std::string path_;
    Hdf5Reader  reader_;
  };

  // Body form of /nscd, with the rows in the order of the file and swept upward, or the reason why there is none.
  struct BodyForm
  {
    std::optional<ContactProblem> bodies;
    std::string                   reason;
  };

  // `local` holds W, q and mu of the same file. Throws like FclibInput if /nscd is malformed.
  BodyForm read_body_form(const FclibInput &file, const DelassusProblem &local);
} // namespace diptych::discrete
