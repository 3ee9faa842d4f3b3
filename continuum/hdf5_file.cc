// diptych: the stages of the continuum panel in HDF5
// SPDX-License-Identifier: LGPL-2.1-or-later
#include <algorithm>

#include "continuum/hdf5_access.h"
#include "continuum/hdf5_fields.h"
#include "continuum/output.h"

namespace diptych::continuum
{
  namespace
  {
    using hdf5::Id;

    // Calls visitor(name, value) for all that a snapshot holds besides its fields and cells.
    template <class AnySnapshot, class Visitor> void visit_attributes(AnySnapshot &s, Visitor &&visitor)
    {
      visitor("axial_strain", s.axial_strain);
      visitor("time", s.time);
      visitor("area", s.area);
      visitor("lower_platen_force", s.lower_platen_force);
      visitor("upper_platen_force", s.upper_platen_force);
      visitor("mean_stress", s.mean_stress);
    }

    void write_field(const hid_t group, const Snapshot &s, const Field &field)
    {
      const auto shape = extents(field, of_nodes(field) ? s.position.size() : s.cells.size());
      hdf5::write(group, path_of(field), {shape.begin(), shape.end()}, values_of(s, field));
    }

    void write_cells(const hid_t group, const std::vector<std::array<unsigned int, 9>> &cells)
    {
      std::vector<unsigned int> nodes;
      for (const auto &cell : cells)
        nodes.insert(nodes.end(), cell.begin(), cell.end());
      hdf5::write(group, "cells/nodes", {cells.size(), 9}, nodes);
    }

    void write_stage(const hid_t group, const Snapshot &s)
    {
      visit_attributes(s, [&](const char *name, const auto &value) {
        std::vector<double> values;
        append(values, value);
        hdf5::write_attribute(group, name, values);
      });
      write_cells(group, s.cells);
      write_field(group, s, position_field);
      for (const Field &field : fields)
        if (is_carried(field, !s.rotation.empty()))
          write_field(group, s, field);
    }

    std::size_t n_bytes(const Snapshot &s)
    {
      std::size_t n = s.cells.size() * sizeof(s.cells[0]) + s.position.size() * 3 * sizeof(double);
      for (const Field &field : fields)
        n += (of_nodes(field) ? s.position.size() : s.cells.size()) * n_components(field) * sizeof(double);
      return n;
    }

    StageSummary read_summary(const hid_t group)
    {
      StageSummary summary;
      summary.axial_strain = hdf5::read_attribute(group, "axial_strain").at(0);
      summary.n_cells      = hdf5::extents_of(group, "cells/nodes").at(0);
      summary.n_nodes      = hdf5::extents_of(group, path_of(position_field)).at(0);
      summary.has_rotation = hdf5::exists(group, "nodes/rotation");
      return summary;
    }

    void read_field(const hid_t group, Snapshot &s, const Field &field)
    {
      const std::size_t         n      = of_nodes(field) ? s.position.size() : s.cells.size();
      const std::vector<double> values = hdf5::read<double>(group, path_of(field));
      if (values.size() != n * n_components(field))
        throw std::runtime_error(path_of(field) + " does not hold " + std::to_string(n_components(field)) +
                                 " values for each of " + std::to_string(n));
      if (const auto scalars = std::get_if<std::vector<double> Snapshot::*>(&field.member))
        (s.**scalars).resize(n);
      if (const auto vectors = std::get_if<std::vector<Eigen::Vector2d> Snapshot::*>(&field.member))
        (s.**vectors).resize(n);
      const double *next = values.data();
      for_each_item(s, field, [&](auto &item) { next = take(next, item); });
    }

    void read_cells(const hid_t group, Snapshot &s)
    {
      const auto nodes = hdf5::read<unsigned int>(group, "cells/nodes");
      if (nodes.size() != 9 * s.cells.size())
        throw std::runtime_error("cells/nodes does not hold nine nodes a cell");
      for (std::size_t c = 0; c < s.cells.size(); ++c)
        std::copy_n(nodes.begin() + 9 * c, 9, s.cells[c].begin());
      if (std::any_of(nodes.begin(), nodes.end(), [&](const unsigned int node) { return node >= s.position.size(); }))
        throw std::runtime_error("cells/nodes names a node that does not exist");
    }

    Snapshot read_stage(const hid_t group)
    {
      Snapshot           s;
      const StageSummary summary = read_summary(group);
      visit_attributes(s, [&](const char *name, auto &value) {
        std::vector<double> expected;
        append(expected, value);
        const std::vector<double> values = hdf5::read_attribute(group, name);
        if (values.size() != expected.size())
          throw std::runtime_error("attribute " + std::string(name) + " has another size");
        take(values.data(), value);
      });
      s.position.resize(summary.n_nodes);
      s.cells.resize(summary.n_cells);
      s.cell_state.resize(summary.n_cells);
      read_cells(group, s);
      read_field(group, s, position_field);
      for (const Field &field : fields)
        if (is_carried(field, summary.has_rotation))
          read_field(group, s, field);
      return s;
    }

    // Returns action(group) for one stage; errors name the stage.
    template <class Action> auto in_stage(const hid_t file, const unsigned int stage, Action &&action)
    {
      const std::string name = stage_name(stage);
      try
        {
          const Id group(H5Gopen2(file, name.c_str(), H5P_DEFAULT), H5Gclose, "the group");
          return action(hid_t(group));
        }
      catch (const std::exception &error)
        {
          throw std::runtime_error(name + ": " + error.what());
        }
    }

    unsigned int count_stages(const hid_t file)
    {
      unsigned int n = 0;
      while (hdf5::exists(file, stage_name(n)))
        ++n;
      if (n == 0)
        throw std::runtime_error("holds no " + stage_name(0) + ": no result of the continuum panel");
      return n;
    }

    template <class Action> auto for_all_stages(const std::string &h5_file, Action &&action)
    {
      return hdf5::read_file(h5_file, [&](const hid_t file) {
        std::vector<std::invoke_result_t<Action, hid_t>> results;
        const unsigned int                               n = count_stages(file);
        for (unsigned int stage = 0; stage < n; ++stage)
          results.push_back(in_stage(file, stage, action));
        return results;
      });
    }
  } // namespace

  void append_to_hdf5(const std::string &h5_file, const Snapshot &snapshot, const unsigned int stage)
  {
    require_equal_lengths(snapshot);
    const auto start = stage > 0 ? hdf5::Start::with_old_contents : hdf5::Start::empty;
    hdf5::write_file(h5_file, start, hdf5::room_for(n_bytes(snapshot)), [&](const hid_t file) {
      const auto name = stage_name(stage);
      const Id   group(H5Gcreate2(file, name.c_str(), H5P_DEFAULT, H5P_DEFAULT, H5P_DEFAULT), H5Gclose, name);
      write_stage(group, snapshot);
    });
  }

  std::vector<Snapshot> read_snapshots(const std::string &h5_file)
  {
    return for_all_stages(h5_file, read_stage);
  }

  std::vector<StageSummary> read_stage_summaries(const std::string &h5_file)
  {
    return for_all_stages(h5_file, read_summary);
  }

  Snapshot read_snapshot(const std::string &h5_file, const unsigned int stage)
  {
    return hdf5::read_file(h5_file, [&](const hid_t file) { return in_stage(file, stage, read_stage); });
  }

  void keep_stages(const std::string &h5_file, const std::vector<unsigned int> &kept)
  {
    if (kept.empty())
      {
        std::filesystem::remove(h5_file);
        return;
      }
    hdf5::read_file(h5_file, [&](const hid_t from) {
      const std::size_t room = hdf5::room_for(std::filesystem::file_size(h5_file));
      hdf5::write_file(h5_file, hdf5::Start::empty, room, [&](const hid_t to) {
        for (unsigned int k = 0; k < kept.size(); ++k)
          {
            const std::string name = stage_name(kept[k]);
            hdf5::require(H5Ocopy(from, name.c_str(), to, stage_name(k).c_str(), H5P_DEFAULT, H5P_DEFAULT) >= 0, "copy " + name);
          }
      });
    });
  }
} // namespace diptych::continuum
