// diptych: entries of result files from the lists that write them
// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <string>
#include <type_traits>
#include <vector>

#include "discrete/files/field_arrays.h"

namespace diptych::coupling
{
  // One entry of a result file.
  struct ResultEntry
  {
    std::string file, name, shape, unit, meaning;
  };
  using ResultList = std::vector<ResultEntry>;

  template <class Value> std::string array_shape()
  {
    if constexpr (discrete::is_whole<Value>)
      return "whole numbers";
    else
      return discrete::n_components<Value> == 1 ? "numbers" : discrete::n_components<Value> == 3 ? "vectors" : "tensors";
  }

  template <class Value> std::string value_shape(const Value &)
  {
    if constexpr (std::is_enum_v<Value>)
      return "name";
    else if constexpr (discrete::is_whole<Value>)
      return "whole number";
    else
      return discrete::n_components<Value> == 1 ? "number" : discrete::n_components<Value> == 3 ? "vector" : "tensor";
  }

  // Columns of a .csv whose rows have a visit_columns.
  template <class Row> void add_columns(const std::string &file, ResultList &result)
  {
    const Row row;
    visit_columns(row, [&](const char *name, const auto &value, const char *unit, const char *meaning) {
      result.push_back({file, name, "column, " + value_shape(value), unit, meaning});
    });
  }
} // namespace diptych::coupling
