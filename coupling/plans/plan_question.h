// diptych: reads the question of a plan from the command line
// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <string>
#include <vector>

#include "coupling/plans/plan.h"
#include "coupling/scene/scene.h"

namespace diptych::coupling
{
  struct PlanWords
  {
    std::string              scene;
    std::vector<std::string> overrides; // --set
    std::string              accuracy;  // --accuracy: "2 %", "0.02"
    std::string              wanted;    // --for: names, separated by commas; empty: peak_stress_ratio and strength
  };

  // Names of --for: peak_stress_ratio, strength, final_volumetric_strain, width_10_90 and angle (of the first band in the last
  // window). A name asks both panels; with the prefix discrete. or continuum. it asks one. A number of comparison.json with its
  // name in ensemble.csv is allowed, too. A panel is planned if the scene sets keys of it: sample and discrete, or continuum.
  // Throws SceneError.
  PlanQuestion read_question(const PlanWords &words);

  // A relative accuracy from 0.1 to 50 %. Throws SceneError.
  double read_accuracy(const std::string &text);

  // A setting that the plan makes.
  Entry planned(const std::string &section, const std::string &key, const std::string &value);
  Entry planned(const std::string &section, const std::string &key, double value);
} // namespace diptych::coupling
