// diptych: the few contacts on which sweeps stall, and sweeps over them only
// SPDX-License-Identifier: LGPL-2.1-or-later
#include "discrete/solvers/stalled_contacts.h"

#include <algorithm>
#include <numeric>

#include "discrete/contacts/natural_map.h"
#include "discrete/contacts/contact_law.h"

namespace diptych::discrete
{
  namespace
  {
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

    std::vector<int> largest(const std::vector<double> &squares, const double share)
    {
      std::vector<int> by_size(squares.size());
      std::iota(by_size.begin(), by_size.end(), 0);
      std::stable_sort(by_size.begin(), by_size.end(), [&](const int a, const int b) { return squares[a] > squares[b]; });
      const double all = std::accumulate(squares.begin(), squares.end(), 0.);
      double       sum = 0;
      std::size_t  n   = 0;
      while (n < by_size.size() && sum < share * all)
        sum += squares[by_size[n++]];
      by_size.resize(n);
      return by_size;
    }
  } // namespace

  std::vector<int> stalled_contacts(const ContactProblem       &problem,
                                    const std::vector<Impulse> &impulses,
                                    const std::vector<int>     &held)
  {
    constexpr double  share = 0.8;
    const std::size_t most  = std::clamp<std::size_t>(problem.contacts.size() / 20, 60, 250);
    std::vector<bool> stalled(problem.free_velocity.size(), false);
    const auto        mark = [&](const int row) {
      for (const int body : {problem.contacts[row].i, problem.contacts[row].j})
        stalled[body] = moves(problem, body);
    };
    const std::vector<int> worst = largest(natural_map_squares(problem, impulses), share);
    std::for_each(worst.begin(), worst.end(), mark);
    std::for_each(held.begin(), held.end(), mark);
    std::vector<int> rows;
    for (std::size_t k = 0; k < problem.contacts.size(); ++k)
      {
        const int i = problem.contacts[k].i, j = problem.contacts[k].j;
        if ((stalled[i] || stalled[j]) && (stalled[i] || !moves(problem, i)) && (stalled[j] || !moves(problem, j)))
          rows.push_back(int(k));
      }
    if (rows.size() > most)
      rows.clear();
    return rows;
  }

  void sweep_alone(const ContactProblem &problem, const std::vector<int> &rows, std::vector<BodyVelocity> &v, Impulse *impulses)
  {
    constexpr int    most_sweeps = 200, sweeps_per_check = 5;
    constexpr double tolerance = 1e-8;
    for (int sweep = 0; sweep < most_sweeps; ++sweep)
      {
        const bool        check = sweep % sweeps_per_check == 0;
        NaturalMapSquares squares; // of each contact before its update; at convergence as small as those of all contacts at once
        for (std::size_t k = 0; k < rows.size(); ++k)
          {
            const ContactRow &c = problem.contacts[rows[k]];
            Impulse          &r = impulses[k];
            if (check)
              squares.add(c, v, r);
            update(c, exact, v, r);
          }
        if (check && squares.difference <= tolerance * tolerance * squares.norm)
          return;
      }
  }
} // namespace diptych::discrete
