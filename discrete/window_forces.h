// diptych: mean contact forces over a window of steps
// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include "discrete/snapshot.h"
#include "discrete/time_stepping.h"

namespace diptych::discrete
{
  // Sums the impulse of every pair that touches, and the spin term of every grain, over the steps since the last reset.
  // Contacts of rigid grains make and break within a few steps: single steps scatter, their mean is the stress.
  class WindowForces
  {
  public:
    void add(const StepResult &result, const std::vector<double> &spin_term, double step);
    void reset();

    double              time() const { return time_; }
    std::vector<double> mean_spin_term() const;
    // Mean force of every pair, placed at its contact point in `state` (between the surfaces if they have parted).
    std::vector<ContactForce> mean_forces(const State &state) const;

  private:
    struct PairSum
    {
      int             i, j;
      Eigen::Vector2d impulse; // on i
    };
    std::vector<PairSum> sums_; // ascending in (i, j)
    std::vector<double>  spin_; // sum of step x spin term
    double               time_ = 0;
  };

  // Impulse of a contact as a vector on body i.
  inline Eigen::Vector2d impulse_vector(const Contact &c, const Impulse &r)
  {
    return {c.normal.x() * r.normal - c.normal.y() * r.tangential, c.normal.y() * r.normal + c.normal.x() * r.tangential};
  }
} // namespace diptych::discrete
