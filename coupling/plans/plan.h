// diptych: question and answer of a plan: the settings that a scene needs for an accuracy
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
  // The rule that predicts the error of a quantity of the grains from step and tolerance.
  enum class StepError
  {
    strength, // errs like the strength
    dilation, // errs like the dilation
    unknown   // no rule: measured only
  };

  struct PlanQuantity
  {
    StudyQuantity quantity;
    StepError     step_error = StepError::strength;
  };

  struct PlanQuestion
  {
    std::string               scene;             // file
    Settings                  changes;           // --set
    double                    accuracy = 0.02;   // relative, of the mean of every quantity: method errors plus 95 % interval
    std::vector<PlanQuantity> grains, continuum; // empty: this panel is not planned
    bool                      needs_comparison = false; // a quantity is a number of the comparison
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
    std::string                      remark;       // reason if a few samples are left out
    std::vector<double>              sample_cpu_s; // of the samples that finished
    std::string                      words;        // reason if a run did not finish
    std::vector<std::vector<double>> values;       // [quantity][sample]; NaN if there is none
    double                           cpu_s = NAN, preparation_cpu_s = 0, peak_memory_mb = 0; // per sample: mean, mean, largest
    double                           strength_error = NAN, dilation_error = NAN;             // expected by the rule of the step
  };

  // Runs a task; what was run before is not run again. Throws StoppedOnRequest on a stop signal.
  using RunPilot = std::function<std::vector<PilotPoint>(const PilotTask &)>;

  // One part of the error of a mean.
  struct ErrorPart
  {
    std::string cause;
    double      error     = 0;                                        // relative, upper estimate
    double      bias      = 0;                                        // expected, with sign; 0: chance only
    double      deviation = std::numeric_limits<double>::quiet_NaN(); // of that estimate, if known
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

  // The result of --run.
  struct QuantityOutcome
  {
    std::string      name;
    SampleStatistics statistics;
    double           scatter = NAN, half_interval = NAN; // of one sample; of the mean; relative
  };

  struct PanelPlan
  {
    std::string                  panel; // discrete or continuum
    StudyCommand                 command = StudyCommand::discrete;
    Settings                     settings;
    std::vector<int>             seeds;                           // of the samples; empty: the one sample of the scene
    double                       cpu_s = NAN, peak_memory_mb = 0; // of one sample
    bool                         reaches = true;                  // the required accuracy
    std::vector<QuantityBudget>  quantities;
    std::vector<std::string>     decisions; // findings on every setting
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

    // True if both panels come from the same runs.
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
