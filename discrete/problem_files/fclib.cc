// diptych: reads contact problems in the layout of FCLIB
// SPDX-License-Identifier: LGPL-2.1-or-later
#include "discrete/problem_files/fclib.h"

#include <algorithm>
#include <limits>

#include <Eigen/SparseCholesky>

#include "discrete/problem_files/fclib_input.h"

namespace diptych::discrete
{
  namespace
  {
    using Matrix = Eigen::SparseMatrix<double>;

    void refuse_equalities(const FclibInput &file, const std::string &matrix)
    {
      if (!file.has(matrix + "/x"))
        return;
      for (const double value : file.numbers(matrix + "/x"))
        if (value != 0)
          file.refuse(matrix, "equality constraints are not supported");
    }

    Eigen::VectorXd read_friction(const FclibInput &file, const std::string &group)
    {
      if (!file.has(group))
        file.refuse(group, "is missing");
      if (const int dimension = file.integer(group + "/spacedim"); dimension != 2)
        file.refuse(group + "/spacedim", text("is ", dimension, "; only plane problems (2) can be read"));
      const std::vector<double> mu = file.numbers(group + "/vectors/mu");
      for (std::size_t k = 0; k < mu.size(); ++k)
        if (mu[k] < 0)
          file.refuse(group + "/vectors/mu", text("contact ", k, " has the negative friction ", mu[k]));
      return Eigen::Map<const Eigen::VectorXd>(mu.data(), Eigen::Index(mu.size()));
    }

    // A contact of two immovable bodies has no unique solution.
    void require_positive_diagonal(const FclibInput &file, const std::string &name, const Matrix &w)
    {
      for (int a = 0; a < w.rows(); ++a)
        if (const double value = w.coeff(a, a); !(value > 0))
          file.refuse(name, text("diagonal entry ", a, " (", a % 2 == 0 ? "normal" : "tangential", " direction of contact ",
                                 a / 2, ") is ", value, "; it must be positive"));
    }

    DelassusProblem read_local(const FclibInput &file)
    {
      const std::string     group = "/fclib_local";
      const Eigen::VectorXd mu    = read_friction(file, group);
      refuse_equalities(file, group + "/V");
      refuse_equalities(file, group + "/R");
      const Matrix w = file.matrix(group + "/W", 2 * mu.size(), 2 * mu.size());
      require_positive_diagonal(file, group + "/W", w);
      return delassus_problem(w, file.vector(group + "/vectors/q", 2 * mu.size()), mu);
    }

    bool is_diagonal(const Matrix &m)
    {
      for (int column = 0; column < m.outerSize(); ++column)
        for (Matrix::InnerIterator entry(m, column); entry; ++entry)
          if (entry.row() != entry.col() && entry.value() != 0)
            return false;
      return true;
    }

    // M^-1 b of a symmetric positive definite M, diagonal for rigid bodies.
    class InverseMass
    {
    public:
      InverseMass(const FclibInput &file, const std::string &name, const Matrix &m)
          : diagonal_(m.diagonal()),
            is_diagonal_(is_diagonal(m))
      {
        if (Matrix(m - Matrix(m.transpose())).norm() > 1e-10 * m.norm())
          file.refuse(name, "is not symmetric");
        if (!is_diagonal_)
          factors_.compute(m);
        if (is_diagonal_ ? (diagonal_.array() <= 0).any()
                         : factors_.info() != Eigen::Success || (factors_.vectorD().array() <= 0).any())
          file.refuse(name, "is not positive definite");
      }

      template <class Right> Right times(const Right &b) const
      {
        if (is_diagonal_)
          return diagonal_.cwiseInverse().asDiagonal() * b;
        return factors_.solve(b);
      }

    private:
      Eigen::VectorXd               diagonal_;
      bool                          is_diagonal_;
      Eigen::SimplicialLDLT<Matrix> factors_;
    };

    DelassusProblem read_global(const FclibInput &file)
    {
      const std::string     group = "/fclib_global";
      const Eigen::VectorXd mu    = read_friction(file, group);
      refuse_equalities(file, group + "/G");
      const std::vector<double> f = file.numbers(group + "/vectors/f");
      const auto                n = Eigen::Index(f.size());
      const Matrix              m = file.matrix(group + "/M", n, n), h = file.matrix(group + "/H", n, 2 * mu.size());
      const Eigen::VectorXd     w = file.vector(group + "/vectors/w", 2 * mu.size());
      const InverseMass         inverse_mass(file, group + "/M", m);
      const Matrix              delassus = h.transpose() * inverse_mass.times(h);
      require_positive_diagonal(file, group + ": H^T M^-1 H", delassus);
      return delassus_problem(
        delassus, h.transpose() * inverse_mass.times(Eigen::VectorXd(Eigen::Map<const Eigen::VectorXd>(f.data(), n))) + w, mu);
    }

    // If a file has both forms, the local one is solved. The global one is only copied to the file of the solution, so its
    // numbers are checked here.
    void require_numbers_of_global(const FclibInput &file)
    {
      for (const char *part : {"/M/x", "/H/x", "/vectors/f", "/vectors/w", "/vectors/mu"})
        if (const std::string name = std::string("/fclib_global") + part; file.has(name))
          (void)file.numbers(name);
    }

    std::vector<Impulse> read_impulses(const FclibInput &file, const std::string &name, const std::size_t n_contacts)
    {
      const std::vector<double> r = file.numbers(name, 2 * n_contacts);
      std::vector<Impulse>      impulses;
      for (std::size_t k = 0; k < n_contacts; ++k)
        impulses.push_back({r[2 * k], r[2 * k + 1]});
      return impulses;
    }

    void read_rolling(const FclibInput &file, StoredProblem &problem)
    {
      if (!problem.bodies)
        file.refuse("/rolling", "contacts resist rolling, which needs the bodies, but " + problem.reason);
      const std::size_t         n        = problem.local.n_contacts();
      const std::vector<double> friction = file.numbers("/rolling/friction", n), arm = file.numbers("/rolling/arm", n);
      for (std::size_t k = 0; k < n; ++k)
        set_rolling(friction[k], arm[k], problem.bodies->contacts[k]);
      problem.rolls = true;
      if (file.has("/solution/rolling"))
        {
          const std::vector<double> rolling = file.numbers("/solution/rolling", problem.solution.size());
          for (std::size_t k = 0; k < rolling.size(); ++k)
            problem.solution[k].rolling = rolling[k];
        }
    }
  } // namespace

  std::string StoredProblem::obstacle(const ProblemForm wanted) const
  {
    if (wanted == ProblemForm::body)
      return bodies ? "" : reason;
    return rolls ? "its contacts resist rolling, and only the body form contains couples" : "";
  }

  SolveReport StoredProblem::solve(const ProblemForm     chosen,
                                   SolverOptions         options,
                                   std::vector<Impulse> &impulses,
                                   ThreadTeam           &team) const
  {
    constexpr double per_tolerance = 100; // grains of a packing press on each other with about 100 times |q| / W
    options.velocity_tolerance     = std::min(options.velocity_tolerance, per_tolerance * options.tolerance);
    return chosen == ProblemForm::body ? discrete::solve(*bodies, options, impulses, team)
                                       : discrete::solve(local, options, impulses);
  }

  std::vector<RelativeVelocity> StoredProblem::velocities(const std::vector<Impulse> &impulses) const
  {
    return rolls ? relative_velocities(*bodies, impulses) : relative_velocities(local, impulses);
  }

  double StoredProblem::siconos_residual(const std::vector<Impulse> &impulses) const
  {
    return rolls ? std::numeric_limits<double>::quiet_NaN() : discrete::siconos_residual(local, impulses);
  }

  DelassusProblem read_fclib_local(const std::string &path)
  {
    return read_local(FclibInput(path));
  }

  DelassusProblem read_fclib_global(const std::string &path)
  {
    return read_global(FclibInput(path));
  }

  StoredProblem read_fclib(const std::string &path)
  {
    const FclibInput file(path);
    if (!file.has("/fclib_local") && !file.has("/fclib_global"))
      file.refuse("/", "has neither /fclib_local nor /fclib_global");
    StoredProblem problem;
    require_numbers_of_global(file);
    problem.local       = file.has("/fclib_local") ? read_local(file) : read_global(file);
    const BodyForm form = read_body_form(file, problem.local);
    problem.bodies      = form.bodies;
    problem.form        = form.bodies ? ProblemForm::body : ProblemForm::local;
    problem.reason      = form.reason;
    if (form.bodies)
      problem.local.order = form.bodies->order;
    const std::size_t n = problem.local.n_contacts();
    if (file.has("/solution"))
      problem.solution = read_impulses(file, "/solution/r", n);
    if (file.has("/guesses"))
      for (int k = 1; k <= file.integer("/guesses/number_of_guesses"); ++k)
        problem.guesses.push_back(read_impulses(file, text("/guesses/", k, "/r"), n));
    if (file.has("/rolling"))
      read_rolling(file, problem);
    return problem;
  }
} // namespace diptych::discrete
