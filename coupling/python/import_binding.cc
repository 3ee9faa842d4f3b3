// diptych: Python binding of imported frames: snapshots and rows from arrays
// SPDX-License-Identifier: LGPL-2.1-or-later
#include <algorithm>
#include <cmath>
#include <memory>
#include <string>
#include <vector>

#include <nlohmann/json.hpp>
#include <pybind11/stl.h>

#include "coupling/numbers/number_json.h"
#include "coupling/python/arrays.h"
#include "coupling/python/bindings.h"
#include "coupling/python/panel_results.h"
#include "coupling/store/provenance.h"
#include "discrete/bodies/outline.h"
#include "discrete/contacts/internal_moment.h"
#include "discrete/snapshot_fields.h"

namespace diptych::python
{
  namespace
  {
    using discrete::Snapshot;

    // Takes the values of that name, if the dict has them. Whole rows are copied as they lie in memory.
    template <class Number, class Value> void take_array(const py::dict &from, const std::string &name, std::vector<Value> &to)
    {
      if (!from.contains(name.c_str()))
        return;
      const auto array = from[name.c_str()].cast<py::array_t<Number, py::array::c_style | py::array::forcecast>>();
      to.resize(std::size_t(array.size()) * sizeof(Number) / sizeof(Value));
      std::copy_n(array.data(), array.size(), reinterpret_cast<Number *>(to.data()));
    }

    template <class Value> void take_value(const py::dict &from, const char *name, Value &to)
    {
      if (!from.contains(name))
        return;
      if constexpr (std::is_enum_v<Value>)
        to = discrete::value_of<Value>(from[name].cast<std::string>()).value();
      else
        to = from[name].cast<Value>();
    }

    std::vector<discrete::ContactForce> contact_list(const py::dict &from)
    {
      std::vector<int>             i, j;
      std::vector<Eigen::Vector2d> point, normal, force, shift;
      std::vector<double>          couple;
      take_array<int>(from, "i", i);
      take_array<int>(from, "j", j);
      take_array<double>(from, "point", point);
      take_array<double>(from, "normal", normal);
      take_array<double>(from, "force", force);
      take_array<double>(from, "shift", shift);
      take_array<double>(from, "couple", couple);
      std::vector<discrete::ContactForce> contacts;
      for (std::size_t k = 0; k < i.size(); ++k)
        contacts.push_back({i[k], j[k], point[k], normal[k], force[k], shift[k].x(), couple[k], shift[k].y()});
      return contacts;
    }

    // Outline and internal moments, which follow from the arrays. The forces of one instant count for the whole stage.
    void complete(Snapshot &s, const bool has_contacts)
    {
      discrete::State state;
      state.grains.position = s.position;
      state.grains.radius   = s.radius;
      if (s.cell_vectors(1, 1) != 0)
        state.periodicity = discrete::Lattice{s.cell_vectors};
      else if (s.cell_width > 0)
        state.periodicity = discrete::PeriodicWidth{s.cell_width};
      state.walls.resize(std::isfinite(s.left_x) && std::isfinite(s.right_x) ? 4 : 2);
      state.walls[0].point = {0, s.lower_y};
      state.walls[1].point = {0, s.upper_y};
      if (state.walls.size() == 4)
        {
          state.walls[2].point = {s.left_x, 0};
          state.walls[3].point = {s.right_x, 0};
        }
      s.outline = discrete::make_outline(state, s.mean_diameter);
      s.area    = discrete::outline_area(s.outline);
      if (state.lattice())
        {
          s.lower_y = s.outline.left.front().y();
          s.upper_y = s.outline.right.back().y();
        }
      s.window_forces   = s.contacts;
      s.internal_moment = discrete::internal_moments(s.position, s.contacts, s.mean_spin_term);
      if (!has_contacts)
        s.internal_moment.assign(s.position.size(), Eigen::Matrix2d::Constant(NAN));
      s.mean_internal_moment = s.internal_moment;
    }

    // grains: arrays with the names of grains/ in discrete.h5; contacts: i, j, point, normal, force, gap, status, or None if they
    // are unknown; setting: attributes of the stage. nan: unknown.
    std::shared_ptr<Snapshot> snapshot_of(const py::dict &grains, const py::object &contacts, const py::dict &setting)
    {
      auto       s    = std::make_shared<Snapshot>();
      const auto name = [](const std::string &path) { return path.substr(path.find('/') + 1); };
      discrete::visit_grain_fields(*s, [&](const std::string &path, auto &values, const char *, const char *) {
        using Value = typename std::decay_t<decltype(values)>::value_type;
        take_array<typename Layout<Value>::Number>(grains, name(path), values);
      });
      discrete::visit_attributes(
        *s, [&](const char *key, auto &value, const char *, const char *) { take_value(setting, key, value); });
      if (!contacts.is_none())
        {
          const auto given = contacts.cast<py::dict>();
          s->contacts      = contact_list(given);
          take_array<double>(given, "gap", s->gap);
          take_array<std::uint8_t>(given, "status", s->status);
        }
      complete(*s, !contacts.is_none());
      return s;
    }

    // rows: dicts with the columns of discrete.csv
    GrainResults results_of(const GrainSnapshots &snapshots, const std::vector<py::dict> &rows)
    {
      GrainResults results{{}, snapshots};
      for (const py::dict &row : rows)
        visit_columns(results.rows.emplace_back(),
                      [&](const char *name, auto &value, const char *, const char *) { take_value(row, name, value); });
      return results;
    }

    // facts: JSON with the names of `discrete` in provenance.json
    void record_grains(const std::string &directory, const std::string &facts)
    {
      const nlohmann::json      json  = nlohmann::json::parse(facts);
      discrete::Report          taken = coupling::unknown_report<discrete::Report>();
      coupling::NumbersFromJson reader{json};
      list_numbers(taken, reader);
      coupling::record_facts(directory, taken);
    }
  } // namespace

  void bind_import(py::module_ &m)
  {
    m.def("grain_snapshot", &snapshot_of);
    m.def("grain_results", &results_of);
    m.def("record_grains", &record_grains);
  }
} // namespace diptych::python
