// diptych: Python binding of the constitutive laws at one point
// SPDX-License-Identifier: LGPL-2.1-or-later
#include "coupling/python/law_binding.h"

#include "continuum/laws/material_point.h"
#include "continuum/laws/strain_path.h"
#include "coupling/python/arrays.h"
#include "coupling/python/rows.h"
#include "coupling/scene/scene.h"

namespace diptych::python
{
  namespace
  {
    // start: stress (2, 2) and stress_zz; time: (n) or None.
    py::dict integrate(const coupling::Scene &scene, const Numbers &strain, const py::tuple &start, const py::object &time)
    {
      continuum::StrainPath path;
      path.strain       = tensors_of(strain, "strain_path");
      const auto stress = tensors_of(py::array(start[0].cast<Numbers>()).reshape({1, 2, 2}), "stress");
      path.stress       = stress.front();
      path.stress_zz    = start[1].cast<double>();
      if (!time.is_none())
        path.time = numbers_of(time.cast<Numbers>(), "time");
      std::vector<continuum::StrainPathRow> rows;
      {
        const py::gil_scoped_release release;
        rows = continuum::drive_strain_path(scene.continuum.law, scene.continuum.material, coupling::continuum_units(scene),
                                            path);
      }
      std::vector<Eigen::Matrix2d> stresses;
      std::vector<double>          zz, plastic, dissipation;
      std::vector<std::uint8_t>    reliable;
      for (const continuum::StrainPathRow &row : rows)
        {
          stresses.push_back(row.stress);
          zz.push_back(row.stress_zz);
          plastic.push_back(row.equivalent_plastic_strain);
          dissipation.push_back(row.dissipation);
          reliable.push_back(row.verdict == continuum::Verdict::reliable);
        }
      py::dict dict;
      dict["stress"]                    = own(std::move(stresses));
      dict["stress_zz"]                 = own(std::move(zz));
      dict["equivalent_plastic_strain"] = own(std::move(plastic));
      dict["dissipation"]               = own(std::move(dissipation));
      dict["reliable"]                  = own(std::move(reliable));
      return dict;
    }

    // (columns, message of the failure; empty if finished)
    py::tuple biaxial(const coupling::Scene &scene, const double axial_strain, const double step)
    {
      continuum::MaterialPointReport report;
      {
        const py::gil_scoped_release release;
        const continuum::Law         law = continuum::make_law(uniform_law(scene.continuum.law), scene.continuum.material,
                                                               coupling::continuum_units(scene));
        report                           = continuum::drive_material_point(law, {scene.loading.pressure, axial_strain, step});
      }
      const bool finished = report.status == continuum::MaterialPointStatus::finished;
      return py::make_tuple(columns_dict(report.rows), finished ? "" : report.message);
    }
  } // namespace

  void bind_laws(py::module_ &m)
  {
    m.def("integrate", &integrate);
    m.def("biaxial", &biaxial);
    m.def("point_columns", &column_meanings<continuum::MaterialPointRow>);
  }
} // namespace diptych::python
