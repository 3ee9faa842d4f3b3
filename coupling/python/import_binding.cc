// diptych: Python binding of the import: frames of another code
// SPDX-License-Identifier: LGPL-2.1-or-later
#include <algorithm>
#include <cmath>

#include <pybind11/stl.h>

#include "coupling/import/arrival.h"
#include "coupling/import/import_door.h"
#include "coupling/import/imported_results.h"
#include "coupling/python/arrays.h"
#include "coupling/python/bindings.h"

namespace diptych::python
{
  namespace
  {
    using coupling::not_told;

    // Columns of a dict, each with one row per grain or contact. Values of missing columns are unknown.
    struct Columns
    {
      py::dict    table;
      std::string name;
      std::size_t n_rows;

      template <class Values> void require_rows(const Values &values, const char *column) const
      {
        if (values.size() != n_rows)
          throw std::invalid_argument(name + "['" + column + "'] has " + std::to_string(values.size()) + " rows instead of " +
                                      std::to_string(n_rows));
      }
      // Optional columns may hold nan.
      std::vector<double> numbers(const char *column, const double otherwise = not_told) const
      {
        if (!table.contains(column))
          return std::vector<double>(n_rows, otherwise);
        const auto array = table[column].cast<Numbers>();
        if (array.ndim() != 1)
          refuse_shape(array, name + "['" + column + "']", "(n)");
        std::vector<double> values(array.data(), array.data() + array.size());
        require_rows(values, column);
        return values;
      }
      std::vector<Eigen::Vector2d> vectors(const char *column) const
      {
        std::vector<Eigen::Vector2d> values(n_rows, {not_told, not_told});
        if (!table.contains(column))
          return values;
        const auto array = table[column].cast<Numbers>();
        if (array.ndim() != 2 || array.shape(1) != 2)
          refuse_shape(array, name + "['" + column + "']", "(n, 2)");
        values.resize(std::size_t(array.shape(0)));
        require_rows(values, column);
        for (std::size_t k = 0; k < n_rows; ++k)
          values[k] = {array.data()[2 * k], array.data()[2 * k + 1]};
        return values;
      }
      std::vector<Eigen::Vector2d> finite_vectors(const char *column) const
      {
        auto values = vectors_of(table[column].cast<Numbers>(), name + "['" + column + "']");
        require_rows(values, column);
        return values;
      }
    };

    Columns columns_of(const py::handle &table, const std::string &name, const std::vector<const char *> &required)
    {
      const auto dict = table.cast<py::dict>();
      for (const char *column : required)
        if (!dict.contains(column))
          throw std::invalid_argument(name + " lacks '" + column + "'");
      return {dict, name, py::len(dict[required.front()])};
    }

    void take_grains(const py::object &from, coupling::ForeignFrame &to)
    {
      const Columns grains = columns_of(from, "grains of frame " + to.name, {"id", "position", "radius"});
      const auto    id = grains.numbers("id"), line = grains.numbers("line", 0);
      const auto    position = grains.finite_vectors("position"), velocity = grains.vectors("velocity"),
                 resultant = grains.vectors("resultant");
      const auto radius = grains.numbers("radius"), mass = grains.numbers("mass"), spin = grains.numbers("spin"),
                 rotation = grains.numbers("rotation");
      for (std::size_t k = 0; k < grains.n_rows; ++k)
        to.grains.push_back(
          {long(id[k]), position[k], radius[k], mass[k], velocity[k], spin[k], rotation[k], resultant[k], int(line[k])});
    }

    void take_contacts(const py::object &from, coupling::ForeignFrame &to)
    {
      const Columns contacts = columns_of(from, "contacts of frame " + to.name, {"first", "second", "wall", "force"});
      const auto    first = contacts.numbers("first"), second = contacts.numbers("second"), wall = contacts.numbers("wall"),
                 overlap = contacts.numbers("overlap"), slides = contacts.numbers("slides"), line = contacts.numbers("line", 0);
      const auto force = contacts.finite_vectors("force"), point = contacts.vectors("point");
      to.has_contacts = true;
      for (std::size_t k = 0; k < contacts.n_rows; ++k)
        {
          if (wall[k] >= double(to.walls.size()))
            throw std::invalid_argument(contacts.name + ": 'wall' = " + std::to_string(int(wall[k])) + ", but the frame has " +
                                        std::to_string(to.walls.size()) + " walls");
          const auto status = std::isnan(slides[k]) ? discrete::ContactStatus::unknown
                              : slides[k] != 0      ? discrete::ContactStatus::slipping
                                                    : discrete::ContactStatus::sticking;
          to.contacts.push_back(
            {long(first[k]), long(second[k]), int(wall[k]), force[k], point[k], overlap[k], status, int(line[k])});
        }
    }

    coupling::ForeignWall wall_of(const py::handle &from)
    {
      coupling::ForeignWall wall;
      wall.name   = from.attr("name").cast<std::string>();
      wall.place  = from.attr("place").cast<double>();
      wall.travel = from.attr("travel").cast<double>();
      wall.force  = {from.attr("force").cast<std::array<double, 2>>()[0], from.attr("force").cast<std::array<double, 2>>()[1]};
      if (from.attr("side").is_none())
        return wall;
      const auto side = from.attr("side").cast<std::string>();
      for (const int k : {0, 1, 2, 3})
        if (side == coupling::side_names[k])
          wall.side = coupling::Side(k);
      if (!wall.side)
        throw std::invalid_argument(wall.name + ": side = '" + side + "'; allowed: lower, upper, left, right or None");
      return wall;
    }

    coupling::ForeignFrame frame_of(const py::handle &from)
    {
      coupling::ForeignFrame frame;
      frame.name         = from.attr("name").cast<std::string>();
      frame.grain_file   = from.attr("grain_file").cast<std::string>();
      frame.contact_file = from.attr("contact_file").cast<std::string>();
      frame.wall_file    = from.attr("wall_file").cast<std::string>();
      frame.time         = from.attr("time").cast<std::optional<double>>();
      frame.step         = from.attr("step").cast<std::optional<long>>();
      if (const auto gravity = from.attr("gravity").cast<std::optional<std::array<double, 2>>>())
        frame.gravity = {(*gravity)[0], (*gravity)[1]};
      for (const py::handle &wall : from.attr("walls"))
        frame.walls.push_back(wall_of(wall));
      take_grains(from.attr("grains"), frame);
      if (!from.attr("contacts").is_none())
        take_contacts(from.attr("contacts"), frame);
      return frame;
    }

    coupling::ForeignSample sample_of(const std::string &format, const py::list &frames, const std::vector<std::string> &remarks)
    {
      coupling::ForeignSample sample;
      sample.format  = format;
      sample.remarks = remarks;
      for (const py::handle &frame : frames)
        {
          sample.frames.push_back(frame_of(frame));
          sample.is_spheres |= frame.attr("spheres").cast<bool>();
          for (const auto &text : frame.attr("lacking").cast<std::vector<std::string>>())
            if (std::find(sample.lacking.begin(), sample.lacking.end(), text) == sample.lacking.end())
              sample.lacking.push_back(text);
        }
      return sample;
    }

    coupling::ForeignOptions foreign_options(const py::object &from)
    {
      using Number = std::optional<double>;
      coupling::ForeignOptions options;
      options.files         = from.attr("files").cast<std::vector<std::string>>();
      options.thickness     = from.attr("thickness").cast<Number>();
      options.density       = from.attr("density").cast<Number>();
      options.pressure      = from.attr("pressure").cast<Number>();
      options.mean_diameter = from.attr("mean_diameter").cast<Number>();
      options.walls_touch   = from.attr("walls_touch").cast<bool>();
      if (const auto gravity = from.attr("gravity").cast<std::optional<std::array<double, 2>>>())
        options.gravity = Eigen::Vector2d((*gravity)[0], (*gravity)[1]);
      return options;
    }

    std::string check_frames(const std::string              &format,
                             const py::list                 &frames,
                             const std::vector<std::string> &remarks,
                             const py::object               &options)
    {
      const coupling::ForeignOptions given   = foreign_options(options);
      const coupling::Arrival        arrival = coupling::arrive(sample_of(format, frames, remarks), given);
      (void)coupling::imported_results(arrival);
      return coupling::import_record(given, arrival);
    }

    // options.output, .overwrite, .quiet and .command give the folder, and how to write to it.
    void import_frames(const std::string              &format,
                       const py::list                 &frames,
                       const std::vector<std::string> &remarks,
                       const py::object               &options)
    {
      coupling::RunOptions run;
      run.overwrite = options.attr("overwrite").cast<bool>();
      run.quiet     = options.attr("quiet").cast<bool>();
      run.text      = options.attr("command").cast<std::string>();
      coupling::import_frames(sample_of(format, frames, remarks), foreign_options(options),
                              options.attr("output").cast<std::string>(), run);
    }
  } // namespace

  void bind_import(py::module_ &m)
  {
    m.def("check_frames", &check_frames);
    m.def("import_frames", &import_frames);
  }
} // namespace diptych::python
