// diptych: what a scene needs for the accuracy that is asked of it: question and answer
// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <algorithm>
#include <functional>
#include <limits>
#include <string>
#include <utility>
#include <vector>

#include "coupling/statistics/equivalence.h"
#include "coupling/studies/study.h"

namespace diptych::coupling
{
  // What a rule says beforehand of how a quantity of the grains errs with step and tolerance.
  enum class StepError
  {
    strength, // as the strength does
    dilation, // as the dilation does
    unknown   // no rule speaks of it: measured only
  };

  struct PlanQuantity
  {
    StudyQuantity quantity;
    StepError     step_error = StepError::strength;
  };

  struct PlanQuestion
  {
    std::string scene;           // file
    Settings    changes;         // --set
    double      accuracy = 0.02; // of the mean of every quantity, relative: errors of the method and 95 % interval together
    std::vector<PlanQuantity> grains, continuum;        // empty: nothing is asked of that panel
    bool                      needs_comparison = false; // one of them is a number of the comparison
  };

  // Points of a scene on the same samples.
  struct PilotTask
  {
    StudyCommand               command = StudyCommand::discrete;
    Settings                   common;
    std::vector<Settings>      points;
    std::vector<int>           seeds; // empty: the one sample of the scene
    std::vector<StudyQuantity> quantities;
  };

  struct PilotPoint
  {
    std::string                      remark;       // why a few samples are left out; empty where all finished
    std::vector<double>              sample_cpu_s; // of those that finished
    std::string                      words;        // why a run did not finish; empty where all did
    std::vector<std::vector<double>> values;       // [quantity][sample]; NaN where there is none
    double                           cpu_s = NAN, preparation_cpu_s = 0, peak_memory_mb = 0; // a sample: mean, mean, largest
    double                           strength_error = NAN, dilation_error = NAN;             // that the rule of the step expects
  };

  // Runs a task; what was run before is not run again. Throws StoppedOnRequest on a stop signal.
  using RunPilot = std::function<std::vector<PilotPoint>(const PilotTask &)>;

  // A share of the error of a mean.
  struct ErrorPart
  {
    std::string cause;
    double      error     = 0;                                        // relative, at most about
    double      bias      = 0;                                        // expected, with its sign; 0: only chance
    double      deviation = std::numeric_limits<double>::quiet_NaN(); // of that estimate, where it is known
  };

  struct QuantityBudget
  {
    std::string            name;
    double                 mean = NAN, scatter = NAN; // in the pilot; of one sample, relative
    std::vector<ErrorPart> parts;

    double total() const
    {
      double sum = 0;
      for (const ErrorPart &part : parts)
        sum += part.error;
      return sum;
    }
    double bias() const
    {
      double sum = 0;
      for (const ErrorPart &part : parts)
        sum += part.bias;
      return sum;
    }
  };

  // What --run found.
  struct QuantityOutcome
  {
    std::string      name;
    SampleStatistics statistics;
    double           scatter = NAN, half_interval = NAN; // of one sample, of the mean; relative
  };

  struct PanelPlan
  {
    std::string                  panel; // discrete or continuum
    StudyCommand                 command = StudyCommand::discrete;
    Settings                     settings;
    std::vector<int>             seeds;                           // of the samples; empty: the one of the scene
    double                       cpu_s = NAN, peak_memory_mb = 0; // of one sample
    bool                         reaches = true;                  // the accuracy that was asked for
    std::vector<QuantityBudget>  quantities;
    std::vector<std::string>     decisions; // what was found of every knob
    std::vector<QuantityOutcome> outcomes;
    double                       outcome_cpu_s = NAN; // of one sample

    int    n_samples() const { return seeds.empty() ? 1 : int(seeds.size()); }
    double total_cpu_s() const { return quantities.empty() ? 0 : cpu_s * n_samples(); }
  };

  struct Plan
  {
    std::string            scene, revision;
    double                 accuracy    = 0;
    double                 pilot_cpu_s = 0;
    std::vector<PanelPlan> panels;

    // Both panels come from the same runs.
    bool shares_samples() const
    {
      for (const PanelPlan &panel : panels)
        if (panel.quantities.empty())
          return false;
      return panels.size() > 1 && panels.front().command == StudyCommand::run && panels.back().command == StudyCommand::run;
    }
    double total_cpu_s() const
    {
      double sum = 0;
      for (const PanelPlan &panel : panels)
        sum = shares_samples() ? std::max(sum, panel.total_cpu_s()) : sum + panel.total_cpu_s();
      return sum;
    }
  };
} // namespace diptych::coupling
