// diptych: three discs fall onto a floor and come to rest on each other; the floor then carries their weight
// SPDX-License-Identifier: LGPL-2.1-or-later
#include <cmath>
#include <cstdio>

#include "discrete/files/hdf5_file.h"
#include "discrete/stepping/time_stepping.h"

int main(const int, char **words)
{
  using namespace diptych::discrete;
  StepSetting setting;
  setting.step               = 0.01;
  setting.stepping.gravity_y = -10;
  setting.lateral            = NoSides{};
  setting.solver.tolerance   = 1e-12;

  State state;
  state.walls = {{{0, 0}, {0, 1}}}; // a floor: a point of it, and its normal towards the discs
  for (int k = 0; k < 3; ++k)
    add_grain(state.grains, {0, 0.6 + 1.1 * k}, 0.5, 1.);

  double floor_force = 0;
  for (int step = 0; step < 100; ++step)
    {
      const StepResult result = advance(state, setting);
      if (result.solve.status != SolveStatus::converged)
        return 3;
      floor_force = result.wall_force[0].y();
    }

  Hdf5Writer file(words[1]);
  file.write("position", state.grains.position);
  file.finish();
  const double top = Hdf5Reader(words[1]).read_vectors("position").back().y();
  std::printf("floor force / weight %.9f, height of the upper disc %.6f\n", floor_force / (3 * state.grains.mass[0] * 10), top);
}
