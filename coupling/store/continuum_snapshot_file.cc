// diptych: result files of the continuum panel
// SPDX-License-Identifier: LGPL-2.1-or-later
#include "coupling/store/continuum_snapshot_file.h"

#include <filesystem>

#include "continuum/laws/options.h"
#include "continuum/snapshot_fields.h"
#include "discrete/files/field_arrays.h"

namespace diptych::coupling
{
  namespace
  {
    using continuum::CellState;
    using continuum::Snapshot;
    using discrete::ArrayCheck;
    using discrete::Hdf5Reader;
    using discrete::Hdf5Writer;

    const auto cell_fields = [](auto &cell, auto &&visit) { continuum::visit_cell_fields(cell, visit); };

    // Calls action(name, values, unit, meaning, of_cells) for every array but that of the nodes of the cells.
    template <class Action> void for_each_array(const Snapshot &s, Action &&action)
    {
      continuum::visit_node_fields(s, [&](const std::string &name, const auto &values, const char *unit, const char *meaning) {
        if (name != "nodes/rotation" || !values.empty())
          action(name, values, unit, meaning, false);
      });
      discrete::for_each_column(s.cell_state, cell_fields,
                                [&](const std::string &name, const auto &values, const char *unit, const char *meaning) {
                                  action(name, values, unit, meaning, true);
                                });
      for (const continuum::LawVariable &variable : s.variables)
        action("cells/" + variable.name, variable.of_cells, variable.unit.c_str(), variable.meaning.c_str(), true);
    }

    void check_lengths(const Snapshot &s)
    {
      if (s.cell_state.size() != s.cells.size())
        throw std::invalid_argument("snapshot: " + std::to_string(s.cell_state.size()) + " cell states for " +
                                    std::to_string(s.cells.size()) + " cells");
      continuum::visit_node_fields(s, [&](const std::string &name, const auto &values, const char *, const char *) {
        if (values.size() != s.position.size() && (name != "nodes/rotation" || !values.empty()))
          throw std::invalid_argument("snapshot: " + name + " holds " + std::to_string(values.size()) + " values for " +
                                      std::to_string(s.position.size()) + " nodes");
      });
    }

    std::vector<unsigned int> node_list(const Snapshot &s)
    {
      std::vector<unsigned int> nodes;
      for (const auto &cell : s.cells)
        nodes.insert(nodes.end(), cell.begin(), cell.end());
      return nodes;
    }

    void write_stage(Hdf5Writer &file, const std::string &group, const Snapshot &s)
    {
      const std::vector<unsigned int> nodes = node_list(s);
      const std::string               cells = group + "/" + continuum::cells_name;
      file.write(cells, std::vector<int>(nodes.begin(), nodes.end()), {s.cells.size(), 9});
      file.attribute(cells, "unit", "-");
      file.attribute(cells, "meaning", continuum::cells_meaning);
      for_each_array(s, [&](const std::string &name, const auto &values, const char *unit, const char *meaning, bool) {
        discrete::write_field(file, group + "/" + name, values, unit, meaning);
      });
      continuum::visit_attributes(s, [&](const char *name, const auto &value, const char *, const char *) {
        using Value = std::decay_t<decltype(value)>;
        if constexpr (std::is_same_v<Value, double>)
          file.attribute(group, name, value);
        else if constexpr (std::is_enum_v<Value>)
          file.attribute(group, name, name_of(value));
        else
          file.attribute(group, name, discrete::flat(std::vector<Value>{value}));
      });
    }

    void read_cells(const Hdf5Reader &file, const std::string &group, const ArrayCheck &check, Snapshot &s)
    {
      const std::vector<int> nodes = file.read_int(group + "/" + continuum::cells_name);
      if (nodes.size() % 9 != 0)
        check.refuse(continuum::cells_name, "does not hold nine nodes a cell");
      s.cells.resize(nodes.size() / 9);
      for (std::size_t k = 0; k < nodes.size(); ++k)
        {
          if (nodes[k] < 0 || std::size_t(nodes[k]) >= s.position.size())
            check.refuse(continuum::cells_name, "names a node that does not exist, in row " + std::to_string(k / 9));
          s.cells[k / 9][k % 9] = unsigned(nodes[k]);
        }
    }

    void read_attributes(const Hdf5Reader &file, const std::string &group, const ArrayCheck &check, Snapshot &s)
    {
      continuum::visit_attributes(s, [&](const char *name, auto &value, const char *, const char *) {
        using Value = std::decay_t<decltype(value)>;
        if constexpr (std::is_same_v<Value, double>)
          value = file.attribute(group, name);
        else if constexpr (std::is_enum_v<Value>)
          {
            const auto known = continuum::value_of<Value>(file.text_attribute(group, name));
            if (!known)
              check.refuse(name, "is none of the names it may have");
            value = *known;
          }
        else
          {
            const std::vector<double> numbers = file.attributes(group, name);
            check.size(name, numbers.size(), discrete::n_components<Value>);
            const double *next = numbers.data();
            discrete::take(next, value);
          }
      });
    }

    // Variables of a law from a library: cells/law.NAME.
    void read_variables(const Hdf5Reader &file, const std::string &group, const ArrayCheck &check, Snapshot &s)
    {
      for (const std::string &name : file.members(group + "/cells"))
        if (name.rfind(continuum::LawParameters::prefix, 0) == 0)
          {
            const std::string path = group + "/cells/" + name;
            s.variables.push_back(
              {name, file.text_attribute(path, "unit"), file.text_attribute(path, "meaning"), file.read(path)});
            check.size(name, s.variables.back().of_cells.size(), s.cells.size());
            check.finite(name, s.variables.back().of_cells);
          }
    }

    Snapshot read_stage(const Hdf5Reader &file, const std::string &group)
    {
      const ArrayCheck check{file.path() + ": " + group};
      Snapshot         s;
      read_attributes(file, group, check, s);
      const bool rotates = file.has(group + "/nodes/rotation");
      continuum::visit_node_fields(s, [&](const std::string &name, auto &values, const char *, const char *) {
        if (name == "nodes/rotation" && !rotates)
          return;
        values = discrete::read_field<typename std::decay_t<decltype(values)>::value_type>(file, group + "/" + name);
        check.size(name, values.size(), s.position.size());
        check.finite(name, values);
      });
      read_cells(file, group, check, s);
      s.cell_state.resize(s.cells.size());
      discrete::set_columns(s.cell_state, cell_fields, [&](const std::string &name, auto &values) {
        using Value = typename std::decay_t<decltype(values)>::value_type;
        values      = discrete::read_field<Value>(file, group + "/" + name);
        check.size(name, values.size(), s.cells.size());
        check.finite(name, values);
      });
      read_variables(file, group, check, s);
      return s;
    }

    discrete::VtuGrid vtu_of(const Snapshot &s)
    {
      discrete::VtuGrid grid{s.position, node_list(s), discrete::VtkCell::biquadratic_quadrilateral, {}};
      for_each_array(s, [&](const std::string &name, const auto &values, const char *, const char *, const bool of_cells) {
        using Value = typename std::decay_t<decltype(values)>::value_type;
        if (name != "nodes/position")
          grid.fields.push_back(
            {name.substr(name.find('/') + 1), unsigned(discrete::n_components<Value>), discrete::flat(values), !of_cells});
      });
      return grid;
    }
  } // namespace

  ContinuumSnapshotFile::ContinuumSnapshotFile(const std::string &path)
      : stages(path),
        views(path)
  {}

  ContinuumSnapshotFile::ContinuumSnapshotFile(const std::string &path, const std::size_t kept)
      : stages(path, kept),
        views(path, discrete::progress_of_stages(path + ".h5", kept))
  {}

  void ContinuumSnapshotFile::add(const Snapshot &snapshot)
  {
    check_lengths(snapshot);
    stages.add([&](Hdf5Writer &file, const std::string &group) { write_stage(file, group, snapshot); });
    views.add(snapshot.progress, vtu_of(snapshot));
  }

  void ContinuumSnapshotFile::close()
  {
    stages.close();
  }

  std::vector<Snapshot> read_continuum_snapshots(const std::string &h5_path)
  {
    const Hdf5Reader      file(h5_path, Hdf5Reader::From::this_program);
    const std::size_t     n = discrete::count_stages(file);
    std::vector<Snapshot> snapshots;
    for (std::size_t k = 0; k < n; ++k)
      snapshots.push_back(read_stage(file, discrete::stage_name(k)));
    return snapshots;
  }

  std::size_t count_continuum_snapshots(const std::string &h5_path)
  {
    return std::filesystem::exists(h5_path) ? discrete::count_stages(Hdf5Reader(h5_path)) : 0;
  }
} // namespace diptych::coupling
