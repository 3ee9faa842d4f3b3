// diptych: what the continuum's and the comparison's files hold
// SPDX-License-Identifier: LGPL-2.1-or-later
#include "continuum/history.h"
#include "continuum/laws/material_point_row.h"
#include "continuum/snapshot_fields.h"
#include "coupling/comparison/comparison_arrays.h"
#include "coupling/comparison/comparison_output.h"
#include "coupling/comparison/comparison_schema.h"
#include "coupling/comparison/key_numbers.h"
#include "coupling/program/result_entries.h"

namespace diptych::coupling
{
  namespace
  {
    void add_continuum_file(ResultList &result)
    {
      result.push_back({"continuum.h5", "stages", "attribute, whole number", "-", "number of groups stage_NNNN"});
      const std::string         h5 = "continuum.h5, group stage_NNNN; continuum/stage_NNNN.vtu";
      const continuum::Snapshot s;
      continuum::visit_attributes(s, [&](const char *name, const auto &value, const char *unit, const char *meaning) {
        result.push_back({h5, name, "attribute, " + value_shape(value), unit, meaning});
      });
      result.push_back({h5, continuum::cells_name, "nine whole numbers a cell", "-", continuum::cells_meaning});
      continuum::visit_node_fields(s, [&](const std::string &name, const auto &values, const char *unit, const char *meaning) {
        result.push_back({h5, name, array_shape<typename std::decay_t<decltype(values)>::value_type>(), unit, meaning});
      });
      const continuum::CellState cell;
      continuum::visit_cell_fields(cell, [&](const std::string &name, const auto &value, const char *unit, const char *meaning) {
        result.push_back({h5, name, array_shape<std::decay_t<decltype(value)>>(), unit, meaning});
      });
      result.push_back({h5, "cells/law.NAME", array_shape<double>(), "of the library", "state variable NAME; law = library"});
    }

    void add_comparison_arrays(ResultList &result)
    {
      const Increment          increment;
      const discrete::Snapshot grains;
      const CellFields         fields;
      const HistoryTable       history = history_table(std::vector<discrete::HistoryRow>(1));
      const std::string        stages = "comparison.h5, group stage_NNNN", windows = "comparison.h5, group window_N";
      list_file_attributes(LoadingOptions(), 1, grains, AddArrays{"comparison.h5", "", result});
      list_increment_attributes(increment, AddArrays{stages, "", result});
      list_increment_arrays(increment, grains, AddArrays{stages, "", result});
      list_grain_arrays(increment, grains, grains, AddArrays{stages, "", result});
      list_mesh_arrays(QuadMesh(), AddArrays{stages, "cells/, grid/ ", result});
      list_cell_arrays(fields, {}, AddArrays{stages + "; fields/stage_NNNN.vtu (cells)", "cells/, grid/ ", result});
      list_increment_attributes(increment, AddArrays{windows, "", result});
      list_increment_arrays(increment, grains, AddArrays{windows, "", result});
      for (const std::string &group : {stages, windows})
        for (const char *panel : {"profile/discrete/", "profile/continuum/"})
          list_profile_arrays(BandProfile(), AddArrays{group, panel, result});
      list_mesh_arrays(QuadMesh(), AddArrays{windows, "cells/", result});
      list_window_cell_arrays(increment, {}, AddArrays{windows, "cells/", result});
      list_platen_arrays(PlatenParts(), 1, AddArrays{"comparison.h5, groups platens/discrete and platens/continuum", "", result});
      list_history_arrays(history, 1, AddArrays{"comparison.h5, groups histories/discrete and histories/continuum", "", result});
    }
  } // namespace

  ResultList comparison_result_entries()
  {
    ResultList result;
    add_columns<continuum::HistoryRow>("continuum.csv", result);
    add_continuum_file(result);
    add_columns<continuum::MaterialPointRow>("material_point.csv", result);
    add_numbers("comparison.json", comparison_schema(), result);
    add_table("comparison.csv", comparison_columns(), result);
    add_table("summary.csv", summary_columns(), result);
    add_comparison_arrays(result);
    return result;
  }
} // namespace diptych::coupling
