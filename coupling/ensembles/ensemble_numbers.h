// diptych: the list of all numbers in the result files of an ensemble
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
    v({"name", "-", "name of the quantity: stage or window, panel and key of comparison.json"}, q.name);
    v({"unit", "-", "unit of the quantity"}, q.unit);
    v({"n", "-", "number of members with a value"}, s.n);
    v({"mean", "as unit says", "mean over the members"}, s.mean);
    v({"deviation", "as unit says", "standard deviation of one member"}, s.deviation);
    v({"low", "as unit says", "lower end of the 95 % Student interval of the mean"}, s.low);
    v({"high", "as unit says", "upper end of the same interval"}, s.high);
    v({"values", "as unit says", "values of the members, in the order of done; null if a member has none"}, q.values);
  }

  template <class Visitor> void list_numbers(const BandCount &b, Visitor &v)
  {
    v({"name", "-", "window and panel"}, b.name);
    v({"none", "-", "number of members without a band"}, b.members[0]);
    v({"one", "-", "number of members with one band"}, b.members[1]);
    v({"two", "-", "number of members with two bands"}, b.members[2]);
    v({"text", "-", "the same as text"}, text_of(b));
  }

  template <class Visitor> void list_numbers(const PanelVerdict &p, Visitor &v)
  {
    v({"quantity", "-", "compared quantity: continuum minus grains, member by member"}, p.quantity);
    v({"unit", "-", "unit of the quantity"}, p.unit);
    v({"margin", "as unit says", "largest difference that counts as equivalent"}, p.margin);
    v({"relative", "-", "true if margin and difference are relative to the mean of the grains"}, p.relative);
    v({"difference", "as unit says", "mean difference"}, p.equivalence.difference);
    v({"difference_90", "as unit says", "mean difference with its 90 % interval, on which the verdict equivalent rests"},
      p.equivalence.difference_90);
    v({"n", "-", "number of pairs"}, p.equivalence.n);
    v({"verdict", "-", "equivalent, different or cannot tell"}, text_of(p.equivalence.verdict));
    v({"discrete", "as unit says", "values of the grains, in the order of done"}, p.discrete);
    v({"continuum", "as unit says", "values of the continuum, in the order of done"}, p.continuum);
  }

  template <class Visitor> void list_numbers(const FailedMember &f, Visitor &v)
  {
    v({"seed", "-", "seed of the member"}, f.seed);
    v({"exit_code", "-", "exit code of its run; 128 + signal if a signal ended it"}, f.exit_code);
    v({"message", "-", "last line of its log"}, f.message);
  }

  template <class Visitor> void list_numbers(const EquivalenceMargins &m, Visitor &v)
  {
    EquivalenceMargins margins = m; // visit_parameters() takes a reference that is not const
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
    v({"format", "-", "version of this file's format"}, 1);
    v({"scene", "-", "name of the scene"}, d.scene.name);
    v({"seeds", "-", "requested seeds"}, d.record.seeds);
    v({"done", "-", "seeds of the finished members"}, e.seeds);
    v.list("failed", "seeds whose run ended with an exit code other than 0", d.record.failed);
    v({"interrupted", "-", "seeds that were stopped or not started"}, d.record.interrupted);
    v.group("margins", "margins of the scene", d.scene.comparison.margins);
    v({"walk", "-", "loading variable: axial_strain, shear_strain or time"},
      std::string(discrete::name_of(discrete::walk_of(d.scene.loading.mode))));
    v({"folded", "-", "true if mirror images of bands were folded together"}, is_mirror_symmetric(d.scene));
    v({"student_t_95", "-", "half width of the intervals in standard errors; null for less than two members"},
      n > 1 ? student_quantile(0.975, n - 1) : std::numeric_limits<double>::quiet_NaN());
    v.list("quantities", "every number of comparison.json that may be averaged", e.quantities);
    v.list("bands", "number of bands found", e.bands);
    v.list("verdicts", "verdicts on the differences of the panels", e.verdicts);
  }

  // Columns of ensemble.csv: one line per quantity, then one column seed_N per seed.
  inline std::array<NumberEntry, 7> ensemble_columns()
  {
    return {{{"quantity", "-", "stage or window, panel and key of comparison.json"},
             {"unit", "-", "unit of the quantity"},
             {"n", "-", "number of members with a value; the values are in columns seed_N"},
             {"mean", "as unit says", "mean over the members"},
             {"deviation", "as unit says", "standard deviation of one member"},
             {"low", "as unit says", "lower end of the 95 % Student interval of the mean"},
             {"high", "as unit says", "upper end of the same interval"}}};
  }
} // namespace diptych::coupling
