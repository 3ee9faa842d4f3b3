// diptych: the one list of the numbers of a study
// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <algorithm>
#include <limits>
#include <string>
#include <vector>

#include "coupling/numbers/number_entry.h"
#include "coupling/statistics/student.h"
#include "coupling/studies/study_cost.h"
#include "coupling/studies/study_evaluation.h"
#include "discrete/choices.h"

namespace diptych::coupling
{
  template <class Visitor> void list_numbers(const StudyQuantity &q, Visitor &v)
  {
    v({"name", "-", "of the quantity", Kind::setting}, q.name);
    v({"unit", "-", "of its values", Kind::setting}, q.unit);
    v({"source", "-", "panel or comparison from which it is read", Kind::setting}, discrete::name_of(q.source));
    v({"reduction", "-", "how", Kind::setting}, discrete::name_of(q.reduction));
    v({"column", "-", "of the panel's table, or the comparison's number", Kind::setting}, q.column);
    v({"from", "as walk says", "begin of the window, or the progress", Kind::setting}, q.from);
    v({"to", "as walk says", "end of the window, or its width", Kind::setting}, q.to);
    v({"relative", "-", "errors are shares of the reference's mean", Kind::setting}, q.is_relative);
    v({"limit", "as errors", "the error that still counts as right; null: none", Kind::setting}, q.limit);
  }

  template <class Visitor> void list_numbers(const AxisPoint &p, Visitor &v)
  {
    v({"label", "-", "of the point", Kind::setting}, p.label);
    v({"value", "-", "of its key, where that is a number", Kind::setting}, p.value);
  }

  template <class Visitor> void list_numbers(const Axis &a, Visitor &v)
  {
    v({"name", "-", "of the axis", Kind::setting}, a.name);
    v({"converges", "-", "results have a limit as its values go to 0", Kind::setting}, a.converges);
    v({"own_reference", "-", "each of its points is held against the reference at that point", Kind::setting}, a.own_reference);
    v.list("points", "of the axis", a.points);
  }

  template <class Visitor> void list_numbers(const Family &f, Visitor &v)
  {
    v({"name", "-", "of the family", Kind::setting}, f.name);
    v({"grid", "-", "every point of an axis with every one of the others; else the k-th of all together", Kind::setting},
      f.is_grid);
    v.list("axes", "of the family", f.axes);
  }

  template <class Visitor> void list_numbers(const Border &b, Visitor &v)
  {
    v({"label", "-", "of the border", Kind::setting}, b.label);
    v({"family", "-", "in which it is", Kind::setting}, b.family);
    v({"x", "-", "an axis", Kind::setting}, b.x);
    v({"y", "-", "another: y = coefficient x^exponent", Kind::setting}, b.y);
    v({"coefficient", "-", "of the border", Kind::setting}, b.coefficient);
    v({"exponent", "-", "of the border", Kind::setting}, b.exponent);
  }

  template <class Visitor> void list_numbers(const PointQuantity &q, Visitor &v)
  {
    v({"values", "as the quantity says", "of the samples; null where one has none"}, q.values);
    v({"mean", "as the quantity says", "of the samples"}, q.statistics.mean);
    v({"deviation", "as the quantity says", "standard deviation of one sample"}, q.statistics.deviation);
    v({"pairs", "-", "samples that have a value here and in the reference"}, q.pairs);
    v({"error", "as the quantity says",
       "point minus reference, sample by sample; its 95 % interval is Student's, of ratios Fieller's"},
      q.error);
    v({"scatter", "as errors", "of one sample about the reference's mean"}, q.scatter);
    v({"verdict", "-", "within or beyond the limit, or cannot tell"}, q.verdict);
  }

  // A point with what it is.
  struct NumberedPoint
  {
    const Study       *study  = nullptr;
    const ScenePoint  *point  = nullptr;
    const PointRecord *record = nullptr;
  };
  template <class Visitor> void list_numbers(const NumberedPoint &p, Visitor &v)
  {
    static const ScenePoint  no_point;
    static const PointRecord no_record;
    const ScenePoint        &point  = p.point ? *p.point : no_point;
    const PointRecord       &record = p.record ? *p.record : no_record;
    std::vector<std::string> folders;
    for (const StudyRun &run : point.runs)
      folders.push_back("runs/" + run.name);
    v({"family", "-", "of the point; references have none", Kind::setting},
      point.family < 0 ? std::string("reference") : p.study->families[std::size_t(point.family)].name);
    v({"reference", "-", "place in this list of the point that it is held against", Kind::setting}, int(point.reference));
    v({"labels", "-", "of its places on the family's axes; of references the axis, too", Kind::setting}, point.labels);
    v({"settings", "-", "beyond those of all points", Kind::setting}, point.settings);
    v({"folders", "-", "of its runs, one a sample", Kind::setting}, folders);
    v({"class", "-", "right; wrong, warned; silently wrong; struggled; stopped; refused; unjudged; not run"},
      discrete::name_of(record.kind));
    v({"certain", "-", "the intervals leave no doubt of the class"}, record.is_certain);
    v({"words", "-", "of the first run that did not finish"}, record.words);
    v({"warned", "-", "runs in which a panel warned"}, record.warned);
    v({"halved_steps", "-", "steps halved because the sweeps stalled, of the worst run"}, record.halved_steps);
    v({"cut_backs", "-", "load steps that were halved, of the worst run"}, record.cut_backs);
    v.list("quantities", "in the order of the study's", record.quantities);
  }

  struct NumberedOrder
  {
    const Study       *study = nullptr;
    const OrderRecord *order = nullptr;
  };
  template <class Visitor> void list_numbers(const NumberedOrder &o, Visitor &v)
  {
    static const OrderRecord none;
    const OrderRecord       &order  = o.order ? *o.order : none;
    const auto               family = o.study ? &o.study->families[order.family] : nullptr;
    v({"family", "-", "of the line", Kind::setting}, family ? family->name : std::string());
    v({"axis", "-", "along which the line runs", Kind::setting}, family ? family->axes[order.axis].name : std::string());
    v({"quantity", "-", "that is fitted", Kind::setting}, o.study ? o.study->quantities[order.quantity].name : std::string());
    v({"labels", "-", "of the points on the other axes", Kind::setting}, order.labels);
    v({"points", "-", "on the line"}, order.points);
    v({"order", "-", "p of value = limit + coefficient h^p, with the interval of a jackknife over the samples"}, order.order);
    v({"limit", "as the quantity says", "as h goes to 0"}, order.limit);
    v({"coefficient", "-", "of the fit"}, order.coefficient);
  }

  // The whole of study.json: nothing in it depends on when, where and in which order the points ran.
  struct StudyDocument
  {
    const Study                   &study;
    const std::vector<ScenePoint> &points;
    const StudyRecord             &record;
    std::string                    revision;
  };
  template <class Visitor> void list_numbers(const StudyDocument &d, Visitor &v)
  {
    std::vector<NumberedPoint> points;
    for (std::size_t k = 0; k < d.points.size(); ++k)
      points.push_back({&d.study, &d.points[k], &d.record.points[k]});
    std::vector<NumberedOrder> orders;
    for (const OrderRecord &order : d.record.orders)
      orders.push_back({&d.study, &order});
    std::vector<std::string> common;
    for (const Entry &entry : d.study.settings)
      common.push_back(entry.section + "/" + entry.key + " = " + entry.value);
    const int n = d.study.n_samples();
    v({"format", "-", "of this file"}, 1);
    v({"title", "-", "of the study", Kind::setting}, d.study.title);
    v({"name", "-", "of the study", Kind::setting}, d.study.name);
    v({"scene", "-", "file name of the scene", Kind::setting}, d.study.scene.substr(d.study.scene.rfind('/') + 1));
    v({"command", "-", "that every point runs", Kind::setting}, discrete::name_of(d.study.command));
    v({"revision", "-", "of the program's source", Kind::setting}, d.revision);
    v({"settings", "-", "of all points", Kind::setting}, common);
    v({"seeds", "-", "of the samples; empty: the one of the scene", Kind::setting}, d.study.seeds);
    v({"student_t_95", "-", "half width of the intervals in standard errors; null for less than two samples"},
      n > 1 ? student_quantile(0.975, n - 1) : std::numeric_limits<double>::quiet_NaN());
    v.list("quantities", "that are measured", d.study.quantities);
    v.list("families", "of points", d.study.families);
    v.list("borders", "where theory says that a method begins to fail", d.study.borders);
    v.list("points", "the references first", points);
    v.list("orders", "of convergence", orders);
  }

  template <class Visitor> void list_numbers(const PhaseMean &p, Visitor &v)
  {
    v({"name", "-", "of the phase", Kind::setting}, p.name);
    v({"cpu_s", "s", "CPU seconds, mean over the samples", Kind::clock}, p.cpu_s);
  }

  template <class Visitor> void list_numbers(const PointCost &c, Visitor &v)
  {
    v({"point", "-", "its place in study.json", Kind::setting}, c.point);
    v({"cpu_s", "s", "CPU seconds of the phases that count, mean over the samples", Kind::clock}, c.cpu_s);
    v({"peak_memory_mb", "MB", "of the worst run", Kind::clock}, c.peak_memory_mb);
    v({"disturbed", "-", "runs during which the machine had more to do than this study", Kind::clock}, c.disturbed);
    v({"front_of", "-", "quantities for which no point is both cheaper and closer to the reference", Kind::clock}, c.front_of);
    v.list("phases", "of a run", c.phases);
  }

  template <class Visitor> void list_numbers(const CheapestPoint &c, Visitor &v)
  {
    v({"quantity", "-", "that is held to the accuracy; empty: all with a limit", Kind::setting}, c.quantity);
    v({"accuracy", "as errors", "asked for; for all: a multiple of their limits", Kind::setting}, c.accuracy);
    v({"reference", "-", "of the points that compete, its place in study.json", Kind::setting}, c.reference);
    v({"point", "-", "the cheapest one that keeps to it, its place in study.json; -1: none does", Kind::clock}, c.point);
    v({"cpu_s", "s", "CPU seconds of it", Kind::clock}, c.cpu_s);
    v({"certain", "-", "the errors' 95 % intervals keep to it, too: it is no stroke of luck"}, c.is_certain);
  }

  // The whole of study_cost.json: what a clock measured, and what follows from it.
  template <class Visitor> void list_numbers(const StudyCost &c, Visitor &v)
  {
    v({"format", "-", "of this file"}, 1);
    v({"phases", "-", "that count", Kind::setting}, c.phases);
    v({"disturbed", "-", "runs during which the machine had more to do than this study", Kind::clock}, c.disturbed);
    v({"runs", "-", "that ended", Kind::clock}, c.runs);
    v({"total_cpu_s", "s", "CPU seconds of all phases of all runs", Kind::clock}, c.total_cpu_s);
    v.list("points", "that finished", c.points);
    v.list("cheapest", "right settings by accuracy", c.cheapest);
  }
} // namespace diptych::coupling
