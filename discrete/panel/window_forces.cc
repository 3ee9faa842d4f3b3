// diptych: mean contact forces and friction dissipation over a window of steps
// SPDX-License-Identifier: LGPL-2.1-or-later
#include "discrete/panel/window_forces.h"

#include <algorithm>

#include "discrete/stepping/step_problem.h"

namespace diptych::discrete
{
  void WindowForces::add(const StepResult &result, const std::vector<double> &spin_term, const double step)
  {
    const auto           before = [](const PairSum &a, const PairSum &b) { return a.i != b.i ? a.i < b.i : a.j < b.j; };
    std::vector<PairSum> fresh; // pairs that had no contact since the last reset, ascending like the contacts
    auto                 sum = sums.begin();
    for (std::size_t k = 0; k < result.contacts.size(); ++k)
      {
        const Contact &c = result.contacts[k];
        if (!(result.impulses[k].normal > 0))
          continue;
        const PairSum now{c.i,
                          c.j,
                          result.contact_dissipation[k],
                          result.contact_impact[k],
                          impulse_vector(c, result.impulses[k]),
                          result.impulses[k].rolling};
        while (sum != sums.end() && before(*sum, now))
          ++sum;
        if (sum == sums.end() || before(now, *sum))
          fresh.push_back(now);
        else
          {
            sum->dissipation += now.dissipation;
            sum->impact += now.impact;
            sum->impulse += now.impulse;
            sum->rolling += now.rolling;
          }
      }
    if (!fresh.empty())
      {
        const auto known = std::ptrdiff_t(sums.size());
        sums.insert(sums.end(), fresh.begin(), fresh.end());
        std::inplace_merge(sums.begin(), sums.begin() + known, sums.end(), before);
      }

    spin.resize(spin_term.size(), 0.);
    for (std::size_t i = 0; i < spin_term.size(); ++i)
      spin[i] += step * spin_term[i];
    time += step;
  }

  std::vector<double> WindowForces::mean_spin_term() const
  {
    std::vector<double> mean = spin;
    for (double &x : mean)
      x /= time;
    return mean;
  }

  std::vector<ContactForce> WindowForces::mean_forces(const State &state) const
  {
    std::vector<ContactForce> forces;
    forces.reserve(sums.size());
    for (const PairSum &s : sums)
      {
        const Contact c = make_contact(state, s.i, s.j);
        forces.push_back({s.i, s.j, c.point, c.normal, s.impulse / time, c.image.shift.x(),
                          s.rolling / time * effective_radius(state.grains, s.i, s.j), c.image.shift.y()});
      }
    return forces;
  }

  namespace
  {
    std::vector<double> member_of(const std::vector<WindowForces::PairSum> &sums, double WindowForces::PairSum::*member)
    {
      std::vector<double> values;
      values.reserve(sums.size());
      for (const WindowForces::PairSum &s : sums)
        values.push_back(s.*member);
      return values;
    }
  } // namespace

  std::vector<double> WindowForces::dissipation() const
  {
    return member_of(sums, &PairSum::dissipation);
  }

  std::vector<double> WindowForces::impact_dissipation() const
  {
    return member_of(sums, &PairSum::impact);
  }
} // namespace diptych::discrete
