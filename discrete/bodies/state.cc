// diptych: bodies of the discrete panel
// SPDX-License-Identifier: LGPL-2.1-or-later
#include "discrete/bodies/state.h"

namespace diptych::discrete
{
  void UniformStrain::deform(Periodicity &periodicity) const
  {
    if (auto *width = std::get_if<PeriodicWidth>(&periodicity))
      width->width *= 1 - strain.x();
    if (auto *lattice = std::get_if<Lattice>(&periodicity))
      lattice->vectors -= strain.asDiagonal() * lattice->vectors;
  }

  void deform(State &state, const UniformStrain &strain)
  {
    Grains &g = state.grains;
    for (std::size_t i = 0; i < g.size(); ++i)
      if (const int platen = g.platen(i); platen >= 0)
        g.position[i].y() += strain.moved(state.walls[platen].point).y() - state.walls[platen].point.y();
      else if (!g.fixed[i])
        g.position[i] = strain.moved(g.position[i]);
    for (Wall &wall : state.walls)
      wall.point = strain.moved(wall.point);
    strain.deform(state.periodicity);
  }

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
