// diptych: the length of a step, from forces and motion
// SPDX-License-Identifier: LGPL-2.1-or-later
#include "discrete/step_rule.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace diptych::discrete
{
  namespace
  {
    double grain_density(const Grains &g)
    {
      double mass = 0, area = 0;
      for (std::size_t i = 0; i < g.size(); ++i)
        mass += g.mass[i], area += M_PI * g.radius[i] * g.radius[i];
      return mass / area;
    }

    double fastest(const State &state)
    {
      double speed = 0, squares = 0;
      for (const Wall &wall : state.walls)
        speed = std::max(speed, wall.velocity.norm());
      for (const Eigen::Vector2d &v : state.grains.velocity)
        squares += v.squaredNorm() / double(state.grains.size());
      return std::max(speed, 3 * std::sqrt(squares));
    }
  } // namespace

  StepChoice choose_step(const State &state, const StepSetting &setting, const double mean_stress, const double rate)
  {
    constexpr double infinity   = std::numeric_limits<double>::infinity();
    const double     d          = setting.mean_diameter;
    const bool       end_grains = std::holds_alternative<EndGrains>(setting.lateral);
    const double     stress     = std::max(mean_stress, end_grains ? setting.pressure : 0.);
    const double     unit       = stress > 0 ? d * std::sqrt(grain_density(state.grains) / stress) : infinity;
    const double     speed = fastest(state), gravity = std::hypot(setting.time.gravity_x, setting.time.gravity_y);

    StepChoice choice{infinity, "none"};
    const auto bound = [&](const double step, const char *name) {
      if (step < choice.step)
        choice = {step, name};
    };
    bound((end_grains ? 1. : 5.) * unit, "forces");
    if (speed > 0)
      bound(0.1 * d / speed, "motion");
    if (gravity > 0)
      bound(0.3 * std::sqrt(d / gravity), "gravity");
    if (rate > 0 && std::isfinite(unit))
      bound(0.6 * rate * unit / setting.solver.tolerance * unit, "solver");
    return choice;
  }
} // namespace diptych::discrete
