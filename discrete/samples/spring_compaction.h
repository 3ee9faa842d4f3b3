// diptych: compaction of a large sample whose contacts are springs at first
// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <functional>

#include "discrete/samples/prepared_sample.h"
#include "discrete/samples/sample_options.h"

namespace diptych::discrete
{
  // Length of the steps of a large sample on implicit springs of this stiffness, kn/P [d sqrt(rho/P)]. Waves cross the sample in
  // about thirty steps.
  double step_on_springs(double stiffness, const State &state, double mean_diameter);

  // The contacts get implicit springs, at first soft, at last so stiff that no overlap above largest_prepared_overlap is left.
  // After each step the sample is strained uniformly towards the stress of its sides (uniform_strain.h). Springs, step and
  // tolerance of `setting` are replaced; its pressure must be positive.
  PreparedSample compact_with_springs(State                                start,
                                      const SampleOptions                 &options,
                                      StepSetting                          setting,
                                      const std::shared_ptr<ThreadTeam>   &team,
                                      const std::function<bool(int, int)> &progress);
} // namespace diptych::discrete
