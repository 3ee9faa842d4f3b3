// diptych: the list of all numbers in the result files of a study
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
    v({"name", "-", "name of the quantity", Kind::setting}, q.name);
    v({"unit", "-", "unit of its values", Kind::setting}, q.unit);
    v({"source", "-", "panel or comparison that it is read from", Kind::setting}, discrete::name_of(q.source));
    v({"reduction", "-", "way to reduce a column to one number", Kind::setting}, discrete::name_of(q.reduction));
    v({"column", "-", "column of the panel's table, or name of the comparison's number", Kind::setting}, q.column);
    v({"from", "as walk says", "start of the range, or the progress", Kind::setting}, q.from);
    v({"to", "as walk says", "end of the range, or its width", Kind::setting}, q.to);
    v({"relative", "-", "true if errors are relative to the reference's mean", Kind::setting}, q.is_relative);
    v({"limit", "as errors", "largest error that counts as right; null: no limit", Kind::setting}, q.limit);
  }

  template <class Visitor> void list_numbers(const AxisPoint &p, Visitor &v)
  {
    v({"label", "-", "label of the point", Kind::setting}, p.label);
    v({"value", "-", "value of its key, if it is a number", Kind::setting}, p.value);
  }

  template <class Visitor> void list_numbers(const Axis &a, Visitor &v)
  {
    v({"name", "-", "name of the axis", Kind::setting}, a.name);
    v({"converges", "-", "true if results have a limit as the values go to 0", Kind::setting}, a.converges);
    v({"own_reference", "-", "true if each point is compared with the reference at that point", Kind::setting}, a.own_reference);
    v.list("points", "points of the axis", a.points);
  }

  template <class Visitor> void list_numbers(const Family &f, Visitor &v)
  {
    v({"name", "-", "name of the family", Kind::setting}, f.name);
    v({"grid", "-", "true: all combinations of the axes; false: the k-th points of all axes together", Kind::setting}, f.is_grid);
    v.list("axes", "axes of the family", f.axes);
  }

  template <class Visitor> void list_numbers(const Border &b, Visitor &v)
  {
    v({"label", "-", "label of the border", Kind::setting}, b.label);
    v({"family", "-", "family that it belongs to", Kind::setting}, b.family);
    v({"x", "-", "axis x", Kind::setting}, b.x);
    v({"y", "-", "axis y: y = coefficient x^exponent", Kind::setting}, b.y);
    v({"coefficient", "-", "coefficient of the border", Kind::setting}, b.coefficient);
    v({"exponent", "-", "exponent of the border", Kind::setting}, b.exponent);
  }

  template <class Visitor> void list_numbers(const PointQuantity &q, Visitor &v)
  {
    v({"values", "as the quantity says", "values of the samples; null if a sample has none"}, q.values);
    v({"mean", "as the quantity says", "mean over the samples"}, q.statistics.mean);
    v({"deviation", "as the quantity says", "standard deviation of one sample"}, q.statistics.deviation);
    v({"pairs", "-", "samples with a value here and in the reference"}, q.pairs);
    v({"error", "as the quantity says",
       "point minus reference, sample by sample, with its 95 % interval (Student; relative errors: Fieller)"},
      q.error);
    v({"scatter", "as errors", "standard deviation of one sample about the reference's mean"}, q.scatter);
    v({"verdict", "-", "within, beyond or cannot tell"}, q.verdict);
  }

  // A point with its settings and results.
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
    v({"family", "-", "family of the point; references have none", Kind::setting},
      point.family < 0 ? std::string("reference") : p.study->families[std::size_t(point.family)].name);
    v({"reference", "-", "index in this list of its reference point", Kind::setting}, int(point.reference));
    v({"labels", "-", "labels of its places on the axes; references add the name of the axis", Kind::setting}, point.labels);
    v({"settings", "-", "settings beyond those of all points", Kind::setting}, point.settings);
    v({"folders", "-", "folders of its runs, one per sample", Kind::setting}, folders);
    v({"class", "-", "class: right; wrong, warned; silently wrong; struggled; stopped; refused; unjudged; not run"},
      discrete::name_of(record.kind));
    v({"certain", "-", "true if the intervals confirm the class"}, record.is_certain);
    v({"words", "-", "message of the first run that did not finish"}, record.words);
    v({"warned", "-", "runs in which a panel warned"}, record.warned);
    v({"halved_steps", "-", "steps halved because the sweeps stalled, in the worst run"}, record.halved_steps);
    v({"cut_backs", "-", "load steps that were halved, in the worst run"}, record.cut_backs);
    v.list("quantities", "in the order of the study's quantities", record.quantities);
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
    v({"family", "-", "family of the line", Kind::setting}, family ? family->name : std::string());
    v({"axis", "-", "axis along which the line runs", Kind::setting}, family ? family->axes[order.axis].name : std::string());
    v({"quantity", "-", "fitted quantity", Kind::setting}, o.study ? o.study->quantities[order.quantity].name : std::string());
    v({"labels", "-", "labels of the points on the other axes", Kind::setting}, order.labels);
    v({"points", "-", "number of points on the line"}, order.points);
    v({"order", "-", "p of value = limit + coefficient h^p, with the interval of a jackknife over the samples"}, order.order);
    v({"limit", "as the quantity says", "limit as h goes to 0"}, order.limit);
    v({"coefficient", "-", "coefficient of the fit"}, order.coefficient);
  }

  // All of study.json. It does not depend on when, where or in which order the points ran.
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
    v({"format", "-", "version of this file's format"}, 1);
    v({"title", "-", "title of the study", Kind::setting}, d.study.title);
    v({"name", "-", "name of the study", Kind::setting}, d.study.name);
    v({"scene", "-", "file name of the scene", Kind::setting}, d.study.scene.substr(d.study.scene.rfind('/') + 1));
    v({"command", "-", "command that every point runs", Kind::setting}, discrete::name_of(d.study.command));
    v({"revision", "-", "revision of the program's source", Kind::setting}, d.revision);
    v({"settings", "-", "settings of all points", Kind::setting}, common);
    v({"seeds", "-", "seeds of the samples; empty: the one sample of the scene", Kind::setting}, d.study.seeds);
    v({"student_t_95", "-", "half width of the intervals in standard errors; null for less than two samples"},
      n > 1 ? student_quantile(0.975, n - 1) : std::numeric_limits<double>::quiet_NaN());
    v.list("quantities", "measured quantities", d.study.quantities);
    v.list("families", "families of points", d.study.families);
    v.list("borders", "borders beyond which a method fails by theory", d.study.borders);
    v.list("points", "all points, references first", points);
    v.list("orders", "orders of convergence", orders);
  }

  template <class Visitor> void list_numbers(const PhaseMean &p, Visitor &v)
  {
    v({"name", "-", "name of the phase", Kind::setting}, p.name);
    v({"cpu_s", "s", "CPU time, mean over the samples", Kind::clock}, p.cpu_s);
  }

  template <class Visitor> void list_numbers(const PointCost &c, Visitor &v)
  {
    v({"point", "-", "index of the point in study.json", Kind::setting}, c.point);
    v({"cpu_s", "s", "CPU time of the phases that count, mean over the samples", Kind::clock}, c.cpu_s);
    v({"peak_memory_mb", "MB", "peak memory of the worst run", Kind::clock}, c.peak_memory_mb);
    v({"disturbed", "-", "runs during which the machine was busy with other work", Kind::clock}, c.disturbed);
    v({"front_of", "-", "quantities for which no point is both cheaper and closer to the reference", Kind::clock}, c.front_of);
    v.list("phases", "phases of a run", c.phases);
  }

  template <class Visitor> void list_numbers(const CheapestPoint &c, Visitor &v)
  {
    v({"quantity", "-", "quantity within the accuracy; empty: all with a limit", Kind::setting}, c.quantity);
    v({"accuracy", "as errors", "required accuracy; for all quantities: a multiple of their limits", Kind::setting}, c.accuracy);
    v({"reference", "-", "reference of the points that compete: index in study.json", Kind::setting}, c.reference);
    v({"point", "-", "cheapest point within the accuracy: index in study.json; -1: none", Kind::clock}, c.point);
    v({"cpu_s", "s", "CPU time of this point", Kind::clock}, c.cpu_s);
    v({"certain", "-", "true if the 95 % intervals of the errors are within the accuracy, too"}, c.is_certain);
  }

  // All of study_cost.json: measured times and what follows from them.
  template <class Visitor> void list_numbers(const StudyCost &c, Visitor &v)
  {
    v({"format", "-", "version of this file's format"}, 1);
    v({"phases", "-", "phases that count", Kind::setting}, c.phases);
    v({"disturbed", "-", "runs during which the machine was busy with other work", Kind::clock}, c.disturbed);
    v({"runs", "-", "runs that ended", Kind::clock}, c.runs);
    v({"total_cpu_s", "s", "CPU time of all phases of all runs", Kind::clock}, c.total_cpu_s);
    v.list("points", "finished points", c.points);
    v.list("cheapest", "cheapest point within each accuracy", c.cheapest);
  }
} // namespace diptych::coupling
