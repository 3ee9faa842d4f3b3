// diptych: the list of all numbers in plan.json
// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include "coupling/numbers/number_entry.h"
#include "coupling/plans/plan.h"
#include "discrete/choices.h"

namespace diptych::coupling
{
  template <class Visitor> void list_numbers(const ErrorPart &p, Visitor &v)
  {
    v({"cause", "-", "cause of this part of the error", Kind::setting}, p.cause);
    v({"error", "-", "upper estimate of this part, relative"}, p.error);
    v({"bias", "-", "expected error with its sign, relative; positive: too large; 0: chance only"}, p.bias);
    v({"deviation", "-", "standard deviation of that estimate; null: unknown"}, p.deviation);
  }

  template <class Visitor> void list_numbers(const QuantityBudget &q, Visitor &v)
  {
    v({"name", "-", "name of the quantity", Kind::setting}, q.name);
    v({"mean", "as the quantity says", "mean in the pilot"}, q.mean);
    v({"scatter", "-", "standard deviation of one sample, relative (angles: to 45 degrees)"}, q.scatter);
    v({"total", "-", "sum of the parts: upper estimate of the error of the mean, relative"}, q.total());
    v({"bias", "-", "expected error of the method: sum of the parts with their signs, relative"}, q.bias());
    v.list("parts", "parts of the error; that of the samples is half a 95 % interval", q.parts);
  }

  template <class Visitor> void list_numbers(const QuantityOutcome &q, Visitor &v)
  {
    v({"name", "-", "name of the quantity", Kind::setting}, q.name);
    v({"n", "-", "number of samples"}, q.statistics.n);
    v({"mean", "as the quantity says", "mean over the samples"}, q.statistics.mean);
    v({"scatter", "-", "standard deviation of one sample, relative (angles: to 45 degrees)"}, q.scatter);
    v({"half_interval", "-", "half the 95 % interval of the mean, relative"}, q.half_interval);
  }

  template <class Visitor> void list_numbers(const PanelPlan &p, Visitor &v)
  {
    std::vector<std::string> settings;
    for (const Entry &entry : p.settings)
      settings.push_back(entry.section + "/" + entry.key + " = " + entry.value);
    v({"panel", "-", "panel: discrete or continuum", Kind::setting}, p.panel);
    v({"command", "-", "command that computes its quantities", Kind::setting}, discrete::name_of(p.command));
    v({"settings", "-", "settings that the plan chose", Kind::setting}, settings);
    v({"seeds", "-", "seeds of the samples; empty: the one sample of the scene", Kind::setting}, p.seeds);
    v({"reaches", "-", "true if the plan reaches the required accuracy"}, p.reaches);
    v({"cpu_s", "s", "CPU time of one sample, predicted", Kind::clock}, p.cpu_s);
    v({"total_cpu_s", "s", "CPU time of all samples, predicted", Kind::clock}, p.total_cpu_s());
    v({"peak_memory_mb", "MB", "peak memory of one sample, predicted", Kind::clock}, p.peak_memory_mb);
    v({"decisions", "-", "findings on every setting, as text", Kind::setting}, p.decisions);
    v.list("quantities", "quantities with their error budgets", p.quantities);
    v({"outcome_cpu_s", "s", "CPU time of one sample, measured; null before --run", Kind::clock}, p.outcome_cpu_s);
    v.list("outcomes", "results of --run", p.outcomes);
  }

  // All of plan.json.
  template <class Visitor> void list_numbers(const Plan &p, Visitor &v)
  {
    v({"format", "-", "version of this file's format"}, 1);
    v({"scene", "-", "file name of the scene", Kind::setting}, p.scene);
    v({"revision", "-", "revision of the program's source", Kind::setting}, p.revision);
    v({"accuracy", "-", "required accuracy, relative", Kind::setting}, p.accuracy);
    v({"pilot_cpu_s", "s", "CPU time of the pilot's runs", Kind::clock}, p.pilot_cpu_s);
    v({"total_cpu_s", "s", "CPU time of all planned samples, predicted; shared runs of both panels count once", Kind::clock},
      p.total_cpu_s());
    v.list("panels", "planned panels", p.panels);
  }
} // namespace diptych::coupling
