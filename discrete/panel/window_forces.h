// diptych: mean contact forces and friction dissipation over a window of steps
// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include "discrete/snapshot.h"
#include "discrete/stepping/time_stepping.h"

namespace diptych::discrete
{
  // Sums of impulse, friction dissipation and spin term since the last reset. Contacts of rigid grains open and close within a
  // few steps. Forces of single steps therefore scatter; only their mean gives the stress.
  struct WindowForces
  {
    struct PairSum
    {
      int             i, j;
      double          dissipation; // by friction and rolling resistance [energy]
      double          impact;      // dissipated along the normal [energy]
      Eigen::Vector2d impulse;     // on i
      double          rolling = 0; // on i: impulse of the couple / effective radius
    };
    std::vector<PairSum> sums;     // ascending in (i, j)
    std::vector<double>  spin;     // sum of step x spin term, of each grain
    double               time = 0; // duration of the steps

    void add(const StepResult &result, const std::vector<double> &spin_term, double step);
    void reset() { *this = WindowForces(); }

    std::vector<double> mean_spin_term() const;
    // Mean force of every pair, placed at its contact point in `state`, or midway between the surfaces if they have parted.
    std::vector<ContactForce> mean_forces(const State &state) const;
    // Sum (not mean) for each entry of mean_forces(). [energy]
    std::vector<double> dissipation() const;
    std::vector<double> impact_dissipation() const;
  };
} // namespace diptych::discrete
