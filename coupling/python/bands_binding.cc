// diptych: Python binding of band detection and strips
// SPDX-License-Identifier: LGPL-2.1-or-later
#include "coupling/bands/band_detection.h"
#include "coupling/bands/strips.h"
#include "coupling/bands/theory_lines.h"
#include "coupling/comparison/increment.h"
#include "coupling/python/bindings.h"
#include "coupling/python/inputs.h"

namespace diptych::python
{
  namespace
  {
    coupling::DisplacementField field_of(const py::dict &arrays)
    {
      coupling::DisplacementField field{vectors_of(arrays["position"].cast<Numbers>(), "points"),
                                        vectors_of(arrays["increment"].cast<Numbers>(), "displacement"),
                                        numbers_of(arrays["weight"].cast<Numbers>(), "weight"),
                                        {}};
      if (field.increment.size() != field.position.size() || field.weight.size() != field.position.size())
        throw std::invalid_argument(
          "displacement and weight: one entry per point is needed: " + std::to_string(field.position.size()) + ", not " +
          std::to_string(field.increment.size()) + " and " + std::to_string(field.weight.size()));
      return field;
    }

    coupling::SampleFrame frame_of(const py::dict &frame)
    {
      coupling::SampleFrame result;
      result.centre           = vector_of(frame["centre"].cast<Numbers>(), "centre");
      result.width            = frame["width"].cast<double>();
      result.height           = frame["height"].cast<double>();
      result.mean_diameter    = frame["mean_diameter"].cast<double>();
      result.platen_increment = vector_of(frame["platen_increment"].cast<Numbers>(), "platen_increment");
      return result;
    }

    py::dict band_dict(const coupling::Band &band)
    {
      py::dict dict, intervals;
      dict["angle_deg"]         = band.angle_deg;
      dict["width_10_90"]       = band.width_10_90;
      dict["half_width"]        = band.half_width;
      dict["offset"]            = band.offset;
      dict["jump"]              = band.jump;
      dict["dilation_deg"]      = band.dilation_deg;
      dict["r_squared"]         = band.r_squared;
      dict["r_squared_strips"]  = band.r_squared_strips;
      dict["no_packs_because"]  = band.no_packs_because;
      dict["diffuse"]           = band.is_diffuse;
      intervals["angle_deg"]    = interval(band.interval.angle_deg);
      intervals["width_10_90"]  = interval(band.interval.width_10_90);
      intervals["half_width"]   = interval(band.interval.half_width);
      intervals["offset"]       = interval(band.interval.offset);
      intervals["jump"]         = interval(band.interval.jump);
      intervals["dilation_deg"] = interval(band.interval.dilation_deg);
      dict["interval"]          = intervals;
      return dict;
    }

    py::dict find_bands(const py::dict &arrays, const py::dict &frame_values, const std::uint64_t seed, const py::dict &keys)
    {
      const coupling::DisplacementField field = field_of(arrays);
      const coupling::SampleFrame       frame = frame_of(frame_values);
      coupling::BandOptions             options;
      set_options("comparison", keys, options);
      coupling::BandReport report;
      {
        const py::gil_scoped_release release;
        report = coupling::find_bands(field, frame, options, seed);
      }
      py::list bands;
      for (const coupling::Band &band : report.bands)
        bands.append(band_dict(band));
      py::dict dict;
      dict["bands"]       = bands;
      dict["verdict"]     = report.verdict;
      dict["converged"]   = report.converged;
      dict["bic"]         = own(std::vector<double>(report.bic.begin(), report.bic.end()));
      dict["residual"]    = own(std::vector<double>(report.residual.begin(), report.residual.end()));
      dict["n_effective"] = report.n_effective;
      return dict;
    }

    py::dict strips(const py::dict &arrays, const py::dict &frame_values, const double angle, const double offset, const int n)
    {
      if (n < 1)
        throw std::invalid_argument("n = " + std::to_string(n) + ": at least one strip is needed");
      const coupling::SampleFrame frame = frame_of(frame_values);
      coupling::Strips            cut   = coupling::strip_means(field_of(arrays), frame, angle,
                                                                coupling::strip_edges(frame, angle, offset, n));
      py::dict                    dict;
      dict["angle_deg"] = cut.angle_deg;
      dict["edges"]     = own(std::move(cut.edges));
      dict["mean"]      = own(std::move(cut.mean));
      dict["deviation"] = own(std::move(cut.deviation));
      dict["count"]     = own(std::move(cut.count));
      return dict;
    }

    py::dict increment_dict(coupling::DisplacementField field)
    {
      py::dict dict;
      dict["points"]       = own(std::move(field.position));
      dict["displacement"] = own(std::move(field.increment));
      dict["weight"]       = own(std::move(field.weight));
      return dict;
    }

    // With the same frame as the comparison.
    py::dict grain_increment(const discrete::Snapshot &from, const discrete::Snapshot &to)
    {
      py::dict                    dict  = increment_dict(coupling::displacement_field(from, to));
      const coupling::SampleFrame frame = coupling::sample_frame(from, to);
      dict["mean_diameter"]             = frame.mean_diameter;
      dict["platen_increment"]          = copy(frame.platen_increment);
      dict["centre"]                    = copy(frame.centre);
      dict["width"]                     = frame.width;
      dict["height"]                    = frame.height;
      return dict;
    }

    // A quantity of the affine fits around places.
    template <class T>
    py::array around(std::vector<T> (*of)(const coupling::DisplacementField &, const std::vector<Eigen::Vector2d> &, double),
                     const py::dict &arrays,
                     const Numbers  &at,
                     const double    radius)
    {
      const coupling::DisplacementField  field  = field_of(arrays);
      const std::vector<Eigen::Vector2d> places = vectors_of(at, "at");
      if (!(radius > 0))
        throw std::invalid_argument("radius must be positive");
      std::vector<T> found;
      {
        const py::gil_scoped_release release;
        found = of(field, places, radius);
      }
      return own(std::move(found));
    }
  } // namespace

  void bind_bands(py::module_ &m)
  {
    m.def("increment", &grain_increment);
    m.def("increment", [](const continuum::Snapshot &from, const continuum::Snapshot &to) {
      return increment_dict(coupling::displacement_field(from, to));
    });
    m.def("find_bands", &find_bands);
    m.def("strips", &strips);
    m.def("shear_strain", [](const py::dict &arrays, const Numbers &at, const double radius) {
      return around(&coupling::shear_strain_increment, arrays, at, radius);
    });
    m.def("displacement_gradient", [](const py::dict &arrays, const Numbers &at, const double radius) {
      return around(&coupling::displacement_gradient, arrays, at, radius);
    });
    m.def("theory_lines", [](const double friction, const double dilatancy) {
      const coupling::TheoryLines lines = coupling::theory_lines(friction, dilatancy);
      return py::make_tuple(lines.coulomb_deg, lines.roscoe_deg, lines.arthur_deg);
    });
  }
} // namespace diptych::python
