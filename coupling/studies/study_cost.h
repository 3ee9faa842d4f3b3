// diptych: cost of the points of a study, and the cheapest right ones
// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <cmath>
#include <string>
#include <vector>

#include "coupling/studies/study_evaluation.h"

namespace diptych::coupling
{
  struct PhaseMean
  {
    std::string name;
    double      cpu_s = 0; // mean over the samples
  };

  struct PointCost
  {
    int                      point = 0;
    double                   cpu_s = 0, peak_memory_mb = 0;
    int                      disturbed = 0;
    std::vector<std::string> front_of;
    std::vector<PhaseMean>   phases;
  };

  // The cheapest finished point whose mean error is within an accuracy.
  struct CheapestPoint
  {
    std::string quantity; // empty: all that have a limit
    double      accuracy   = 0;
    int         reference  = 0; // of the points that compete
    int         point      = -1;
    double      cpu_s      = NAN;
    bool        is_certain = false; // the intervals of the errors are within the accuracy, too
  };

  struct StudyCost
  {
    std::vector<std::string>   phases;
    int                        disturbed = 0, runs = 0;
    double                     total_cpu_s = 0;
    std::vector<PointCost>     points;
    std::vector<CheapestPoint> cheapest;
  };

  // Accuracies of the cheapest points: 5, 2 and 1 % for relative errors; 2.5, 1 and 0.5 times the limit for absolute errors and
  // for all quantities together. Without any limit there is no cheapest point. References do not compete.
  StudyCost cost_of(const Study                   &study,
                    const std::vector<ScenePoint> &points,
                    const StudyResults            &results,
                    const StudyRecord             &record);

  // True if the machine was busy with half a process more than the runs of this study.
  bool is_disturbed(const RunResult &run);
} // namespace diptych::coupling
