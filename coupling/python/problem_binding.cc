// diptych: Python binding of the solver of contact problems
// SPDX-License-Identifier: LGPL-2.1-or-later
#include <optional>

#include <pybind11/stl.h>

#include "coupling/python/bindings.h"
#include "coupling/python/inputs.h"
#include "discrete/problem_files/fclib.h"
#include "discrete/solvers/solver.h"

namespace diptych::python
{
  namespace
  {
    using Impulses = std::vector<discrete::Impulse>;

    discrete::SolverOptions solver_options(const py::dict &given)
    {
      discrete::SolverOptions options = discrete::stored_solver_options();
      py::dict                keys    = given.attr("copy")();
      options.tolerance               = keys.attr("pop")("tolerance").cast<double>();
      if (!(options.tolerance > 0))
        throw std::invalid_argument("tolerance must be positive");
      set_options("discrete", keys, options);
      return options;
    }

    Impulses first_guess(const py::object &guess, const std::size_t n)
    {
      Impulses r(n);
      if (guess.is_none())
        return r;
      const auto given = vectors_of(guess.cast<Numbers>(), "guess");
      if (given.size() != n)
        throw std::invalid_argument("guess: one impulse per contact is needed: " + std::to_string(n) + ", not " +
                                    std::to_string(given.size()));
      for (std::size_t k = 0; k < n; ++k)
        r[k] = {given[k].x(), given[k].y()};
      return r;
    }

    // Columns: normal part, tangential part.
    template <class Pair> py::array columns_of(const std::vector<Pair> &pairs)
    {
      std::vector<Eigen::Vector2d> rows;
      for (const Pair &pair : pairs)
        rows.emplace_back(pair.normal, pair.tangential);
      return own(std::move(rows));
    }

    py::dict solution(const discrete::SolveReport &report, const discrete::StoredProblem &problem, const Impulses &r)
    {
      py::dict dict;
      dict["status"]           = discrete::name_of(report.status);
      dict["sweeps"]           = report.sweeps;
      dict["residual"]         = report.residual;
      dict["velocity_error"]   = report.velocity_error;
      dict["siconos_residual"] = problem.siconos_residual(r);
      dict["cpu_s"]            = report.cpu_s;
      dict["r"]                = columns_of(r);
      dict["u"]                = columns_of(problem.velocities(r));
      if (problem.rolls)
        {
          std::vector<double> rolling;
          for (const discrete::Impulse &each : r)
            rolling.push_back(each.rolling);
          dict["rolling"] = own(std::move(rolling));
        }
      return dict;
    }

    py::dict solve_file(const std::string                &path,
                        const std::optional<std::string> &form,
                        const py::object                 &guess,
                        const py::dict                   &keys)
    {
      const discrete::SolverOptions options = solver_options(keys);
      const discrete::StoredProblem problem = discrete::read_fclib(path);
      const auto                    wanted  = form ? discrete::value_of<discrete::ProblemForm>(*form) : problem.form;
      if (!wanted)
        throw std::invalid_argument("form = '" + *form + "' is not allowed; use body or local");
      if (const std::string obstacle = problem.obstacle(*wanted); !obstacle.empty())
        throw std::invalid_argument("form = '" + discrete::name_of(*wanted) + "': " + path + " has no such form: " + obstacle);
      Impulses              r = first_guess(guess, problem.local.n_contacts());
      discrete::SolveReport report;
      {
        const py::gil_scoped_release release;
        discrete::ThreadTeam         team(1);
        report = problem.solve(*wanted, options, r, team);
      }
      return solution(report, problem, r);
    }

    // w: indptr, indices and data of SciPy's csr_matrix.
    py::dict solve_arrays(const py::tuple  &w,
                          const Numbers    &q,
                          const Numbers    &friction,
                          const py::object &guess,
                          const py::dict   &keys)
    {
      const discrete::SolverOptions options = solver_options(keys);
      const auto begin = indices_of(w[0].cast<Indices>(), "W.indptr"), column = indices_of(w[1].cast<Indices>(), "W.indices");
      const auto value = numbers_of(w[2].cast<Numbers>(), "W.data"), velocity = numbers_of(q, "q"),
                 mu = numbers_of(friction, "mu");
      const long n  = 2 * long(mu.size());
      if (long(velocity.size()) != n || long(begin.size()) != n + 1)
        throw std::invalid_argument("for " + std::to_string(mu.size()) + " contacts (mu) W must have " + std::to_string(n) +
                                    " rows and q as many entries");
      std::vector<Eigen::Triplet<double>> entries;
      for (long row = 0; row < n; ++row)
        for (int k = begin[std::size_t(row)]; k < begin[std::size_t(row) + 1]; ++k)
          {
            if (k < 0 || k >= int(value.size()) || k >= int(column.size()) || column[std::size_t(k)] < 0 ||
                column[std::size_t(k)] >= n)
              throw std::invalid_argument("W: entry " + std::to_string(k) + " lies outside the matrix");
            entries.emplace_back(int(row), column[std::size_t(k)], value[std::size_t(k)]);
          }
      Eigen::SparseMatrix<double, Eigen::RowMajor> matrix(n, n);
      matrix.setFromTriplets(entries.begin(), entries.end());
      const auto as_vector = [](const std::vector<double> &v) {
        return Eigen::Map<const Eigen::VectorXd>(v.data(), long(v.size()));
      };
      for (long row = 0; row < n; ++row)
        if (!(matrix.coeff(row, row) > 0))
          throw std::invalid_argument("W[" + std::to_string(row) + ", " + std::to_string(row) + "] must be positive");
      discrete::StoredProblem problem;
      problem.local           = discrete::delassus_problem(matrix, as_vector(velocity), as_vector(mu));
      Impulses              r = first_guess(guess, mu.size());
      discrete::SolveReport report;
      {
        const py::gil_scoped_release release;
        discrete::ThreadTeam         team(1);
        report = problem.solve(discrete::ProblemForm::local, options, r, team);
      }
      return solution(report, problem, r);
    }
  } // namespace

  void bind_problems(py::module_ &m)
  {
    m.def("solve_file", &solve_file);
    m.def("solve_arrays", &solve_arrays);
  }
} // namespace diptych::python
