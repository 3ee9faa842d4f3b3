// diptych: bodies of the discrete panel
// SPDX-License-Identifier: LGPL-2.1-or-later
#include "discrete/bodies/state.h"

namespace diptych::discrete
{
  void carry_platen_grains(State &state)
  {
    Grains &g = state.grains;
    for (std::size_t i = 0; i < g.size(); ++i)
      if (const int platen = g.platen(i); platen >= 0)
        {
          g.velocity[i] = state.walls[platen].velocity;
          g.spin[i]     = 0;
        }
  }

  void scale_impulses(State &state, const double factor)
  {
    if (factor == 1)
      return;
    for (PairImpulse &r : state.impulses)
      {
        r.normal *= factor;
        r.tangential *= factor;
        r.normal_change *= factor * factor;
        r.tangential_change *= factor * factor;
        r.rolling *= factor;
        r.rolling_change *= factor * factor;
      }
  }
} // namespace diptych::discrete
