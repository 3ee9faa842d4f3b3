// diptych: entries of result files from the lists that write them
// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <array>
#include <string>
#include <type_traits>
#include <vector>

#include "coupling/numbers/array_entry.h"
#include "coupling/numbers/number_schema.h"
#include "discrete/files/field_arrays.h"

namespace diptych::coupling
{
  // One entry of a result file.
  struct ResultEntry
  {
    std::string file, name, shape, unit, meaning;
  };
  using ResultList = std::vector<ResultEntry>;

  template <class T> inline constexpr std::size_t row_length = 0; // row length of arrays with rows of whole numbers
  template <class Whole, std::size_t n> inline constexpr std::size_t row_length<std::array<Whole, n>> = n;

  template <class Value> std::string array_shape()
  {
    if constexpr (discrete::is_whole<Value>)
      return "whole numbers";
    else if constexpr (row_length<Value> > 0)
      return std::to_string(row_length<Value>) + " whole numbers a row";
    else if constexpr (std::is_same_v<Value, std::vector<double>>)
      return "rows of numbers";
    else
      return discrete::n_components<Value> == 1 ? "numbers" : discrete::n_components<Value> == 3 ? "vectors" : "tensors";
  }

  template <class Value> std::string value_shape(const Value &)
  {
    if constexpr (std::is_enum_v<Value> || std::is_same_v<Value, std::string>)
      return "name";
    else if constexpr (discrete::is_whole<Value>)
      return "whole number";
    else
      return discrete::n_components<Value> == 1 ? "number" : discrete::n_components<Value> == 3 ? "vector" : "tensor";
  }

  // Adds the columns of a .csv whose row type has a visit_columns.
  template <class Row> void add_columns(const std::string &file, ResultList &result)
  {
    const Row row;
    visit_columns(row, [&](const char *name, const auto &value, const char *unit, const char *meaning) {
      result.push_back({file, name, "column, " + value_shape(value), unit, meaning});
    });
  }

  template <class Columns> void add_table(const std::string &file, const Columns &columns, ResultList &result)
  {
    for (const NumberEntry &column : columns)
      result.push_back({file, column.key, "column", column.unit, column.meaning});
  }

  // Adds the arrays and attributes that a listing function visits, below a place in a file.
  struct AddArrays
  {
    std::string file, place;
    ResultList &result;

    template <class T> void operator()(const ArrayEntry &entry, const std::vector<T> &) const
    {
      result.push_back({file, place + entry.key, array_shape<T>(), entry.unit, std::string(entry.title) + "; " + entry.meaning});
    }
    template <class T> void operator()(const NumberEntry &entry, const T &value) const
    {
      result.push_back({file, place + entry.key, "attribute, " + value_shape(value), entry.unit, entry.meaning});
    }
  };

  inline void add_numbers(const std::string &file, const NumberSchema &schema, ResultList &result)
  {
    for (const NumberDescription &number : schema)
      result.push_back({file, number.place, number.shape, number.unit, number.meaning});
  }

  // Adds the entries of a record that has a list_numbers.
  template <class Record> void add_record(const std::string &file, const Record &record, ResultList &result)
  {
    NumberSchema   schema;
    CollectNumbers collector{schema, ""};
    list_numbers(record, collector);
    add_numbers(file, schema, result);
  }
} // namespace diptych::coupling
