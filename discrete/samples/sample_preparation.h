// diptych: a grain sample between two platens, ready to be loaded
// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <functional>
#include <string>

#include "discrete/samples/prepared_sample.h"
#include "discrete/samples/sample_options.h"

namespace diptych::discrete
{
  // Generates a sample in three stages:
  // - The size follows from the number of grains, or the number from the size.
  // - Soft discs relax in a box (or a cell) at box_solid_fraction.
  // - Compaction steps with fixed platens and the lateral condition. With periodic sides of fixed width the upper platen is free
  //   under the pressure instead. A lattice is free in all components under the isotropic pressure.
  // Grains are numbered upward. A sample from a file, or from `grains`, gets platens and sides that touch it. With rough_platens
  // the grains near a platen become part of it at the end. `progress` is called with (step, expected steps), also between
  // iterations of the soft discs and between sweeps. If it returns false, the preparation stops: the report is not quiet and the
  // state cannot be used. While a file is read the state is empty, without walls. Throws std::invalid_argument on wrong files.
  // Throws it also if target_solid_fraction is out of reach; the message gives the range.
  PreparedSample prepare_sample(const SampleOptions                 &options,
                                const PreparationSetting            &setting,
                                const std::function<bool(int, int)> &progress,
                                const Grains                        *grains = nullptr);

} // namespace diptych::discrete
