// diptych: the one list of the numbers of a plan
// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include "coupling/numbers/number_entry.h"
#include "coupling/plans/plan.h"
#include "discrete/choices.h"

namespace diptych::coupling
{
  template <class Visitor> void list_numbers(const ErrorPart &p, Visitor &v)
  {
    v({"cause", "-", "of this part of the error", Kind::setting}, p.cause);
    v({"error", "-", "relative, at most about"}, p.error);
    v({"bias", "-", "expected, relative, positive: too large; 0: only chance"}, p.bias);
    v({"deviation", "-", "standard deviation of that estimate; null: not known"}, p.deviation);
  }

  template <class Visitor> void list_numbers(const QuantityBudget &q, Visitor &v)
  {
    v({"name", "-", "of the quantity", Kind::setting}, q.name);
    v({"mean", "as the quantity says", "in the pilot"}, q.mean);
    v({"scatter", "-", "standard deviation of one sample, relative; of angles to 45 degrees"}, q.scatter);
    v({"total", "-", "sum of the parts: what the mean is expected to err by at most, relative"}, q.total());
    v({"bias", "-", "expected of the method: the parts with their signs, relative"}, q.bias());
    v.list("parts", "of the error; that of the samples is half a 95 % interval", q.parts);
  }

  template <class Visitor> void list_numbers(const QuantityOutcome &q, Visitor &v)
  {
    v({"name", "-", "of the quantity", Kind::setting}, q.name);
    v({"n", "-", "samples"}, q.statistics.n);
    v({"mean", "as the quantity says", "of the samples"}, q.statistics.mean);
    v({"scatter", "-", "standard deviation of one sample, relative; of angles to 45 degrees"}, q.scatter);
    v({"half_interval", "-", "half the 95 % interval of the mean, relative"}, q.half_interval);
  }

  template <class Visitor> void list_numbers(const PanelPlan &p, Visitor &v)
  {
    std::vector<std::string> settings;
    for (const Entry &entry : p.settings)
      settings.push_back(entry.section + "/" + entry.key + " = " + entry.value);
    v({"panel", "-", "discrete or continuum", Kind::setting}, p.panel);
    v({"command", "-", "that computes what is asked of it", Kind::setting}, discrete::name_of(p.command));
    v({"settings", "-", "that the plan makes", Kind::setting}, settings);
    v({"seeds", "-", "of the samples; empty: the one of the scene", Kind::setting}, p.seeds);
    v({"reaches", "-", "the accuracy that was asked for"}, p.reaches);
    v({"cpu_s", "s", "CPU time of one sample, predicted", Kind::clock}, p.cpu_s);
    v({"total_cpu_s", "s", "of all samples, predicted", Kind::clock}, p.total_cpu_s());
    v({"peak_memory_mb", "MB", "of one sample, predicted", Kind::clock}, p.peak_memory_mb);
    v({"decisions", "-", "what was found of every knob", Kind::setting}, p.decisions);
    v.list("quantities", "with the budget of their errors", p.quantities);
    v({"outcome_cpu_s", "s", "CPU time of one sample, as it was; null before --run", Kind::clock}, p.outcome_cpu_s);
    v.list("outcomes", "what --run found", p.outcomes);
  }

  // The whole of plan.json.
  template <class Visitor> void list_numbers(const Plan &p, Visitor &v)
  {
    v({"format", "-", "of this file"}, 1);
    v({"scene", "-", "file name of the scene", Kind::setting}, p.scene);
    v({"revision", "-", "of the program's source", Kind::setting}, p.revision);
    v({"accuracy", "-", "asked for, relative", Kind::setting}, p.accuracy);
    v({"pilot_cpu_s", "s", "CPU time of the pilot's runs", Kind::clock}, p.pilot_cpu_s);
    v({"total_cpu_s", "s", "CPU time of all planned samples, predicted; runs that both panels share count once", Kind::clock},
      p.total_cpu_s());
    v.list("panels", "that are asked", p.panels);
  }
} // namespace diptych::coupling
