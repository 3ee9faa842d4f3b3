// diptych: mean contact forces over a window of steps
// SPDX-License-Identifier: LGPL-2.1-or-later
#include "discrete/window_forces.h"

#include <algorithm>

namespace diptych::discrete
{
  void WindowForces::add(const StepResult &result, const std::vector<double> &spin_term, const double step)
  {
    const auto           before = [](const PairSum &a, const PairSum &b) { return a.i != b.i ? a.i < b.i : a.j < b.j; };
    std::vector<PairSum> now;
    for (std::size_t k = 0; k < result.contacts.size(); ++k)
      if (result.impulses[k].normal > 0)
        now.push_back({result.contacts[k].i, result.contacts[k].j, impulse_vector(result.contacts[k], result.impulses[k])});
    std::sort(now.begin(), now.end(), before);

    std::vector<PairSum> merged;
    merged.reserve(sums_.size() + now.size());
    auto a = sums_.begin();
    for (const PairSum &b : now)
      {
        while (a != sums_.end() && before(*a, b))
          merged.push_back(*a++);
        if (a != sums_.end() && a->i == b.i && a->j == b.j)
          merged.push_back({b.i, b.j, (a++)->impulse + b.impulse});
        else
          merged.push_back(b);
      }
    merged.insert(merged.end(), a, sums_.end());
    sums_ = std::move(merged);

    spin_.resize(spin_term.size(), 0.);
    for (std::size_t i = 0; i < spin_term.size(); ++i)
      spin_[i] += step * spin_term[i];
    time_ += step;
  }

  void WindowForces::reset()
  {
    *this = WindowForces();
  }

  std::vector<double> WindowForces::mean_spin_term() const
  {
    std::vector<double> mean = spin_;
    for (double &x : mean)
      x /= time_;
    return mean;
  }

  std::vector<ContactForce> WindowForces::mean_forces(const State &state) const
  {
    std::vector<ContactForce> forces;
    forces.reserve(sums_.size());
    for (const PairSum &s : sums_)
      {
        const Contact c = make_contact(state, s.i, s.j);
        forces.push_back({s.i, s.j, c.point, c.normal, s.impulse / time_});
      }
    return forces;
  }
} // namespace diptych::discrete
