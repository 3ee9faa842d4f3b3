// diptych: Python binding for histories of runs and the numbers that panels are compared by
// SPDX-License-Identifier: LGPL-2.1-or-later
#include <pybind11/stl.h>

#include "coupling/comparison/comparison.h"
#include "coupling/comparison/key_numbers.h"
#include "coupling/python/arrays.h"
#include "coupling/python/bindings.h"
#include "discrete/choices.h"

namespace diptych::python
{
  namespace
  {
    // nan: a row without a value
    std::vector<double> column_of(const Numbers &values)
    {
      return {values.data(), values.data() + values.size()};
    }

    coupling::HistoryTable line_of(const Numbers &x, const Numbers &y)
    {
      coupling::HistoryTable table = {{"progress", numbers_of(x, "x")}, {"y", column_of(y)}};
      if (table["progress"].empty() || table["progress"].size() != table["y"].size())
        throw std::invalid_argument("x and y need the same number of entries, at least one");
      return table;
    }

    coupling::HistoryTable table_of(const std::map<std::string, Numbers> &columns)
    {
      coupling::HistoryTable table;
      for (const auto &[name, values] : columns)
        table[name] = column_of(values);
      return table;
    }

    py::list quantities()
    {
      py::list list;
      for (const coupling::KeyQuantity &q : coupling::key_quantities)
        list.append(py::dict(py::arg("key") = q.key, py::arg("name") = q.name, py::arg("unit") = q.unit,
                             py::arg("margin") = q.margin.key, py::arg("difference") = discrete::name_of(q.margin.of),
                             py::arg("is_of_band") = q.of_panel == nullptr));
      return list;
    }
  } // namespace

  void bind_histories(py::module_ &m)
  {
    m.attr("EARLY_STRAIN") = coupling::early_strain;
    m.def("key_quantities", &quantities);
    m.def("origin_of_law", &coupling::origin_of_law);
    m.def("count_of_checks", &coupling::count_of_checks);
    m.def("panel_values", [](const coupling::Scene &scene, const std::map<std::string, Numbers> &columns) {
      return coupling::panel_values(coupling::basis_of(scene), table_of(columns));
    });
    m.def("side_pressure", [](const coupling::Scene &scene) { return coupling::basis_of(scene).side_pressure; });
    m.def("nominal_stress_ratio", [](const coupling::Scene &scene, const std::map<std::string, Numbers> &columns) {
      return own(coupling::nominal_stress_ratio(coupling::basis_of(scene), table_of(columns)));
    });
    m.def("stress_ratio_of_means", [](const std::map<std::string, Numbers> &columns, const double from, const double to) {
      return coupling::ratio_of_means(table_of(columns), from, to);
    });
    m.def("is_beyond", &coupling::is_beyond);
    m.def("mean_over", [](const Numbers &x, const Numbers &y, const double from, const double to) {
      return coupling::mean_over_progress(line_of(x, y), "y", from, to);
    });
    m.def("running_mean", [](const Numbers &x, const Numbers &y, const double width) {
      return own(coupling::running_mean(line_of(x, y), "y", width));
    });
    m.def("peak_of_running_mean", [](const Numbers &x, const Numbers &y, const double width) {
      return coupling::peak_of_running_mean(line_of(x, y), "y", width).value;
    });
  }
} // namespace diptych::python
