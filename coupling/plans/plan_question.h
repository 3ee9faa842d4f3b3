// diptych: what a plan is asked, from the words of the command line
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
  // window), each of both panels or with discrete. or continuum. before it of one; or a number of comparison.json as ensembles
  // name it. A panel is asked where the scene sets keys of it: sample and discrete, or continuum. Throws SceneError.
  PlanQuestion read_question(const PlanWords &words);

  // A relative accuracy from 0.1 to 50 %. Throws SceneError.
  double read_accuracy(const std::string &text);

  // An assignment that the plan makes.
  Entry planned(const std::string &section, const std::string &key, const std::string &value);
  Entry planned(const std::string &section, const std::string &key, double value);
} // namespace diptych::coupling
