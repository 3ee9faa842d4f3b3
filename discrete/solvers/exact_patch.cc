// diptych: a few contacts solved together and exactly, where sweeps from one to the next find no end
// SPDX-License-Identifier: LGPL-2.1-or-later
#include "discrete/solvers/exact_patch.h"

#include <algorithm>
#include <numeric>

#include "discrete/contact_law.h"

namespace diptych::discrete
{
  namespace
  {
    using Eigen::Index;

    bool moves(const ContactProblem &problem, const int body)
    {
      return problem.free_velocity[body].inverse_mass != 0;
    }

    double mean_mobility(const ContactProblem &problem, const std::vector<int> &rows)
    {
      double sum = 0;
      for (const int row : rows)
        sum += 1 / problem.contacts[row].inverse_wnn;
      return sum / double(rows.size());
    }

    // W = H^T M^-1 H of the rows, normal and tangential in turn [1/mass].
    Eigen::MatrixXd delassus(const ContactProblem &problem, const std::vector<int> &rows)
    {
      const std::size_t         n = rows.size();
      std::vector<BodyVelocity> v = problem.free_velocity;
      for (BodyVelocity &body : v)
        body.x = body.y = body.surface = 0;
      Eigen::MatrixXd w(2 * n, 2 * n);
      for (std::size_t c = 0; c < n; ++c)
        for (const int direction : {0, 1})
          {
            const Impulse unit = direction == 0 ? Impulse{1, 0} : Impulse{0, 1};
            apply_impulse(problem.contacts[rows[c]], unit, v);
            for (std::size_t a = 0; a < n; ++a)
              {
                const RelativeVelocity u                  = relative_velocity(problem.contacts[rows[a]], v);
                w(Index(2 * a), Index(2 * c + direction)) = u.normal,
                                              w(Index(2 * a + 1), Index(2 * c + direction)) = u.tangential;
              }
            apply_impulse(problem.contacts[rows[c]], {-unit.normal, -unit.tangential}, v);
          }
      return w;
    }

    // A of w = A z + q with z = (r_n, s+, mu r_n - r_t), w = (u_n + c_n, mu r_n + r_t, s-); velocities in units of `mobility` x
    // impulse.
    Eigen::MatrixXd pair_matrix(const ContactProblem &problem, const std::vector<int> &rows, const double mobility)
    {
      const Index           n = Index(rows.size());
      const Eigen::MatrixXd w = delassus(problem, rows) / mobility;
      Eigen::MatrixXd       a = Eigen::MatrixXd::Zero(3 * n, 3 * n);
      for (Index c = 0; c < n; ++c)
        {
          const double mu = problem.contacts[rows[c]].friction;
          for (Index k = 0; k < n; ++k)
            {
              a(k, c)                 = w(2 * k, 2 * c) + mu * w(2 * k, 2 * c + 1);
              a(k, 2 * n + c)         = -w(2 * k, 2 * c + 1);
              a(2 * n + k, c)         = -(w(2 * k + 1, 2 * c) + mu * w(2 * k + 1, 2 * c + 1));
              a(2 * n + k, 2 * n + c) = w(2 * k + 1, 2 * c + 1);
            }
          a(n + c, c) = 2 * mu, a(n + c, 2 * n + c) = -1, a(2 * n + c, n + c) = 1;
        }
      return a;
    }

    // Squares of r - P(r), contact by contact.
    std::vector<double> natural_map_squares(const ContactProblem &problem, const std::vector<Impulse> &impulses)
    {
      const std::vector<BodyVelocity> v = velocities(problem, impulses);
      std::vector<double>             squares;
      for (std::size_t k = 0; k < impulses.size(); ++k)
        {
          NaturalMapSquares one;
          one.add(problem.contacts[k], v, impulses[k]);
          squares.push_back(one.difference);
        }
      return squares;
    }

    // Bodies of the contacts with the largest squares, as many as hold `share` of their sum, and of the contacts in `held`.
    std::vector<bool> stalled_bodies(const ContactProblem      &problem,
                                     const std::vector<double> &squares,
                                     const double               share,
                                     const std::vector<int>    &held)
    {
      std::vector<int> by_size(squares.size());
      std::iota(by_size.begin(), by_size.end(), 0);
      std::stable_sort(by_size.begin(), by_size.end(), [&](const int a, const int b) { return squares[a] > squares[b]; });
      const double      all = std::accumulate(squares.begin(), squares.end(), 0.);
      std::vector<bool> stalled(problem.free_velocity.size(), false);
      const auto        mark = [&](const int row) { stalled[problem.contacts[row].i] = stalled[problem.contacts[row].j] = true; };
      double            sum  = 0;
      for (std::size_t k = 0; k < by_size.size() && sum < share * all; ++k)
        sum += squares[by_size[k]], mark(by_size[k]);
      std::for_each(held.begin(), held.end(), mark);
      return stalled;
    }

    // Sets that share no moving body: each body points to an earlier one of its set, the first to itself.
    std::vector<std::vector<int>> separate(const ContactProblem &problem, const std::vector<int> &rows)
    {
      std::vector<int> earlier(problem.free_velocity.size());
      std::iota(earlier.begin(), earlier.end(), 0);
      const auto first_of = [&](int body) {
        while (earlier[body] != body)
          body = earlier[body];
        return body;
      };
      for (const int row : rows)
        if (const ContactRow &c = problem.contacts[row]; moves(problem, c.i) && moves(problem, c.j))
          {
            const int a = first_of(c.i), b = first_of(c.j);
            earlier[std::max(a, b)] = std::min(a, b);
          }
      std::vector<std::vector<int>> sets;
      std::vector<int>              set_of(problem.free_velocity.size(), -1);
      for (const int row : rows)
        {
          const ContactRow &c   = problem.contacts[row];
          int              &set = set_of[first_of(moves(problem, c.i) ? c.i : c.j)];
          if (set < 0)
            set = int(sets.size()), sets.emplace_back();
          sets[set].push_back(row);
        }
      return sets;
    }
  } // namespace

  ExactPatch::ExactPatch(const ContactProblem &problem, std::vector<int> rows)
      : problem_(problem),
        rows_(std::move(rows)),
        mobility_(mean_mobility(problem, rows_)),
        pairs_(pair_matrix(problem, rows_, mobility_))
  {}

  void ExactPatch::add_impulses(const Impulse *impulses, const double factor, std::vector<BodyVelocity> &v) const
  {
    for (std::size_t k = 0; k < rows_.size(); ++k)
      apply_impulse(problem_.contacts[rows_[k]], {factor * impulses[k].normal, factor * impulses[k].tangential}, v);
  }

  double ExactPatch::work() const
  {
    const double n = 3. * double(rows_.size());
    return double(pairs_.n_pivots()) * n * 2 * n;
  }

  bool ExactPatch::solve(std::vector<BodyVelocity> &v, Impulse *impulses)
  {
    const Index n = Index(rows_.size());
    add_impulses(impulses, -1, v);
    Eigen::VectorXd q(3 * n);
    for (Index k = 0; k < n; ++k)
      {
        const ContactRow      &c = problem_.contacts[rows_[k]];
        const RelativeVelocity u = relative_velocity(c, v);
        q[k] = (u.normal + c.normal_term) / mobility_, q[2 * n + k] = -(u.tangential + c.tangential_term) / mobility_;
        q[n + k] = 0;
      }
    // Grains without load would leave the pivots ties without end: bounds on friction are wider than mu r_n by next to nothing,
    // each by another amount.
    const double largest = q.cwiseAbs().maxCoeff();
    for (Index k = 0; k < n; ++k)
      q[n + k] = 1e-12 * largest * (1 + 0.618 * double(k % 97) / 97);
    const std::optional<Eigen::VectorXd> z = largest > 0 ? pairs_.solve(q) : Eigen::VectorXd::Zero(3 * n);
    for (Index k = 0; z && k < n; ++k)
      {
        const double normal = (*z)[k], bound = problem_.contacts[rows_[k]].friction * normal;
        impulses[k] = {normal, std::clamp(bound - (*z)[2 * n + k], -bound, bound)};
      }
    add_impulses(impulses, 1, v);
    return z.has_value();
  }

  std::vector<std::vector<int>> stalled_contacts(const ContactProblem       &problem,
                                                 const std::vector<Impulse> &impulses,
                                                 const std::vector<int>     &held)
  {
    constexpr double        share   = 0.9;
    constexpr std::size_t   most    = 250;
    const std::vector<bool> stalled = stalled_bodies(problem, natural_map_squares(problem, impulses), share, held);
    const auto              inside  = [&](const int body) { return stalled[body] || !moves(problem, body); };
    std::vector<int>        rows;
    for (std::size_t k = 0; k < problem.contacts.size(); ++k)
      if (const ContactRow &c = problem.contacts[k]; inside(c.i) && inside(c.j) && (moves(problem, c.i) || moves(problem, c.j)))
        rows.push_back(int(k));
    if (rows.size() > most)
      return {};
    return separate(problem, rows);
  }
} // namespace diptych::discrete
