// diptych: the one list of the numbers of an ensemble
// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <array>
#include <limits>
#include <string>
#include <vector>

#include "coupling/ensembles/ensemble.h"
#include "coupling/numbers/number_entry.h"
#include "coupling/statistics/student.h"

namespace diptych::coupling
{
  template <class Visitor> void list_numbers(const Quantity &q, Visitor &v)
  {
    const SampleStatistics &s = q.statistics;
    v({"name", "-", "of the quantity: stage or window, panel and key of comparison.json"}, q.name);
    v({"unit", "-", "of the quantity"}, q.unit);
    v({"n", "-", "members that have a value"}, s.n);
    v({"mean", "as unit says", "of the members"}, s.mean);
    v({"deviation", "as unit says", "standard deviation of one member"}, s.deviation);
    v({"low", "as unit says", "lower end of the 95 % Student interval of the mean"}, s.low);
    v({"high", "as unit says", "upper end of the same interval"}, s.high);
    v({"values", "as unit says", "of the members, in the order of done; null where one has none"}, q.values);
  }

  template <class Visitor> void list_numbers(const BandCount &b, Visitor &v)
  {
    v({"name", "-", "of the window and the panel"}, b.name);
    v({"none", "-", "members in which no band was found"}, b.members[0]);
    v({"one", "-", "members in which one band was found"}, b.members[1]);
    v({"two", "-", "members in which two bands were found"}, b.members[2]);
    v({"text", "-", "the same in words"}, text_of(b));
  }

  template <class Visitor> void list_numbers(const PanelVerdict &p, Visitor &v)
  {
    v({"quantity", "-", "what is compared: continuum minus grains, member by member"}, p.quantity);
    v({"unit", "-", "of the quantity"}, p.unit);
    v({"margin", "as unit says", "up to where the panels count as equivalent"}, p.margin);
    v({"relative", "-", "margin and difference are relative to the mean of the grains"}, p.relative);
    v({"difference", "as unit says", "mean difference"}, p.equivalence.difference);
    v({"difference_90", "as unit says", "the same with its 90 % interval, of which the verdict equivalent speaks"},
      p.equivalence.difference_90);
    v({"n", "-", "pairs"}, p.equivalence.n);
    v({"verdict", "-", "equivalent, different or cannot tell"}, text_of(p.equivalence.verdict));
    v({"discrete", "as unit says", "the grains' values, in the order of done"}, p.discrete);
    v({"continuum", "as unit says", "the continuum's values, in the order of done"}, p.continuum);
  }

  template <class Visitor> void list_numbers(const FailedMember &f, Visitor &v)
  {
    v({"seed", "-", "of the member"}, f.seed);
    v({"exit_code", "-", "of its run; 128 + signal where a signal ended it"}, f.exit_code);
    v({"message", "-", "last words of its log"}, f.message);
  }

  template <class Visitor> void list_numbers(const EquivalenceMargins &m, Visitor &v)
  {
    EquivalenceMargins margins = m; // keys are listed for who may set them
    visit_parameters(
      margins, [&v](const char *key, const double value, const char *unit, const std::array<double, 2> &, const char *meaning) {
        v({key, unit, meaning, Kind::setting}, value);
      });
  }

  struct EnsembleDocument
  {
    const Scene          &scene;
    const EnsembleRecord &record;
  };
  template <class Visitor> void list_numbers(const EnsembleDocument &d, Visitor &v)
  {
    const Ensemble &e = d.record.ensemble;
    const int       n = int(e.seeds.size());
    v({"format", "-", "of this file"}, 1);
    v({"scene", "-", "name of the scene"}, d.scene.name);
    v({"seeds", "-", "asked for"}, d.record.seeds);
    v({"done", "-", "seeds of the members"}, e.seeds);
    v.list("failed", "seeds whose run ended with another exit code than 0", d.record.failed);
    v({"interrupted", "-", "seeds that were stopped or not begun"}, d.record.interrupted);
    v.group("margins", "of the scene", d.scene.comparison.margins);
    v({"walk", "-", "what progress is: axial_strain, shear_strain or time"},
      std::string(discrete::name_of(discrete::walk_of(d.scene.loading.mode))));
    v({"folded", "-", "mirror images of bands were brought together"}, is_mirror_symmetric(d.scene));
    v({"student_t_95", "-", "half width of the intervals in standard errors; null for less than two members"},
      n > 1 ? student_quantile(0.975, n - 1) : std::numeric_limits<double>::quiet_NaN());
    v.list("quantities", "every number of comparison.json that may be averaged", e.quantities);
    v.list("bands", "how many bands were found", e.bands);
    v.list("verdicts", "whether the panels are equivalent", e.verdicts);
  }

  // Columns of ensemble.csv, a line a quantity; after them one a seed, seed_N.
  inline std::array<NumberEntry, 7> ensemble_columns()
  {
    return {{{"quantity", "-", "stage or window, panel and key of comparison.json"},
             {"unit", "-", "of the quantity"},
             {"n", "-", "members that have a value; their values follow in columns seed_N"},
             {"mean", "as unit says", "of the members"},
             {"deviation", "as unit says", "standard deviation of one member"},
             {"low", "as unit says", "lower end of the 95 % Student interval of the mean"},
             {"high", "as unit says", "upper end of the same interval"}}};
  }
} // namespace diptych::coupling
