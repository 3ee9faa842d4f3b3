// diptych: FCLIB files as unchecked input
// SPDX-License-Identifier: LGPL-2.1-or-later
#include "discrete/problem_files/fclib_input.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace diptych::discrete
{
  namespace
  {
    // Errors that the reader reports for a file count as wrong input here.
    template <class Function> auto as_input(Function &&function)
    {
      try
        {
          return function();
        }
      catch (const std::runtime_error &error)
        {
          throw std::invalid_argument(error.what());
        }
    }
  } // namespace

  FclibInput::FclibInput(const std::string &path)
      : path_(path),
        reader_(as_input([&] { return Hdf5Reader(path); }))
  {}

  void FclibInput::refuse(const std::string &name, const std::string &what) const
  {
    throw std::invalid_argument(path_ + ": " + name + ": " + what);
  }

  std::vector<double> FclibInput::numbers(const std::string &name) const
  {
    if (!has(name))
      refuse(name, "is missing");
    const std::vector<double> values = as_input([&] { return reader_.read(name); });
    for (std::size_t k = 0; k < values.size(); ++k)
      if (!std::isfinite(values[k]))
        refuse(name, text("entry ", k, " is ", values[k], ", not a finite number"));
    return values;
  }

  std::vector<double> FclibInput::numbers(const std::string &name, const std::size_t n) const
  {
    const std::vector<double> values = numbers(name);
    if (values.size() != n)
      refuse(name, text("has ", values.size(), " entries where ", n, " are needed"));
    return values;
  }

  std::vector<int> FclibInput::integers(const std::string &name) const
  {
    std::vector<int> values;
    for (const double value : numbers(name))
      {
        if (value != std::floor(value) || std::abs(value) > 2e9)
          refuse(name, text(value, " is not a whole number below 2e9"));
        values.push_back(int(value));
      }
    return values;
  }

  int FclibInput::integer(const std::string &name) const
  {
    const std::vector<int> values = integers(name);
    if (values.size() != 1)
      refuse(name, text("has ", values.size(), " entries where 1 is needed"));
    return values[0];
  }

  Eigen::VectorXd FclibInput::vector(const std::string &name, const std::size_t n) const
  {
    const std::vector<double> values = numbers(name, n);
    return Eigen::Map<const Eigen::VectorXd>(values.data(), Eigen::Index(n));
  }

  FclibInput::Places FclibInput::compressed(const std::string &name, const int n_lines) const
  {
    const std::vector<int> p = integers(name + "/p"), i = integers(name + "/i");
    if (p.size() != std::size_t(n_lines) + 1)
      refuse(name + "/p", text("has ", p.size(), " offsets where ", n_lines + 1, " are needed"));
    if (p.front() != 0 || !std::is_sorted(p.begin(), p.end()))
      refuse(name + "/p", "offsets must start at 0 and must not decrease");
    if (std::size_t(p.back()) > i.size())
      refuse(name + "/i", text("has ", i.size(), " entries where the offsets end at ", p.back()));
    Places entries;
    for (int line = 0; line < n_lines; ++line)
      for (int k = p[line]; k < p[line + 1]; ++k)
        entries.emplace_back(line, i[k]);
    return entries;
  }

  FclibInput::Places FclibInput::places(const std::string &name, const int m, const int n) const
  {
    const int nz = integer(name + "/nz");
    Places    entries;
    if (nz == -2)
      return compressed(name, m);
    if (nz == -1)
      {
        entries = compressed(name, n);
        for (auto &[row, column] : entries)
          std::swap(row, column);
        return entries;
      }
    if (nz < -2)
      refuse(name + "/nz", text("is ", nz, "; -2 (rows), -1 (columns) or a number of triplets is needed"));
    const std::vector<int> p = integers(name + "/p"), i = integers(name + "/i");
    if (p.size() < std::size_t(nz) || i.size() < std::size_t(nz))
      refuse(name + "/p", text("has ", p.size(), " columns and ", i.size(), " rows for ", nz, " triplets"));
    for (int k = 0; k < nz; ++k)
      entries.emplace_back(i[k], p[k]);
    return entries;
  }

  Eigen::SparseMatrix<double> FclibInput::matrix(const std::string &name, const long n_rows, const long n_columns) const
  {
    const int m = integer(name + "/m"), n = integer(name + "/n");
    if (m != n_rows || n != n_columns)
      refuse(name, text("is ", m, " x ", n, " where ", n_rows, " x ", n_columns, " is needed"));
    const Places              entries = places(name, m, n);
    const std::vector<double> x       = numbers(name + "/x");
    if (x.size() < entries.size())
      refuse(name + "/x", text("has ", x.size(), " values for ", entries.size(), " entries"));
    std::vector<Eigen::Triplet<double>> triplets;
    for (std::size_t k = 0; k < entries.size(); ++k)
      {
        const auto [row, column] = entries[k];
        if (row < 0 || row >= m || column < 0 || column >= n)
          refuse(name, text("entry ", k, " lies at (", row, ", ", column, ") of a ", m, " x ", n, " matrix"));
        triplets.emplace_back(row, column, x[k]);
      }
    Eigen::SparseMatrix<double> matrix(m, n);
    matrix.setFromTriplets(triplets.begin(), triplets.end());
    return matrix;
  }

} // namespace diptych::discrete
