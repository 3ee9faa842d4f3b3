// diptych: keys whose value `auto` follows from other keys of the scene
// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <set>
#include <string>

#include "coupling/scene/scene.h"

namespace diptych::coupling
{
  // True if a key, as section/name, takes the value `auto`, which is also its default, and is then derived.
  bool is_derived(const std::string &key);

  std::string rule_of(const std::string &derived_key); // how its value follows, for `explain`

  // Gives every derived key a value that fits the other keys, except those in `given`.
  //
  // Law of the continuum: from calibrations on dense samples with friction 0.2 to 0.8 (benchmarks/calibration/defaults), linear
  // in discrete/friction between them. Angles that are given change those that depend on them: start and dilatancy stay shares of
  // the peak.
  //
  // discrete/method = auto becomes nscd, compliant or penalty, the cheapest by benchmarks/rigid_limit.
  void derive_keys(Scene &scene, const std::set<std::string> &given);

  // CPU time of contact dynamics / that of springs with kn/P = 1e4 and a step fraction of 0.5, whose preload counts. Without the
  // preload it is within a factor of two of benchmarks/rigid_limit/size.csv. 0 if springs cannot replace contact dynamics in this
  // scene.
  double cost_over_springs(const Scene &scene, double accuracy);

  // Largest inertial number of a loading that counts as quasi-static (benchmarks/studies/grains_inertia).
  constexpr double largest_quasi_static = 3e-3;
} // namespace diptych::coupling
