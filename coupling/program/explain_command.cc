// diptych: what keys and results mean
// SPDX-License-Identifier: LGPL-2.1-or-later
#include "coupling/program/explain_command.h"

#include <iostream>

#include "coupling/program/step_comparison.h"
#include "coupling/import/import_record.h"
#include "coupling/program/result_entries.h"
#include "coupling/scene/scene_file.h"
#include "coupling/store/origin.h"
#include "discrete/panel/history.h"
#include "discrete/snapshot_fields.h"

namespace diptych::coupling
{
  ResultList discrete_result_entries()
  {
    using namespace discrete;
    ResultList result;
    add_columns<discrete::HistoryRow>("discrete.csv", result);
    result.push_back({"discrete.h5", "stages", "attribute, whole number", "-", "number of groups stage_NNNN"});
    const std::string  h5 = "discrete.h5, group stage_NNNN";
    discrete::Snapshot s;
    const auto         add = [&](const std::string &name, const auto &values, const char *unit, const char *meaning) {
      using Value = typename std::decay_t<decltype(values)>::value_type;
      result.push_back({h5, name, array_shape<Value>(), unit, meaning});
    };
    visit_attributes(s, [&](const char *name, const auto &value, const char *unit, const char *meaning) {
      result.push_back({h5, name, "attribute, " + value_shape(value), unit, meaning});
    });
    visit_grain_fields(s, add);
    visit_contact_lists(s, [&](const std::string &list, const auto &, const char *, const char *meaning) {
      result.push_back({h5, list, "group", "", meaning});
      result.push_back({h5, list + "/body", "pairs of whole numbers", "-", contact_bodies});
      ContactForce prototype{};
      visit_contact_fields(prototype, [&](const std::string &name, const auto &value, const char *unit, const char *what) {
        result.push_back({h5, list + "/" + name, array_shape<std::decay_t<decltype(value)>>(), unit, what});
      });
    });
    result.push_back({h5, "contacts/impulse", "pairs of numbers", "pressure length time", contact_impulses});
    visit_contact_values(s, add);
    visit_outline(s, add);
    add_table("study_step.csv", step_study_columns(), result);
    add_record("study_step.json", StepComparison(), result);
    add_record("provenance.json", ProvenanceDocument{Origin(), RunFacts()}, result);
    add_record("import.json", ImportRecord(), result);
    result.push_back({h5, "not_told", "attribute, name", "-",
                      "arrays that are missing here because the files of another code did not hold them (imported)"});
    result.push_back({"checkpoint.h5, continuum_checkpoint.h5", "/", "group", "",
                      "state from which --resume continues; its layout changes with the program"});
    return result;
  }

  int explain(const CommandLine &line, const std::vector<std::function<ResultList()>> &lists)
  {
    if (line.target != "results")
      {
        std::cout << explain(line.target);
        return done;
      }
    std::string file;
    for (const auto &list : lists)
      for (const ResultEntry &entry : list())
        {
          if (entry.file != file)
            std::cout << (file.empty() ? "" : "\n") << entry.file << '\n';
          file = entry.file;
          std::cout << "  " << entry.name << "  [" << (entry.unit.empty() ? "-" : entry.unit) << "]  " << entry.shape
                    << "\n      " << entry.meaning << '\n';
        }
    return done;
  }
} // namespace diptych::coupling
