// diptych: mean contact forces and friction dissipation over a window of steps
// SPDX-License-Identifier: LGPL-2.1-or-later
#include "discrete/panel/window_forces.h"

#include "discrete/stepping/step_problem.h"

namespace diptych::discrete
{
  void WindowForces::add(const StepResult &result, const std::vector<double> &spin_term, const double step)
  {
    const auto           before = [](const PairSum &a, const PairSum &b) { return a.i != b.i ? a.i < b.i : a.j < b.j; };
    std::vector<PairSum> now; // ascending like the contacts
    for (std::size_t k = 0; k < result.contacts.size(); ++k)
      if (const Contact &c = result.contacts[k]; result.impulses[k].normal > 0)
        now.push_back({c.i, c.j, result.contact_dissipation[k], result.contact_impact[k], impulse_vector(c, result.impulses[k]),
                       result.impulses[k].rolling});
    std::vector<PairSum> merged;
    merged.reserve(sums.size() + now.size());
    auto a = sums.begin();
    for (const PairSum &b : now)
      {
        while (a != sums.end() && before(*a, b))
          merged.push_back(*a++);
        if (a != sums.end() && a->i == b.i && a->j == b.j)
          {
            merged.push_back(
              {b.i, b.j, a->dissipation + b.dissipation, a->impact + b.impact, a->impulse + b.impulse, a->rolling + b.rolling});
            ++a;
          }
        else
          merged.push_back(b);
      }
    merged.insert(merged.end(), a, sums.end());
    sums = std::move(merged);

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
        forces.push_back({s.i, s.j, c.point, c.normal, s.impulse / time, state.cell ? c.image * state.cell->width : 0.,
                          s.rolling / time * effective_radius(state.grains, s.i, s.j)});
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
