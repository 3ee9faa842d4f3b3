// diptych: rows of a history as NumPy columns
// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <string>
#include <type_traits>
#include <vector>

#include <pybind11/numpy.h>

#include "discrete/choices.h"

namespace diptych::python
{
  namespace py = pybind11;

  // Each Row type has a function visit_columns that calls visit(name, value, unit, meaning).
  template <class Row> py::dict row_dict(const Row &row)
  {
    py::dict dict;
    visit_columns(row, [&](const char *name, const auto &value, const char *, const char *) {
      if constexpr (std::is_enum_v<std::decay_t<decltype(value)>>)
        dict[name] = discrete::name_of(value);
      else
        dict[name] = value;
    });
    return dict;
  }

  // name -> (n) array of doubles or integers; for choices a list of texts.
  template <class Row> py::dict columns_dict(const std::vector<Row> &rows)
  {
    py::dict dict;
    Row      prototype;
    visit_columns(prototype, [&](const char *name, auto &value, const char *, const char *) {
      using Value = std::decay_t<decltype(value)>;
      if constexpr (std::is_enum_v<Value>)
        dict[name] = py::list(rows.size());
      else
        dict[name] = py::array_t<Value>(py::ssize_t(rows.size()));
    });
    std::vector<py::object> column;
    for (const auto &[name, values] : dict)
      column.push_back(py::reinterpret_borrow<py::object>(values));
    for (std::size_t k = 0; k < rows.size(); ++k)
      {
        auto next = column.begin();
        visit_columns(rows[k], [&](const char *, const auto &value, const char *, const char *) {
          using Value = std::decay_t<decltype(value)>;
          if constexpr (std::is_enum_v<Value>)
            py::reinterpret_borrow<py::list>(*next++)[k] = discrete::name_of(value);
          else
            static_cast<Value *>(const_cast<void *>(py::reinterpret_borrow<py::array>(*next++).data()))[k] = value;
        });
      }
    return dict;
  }

  template <class Row> py::dict column_meanings()
  {
    py::dict dict;
    Row      prototype;
    visit_columns(prototype, [&](const char *name, auto &, const char *unit, const char *meaning) {
      dict[name] = py::make_tuple(unit, meaning);
    });
    return dict;
  }
} // namespace diptych::python
