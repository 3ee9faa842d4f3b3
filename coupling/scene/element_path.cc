// diptych: path of an element test, for the law's point and for a cell of grains
// SPDX-License-Identifier: LGPL-2.1-or-later
#include "coupling/scene/element_path.h"

#include "coupling/scene/scene_error.h"
#include "discrete/files/csv_file.h"
#include "discrete/files/words.h"
#include "discrete/files/wrong_keys.h"

namespace diptych::coupling
{
  continuum::PointPath named_path_of(const continuum::NamedPath name, const continuum::PathSize &size)
  {
    try
      {
        return continuum::named_path(name, size);
      }
    catch (const std::invalid_argument &error)
      {
        throw discrete::WrongKeys({"loading/axial_strain", "loading/path", "loading/pressure", "continuum/initial_step"},
                                  error.what());
      }
  }

  bool PathOption::names_a_file() const
  {
    return !continuum::value_of<continuum::NamedPath>(text);
  }

  continuum::PointPath read_path_table(const std::string &file, const double pressure, const double k0)
  {
    std::vector<std::string> controls;
    for (const auto &choice : choices(continuum::Control()))
      controls.emplace_back(choice.second);
    discrete::CsvHeader header{{}, controls};
    header.optional.push_back("progress");
    const discrete::CsvTable table = discrete::read_csv(file, header);
    continuum::PointPath     path  = continuum::PointPath::from(pressure, k0);
    std::vector<std::size_t> places;
    for (std::size_t c = 0; c < table.columns.size(); ++c)
      if (const auto control = continuum::value_of<continuum::Control>(table.columns[c]))
        {
          if (places.size() < 3)
            path.controls[places.size()] = *control;
          places.push_back(c);
        }
    const std::string first = file + ", header line: ";
    if (table.rows.size() < 2)
      throw SceneError(file + ": the path has one row, the start; it needs at least two");
    if (places.size() != 3)
      throw SceneError(first + std::to_string(places.size()) + " of the columns prescribe strain or stress; give three of " +
                       discrete::listed(controls) + ", for example eyy, sxx, exy");
    const auto progress = table.find("progress");
    for (const std::vector<double> &row : table.rows)
      {
        path.values.emplace_back(row[places[0]], row[places[1]], row[places[2]]);
        if (progress)
          path.progress.push_back(row[*progress]);
      }
    try
      {
        continuum::validate(path);
      }
    catch (const continuum::WrongPath &wrong)
      {
        const bool is_header = wrong.row == continuum::WrongPath::header;
        throw SceneError((is_header ? first : text_of(Place(file, table.line[wrong.row])) + ": ") + wrong.what());
      }
    const Eigen::Vector3d start = path.values[0];
    for (Eigen::Vector3d &row : path.values) // strains count from the first row
      for (int k = 0; k < 3; ++k)
        row[k] -= is_stress(path.controls[k]) ? 0 : start[k];
    return path;
  }

  discrete::CellPath cell_path(const PathOption &option, const continuum::PathSize &size)
  {
    const auto                 name  = continuum::value_of<continuum::NamedPath>(option.text);
    const continuum::PointPath point = name ? named_path_of(*name, size) : read_path_table(option.text, size.pressure);
    discrete::CellPath         path;
    for (int k = 0; k < 3; ++k)
      {
        path.form.row(k)  = continuum::form_of(point.controls[k]);
        path.is_stress[k] = continuum::is_stress(point.controls[k]);
      }
    path.values = point.values;
    for (std::size_t row = 0; row < path.values.size(); ++row)
      path.progress.push_back(point.progress_at(row));
    return path;
  }
} // namespace diptych::coupling
