// diptych: Python binding of the constitutive laws at one point
// SPDX-License-Identifier: LGPL-2.1-or-later
#include "coupling/python/law_binding.h"

#include "continuum/laws/material_point.h"
#include "coupling/python/arrays.h"
#include "coupling/python/rows.h"
#include "coupling/scene/scene.h"

namespace diptych::python
{
  namespace
  {
    // (columns, message of the failure; empty if finished)
    py::tuple drive(const coupling::Scene &scene, const continuum::PointPath &path)
    {
      continuum::MaterialPointReport report;
      {
        const py::gil_scoped_release release;
        report = continuum::drive_material_point(scene.continuum.law, scene.continuum.material, coupling::continuum_units(scene),
                                                 path);
      }
      const bool finished = report.status == continuum::MaterialPointStatus::finished;
      py::dict   columns  = columns_dict(report.rows);
      for (std::size_t k = 0; k < report.variables.size(); ++k)
        {
          std::vector<double> values;
          for (const continuum::MaterialPointRow &row : report.rows)
            values.push_back(row.variables[k]);
          columns[py::str(report.variables[k])] = own(std::move(values));
        }
      return py::make_tuple(columns, finished ? "" : report.message);
    }

    template <class Choice> Choice choice_of(const std::string &name, const std::string &what)
    {
      if (const auto found = continuum::value_of<Choice>(name))
        return *found;
      std::string known;
      for (const auto &[choice, text] : choices(Choice()))
        known += (known.empty() ? "" : ", ") + std::string(text);
      throw std::invalid_argument(what + " = '" + name + "' is not allowed; give one of " + known);
    }

    // start: stress (2, 2) and stress_zz; columns: three names and an array for each; progress: (n) or None.
    py::tuple integrate(const coupling::Scene &scene, const py::tuple &start, const py::dict &columns, const py::object &progress)
    {
      continuum::PointPath path;
      path.pressure  = scene.loading.pressure;
      path.stress    = tensors_of(py::array(start[0].cast<Numbers>()).reshape({1, 2, 2}), "stress").front();
      path.stress_zz = start[1].cast<double>();
      int k          = 0;
      for (const auto &[name, column] : columns)
        {
          path.controls[k]                  = choice_of<continuum::Control>(name.cast<std::string>(), "a column of the path");
          const std::vector<double> numbers = numbers_of(column.cast<Numbers>(), name.cast<std::string>());
          path.values.resize(numbers.size());
          for (std::size_t row = 0; row < numbers.size(); ++row)
            path.values[row][k] = numbers[row];
          ++k;
        }
      if (!progress.is_none())
        path.progress = numbers_of(progress.cast<Numbers>(), "progress");
      try
        {
          return drive(scene, path);
        }
      catch (const continuum::WrongPath &wrong)
        {
          const bool is_header = wrong.row == continuum::WrongPath::header;
          throw std::invalid_argument("path" + (is_header ? "" : "[" + std::to_string(wrong.row) + "]") + ": " + wrong.what());
        }
    }

    py::tuple named_path(const coupling::Scene &scene, const std::string &name, const double strain, const double step)
    {
      return drive(scene, continuum::named_path(choice_of<continuum::NamedPath>(name, "path"),
                                                {scene.loading.pressure, strain, step, scene.continuum.k0}));
    }
  } // namespace

  void bind_laws(py::module_ &m)
  {
    m.def("integrate", &integrate);
    m.def("named_path", &named_path);
    m.def("follows_solid_fraction", [](const std::string &hardening) {
      return continuum::follows_solid_fraction(choice_of<continuum::HardeningKind>(hardening, "continuum/hardening"));
    });
    m.def("point_columns", &column_meanings<continuum::MaterialPointRow>);
  }
} // namespace diptych::python
