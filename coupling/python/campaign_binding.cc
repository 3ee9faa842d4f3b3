// diptych: Python binding for campaigns of many runs: scenes with places, result folders, stop signals
// SPDX-License-Identifier: LGPL-2.1-or-later
#include <optional>
#include <string>
#include <tuple>
#include <vector>

#include <pybind11/stl.h>

#include "continuum/history.h"
#include "continuum/laws/material_point_row.h"
#include "coupling/comparison/comparison_schema.h"
#include "coupling/processes/stop_signal.h"
#include "coupling/python/bindings.h"
#include "coupling/scene/identity.h"
#include "coupling/scene/json_text.h"
#include "coupling/scene/keys.h"
#include "coupling/scene/scene_file.h"
#include "coupling/store/folder_lock.h"
#include "coupling/store/provenance.h"
#include "coupling/store/result_folder.h"
#include "discrete/files/nearest_name.h"
#include "discrete/panel/history.h"

namespace diptych::python
{
  namespace py = pybind11;

  namespace
  {
    using namespace coupling;
    using PlacedEntry = std::tuple<std::string, std::string, std::string, std::string, int, std::string>;

    // section, key, value, file, line, folder of the files that the value names
    PlacedEntry placed(const Entry &e)
    {
      return {e.section, e.key, e.value, e.place.file, e.place.line, e.folder};
    }

    Entry entry_of(const PlacedEntry &e)
    {
      const auto &[section, key, value, file, line, folder] = e;
      return {section, key, value, {file, line}, folder};
    }

    std::vector<Entry> entries_of(const std::vector<PlacedEntry> &placed_entries)
    {
      std::vector<Entry> entries;
      for (const PlacedEntry &e : placed_entries)
        entries.push_back(entry_of(e));
      return entries;
    }

    // The text as JSON without comments, and the line of each member by its JSON pointer.
    py::tuple read_json(const std::string &file)
    {
      std::istringstream in   = scene_input(file);
      const JsonText     text = read_json_text(file, in);
      return py::make_tuple(text.root.dump(), text.lines);
    }

    // name -> unit of the numeric columns
    template <class Row> py::dict numeric_columns()
    {
      py::dict  columns;
      const Row row;
      visit_columns(row, [&](const char *name, const auto &value, const char *unit, const char *) {
        if constexpr (std::is_arithmetic_v<std::decay_t<decltype(value)>>)
          columns[name] = unit;
      });
      return columns;
    }

    // A lock that Python gives back at a known moment.
    struct Lock
    {
      std::optional<FolderLock> lock;
    };

    void bind_scenes(py::module_ &m)
    {
      m.def("read_changed_scene", [](const std::string &file, const std::vector<PlacedEntry> &entries, const bool compares) {
        return read_changed_scene(file, entries_of(entries), compares);
      });
      m.def("read_computed_scene", &read_computed_scene, py::arg("file"), py::arg("overrides"), py::arg("compares") = true);
      m.def("resolved_scene", &resolved_scene);
      m.def("entry_of_override", [](const std::string &text) { return placed(entry_of_override(text)); });
      m.def("read_fragment", [](const std::string &file) {
        std::vector<PlacedEntry> entries;
        for (const Entry &entry : read_fragment(file))
          entries.push_back(placed(entry));
        return entries;
      });
      m.def("check_entry", [](const PlacedEntry &entry) { check_entry(entry_of(entry)); });
      m.def("read_json", &read_json);
      m.def("nearest_name", &discrete::nearest_name);
      m.def("text_of_number", [](const double value) { return text_of(value); });
      m.def("digest", [](const std::string &text) { return hexadecimal(digest_of(text)); });
      m.def("numeric_columns", [] {
        return py::dict(py::arg("discrete")       = numeric_columns<discrete::HistoryRow>(),
                        py::arg("continuum")      = numeric_columns<continuum::HistoryRow>(),
                        py::arg("material_point") = numeric_columns<continuum::MaterialPointRow>());
      });
      // place -> (unit, kind) of the numbers of comparison.json
      m.def("comparison_numbers", [] {
        py::dict numbers;
        for (const NumberDescription &number : comparison_schema())
          numbers[py::str(number.place)] = py::make_tuple(number.unit, discrete::name_of(number.kind));
        return numbers;
      });
    }

    void bind_folders(py::module_ &m)
    {
      py::class_<Lock>(m, "FolderLock")
        .def(py::init([](const std::string &directory) {
          auto made = std::make_unique<Lock>();
          made->lock.emplace(directory);
          return made;
        }))
        .def_property_readonly("descriptor", [](const Lock &lock) { return lock.lock->number(); })
        .def("set_aside", [](Lock &lock, const InputFiles &inputs) { set_aside(*lock.lock, inputs); })
        .def("release", [](Lock &lock) { lock.lock.reset(); });
      m.def("is_empty_folder", &is_empty_folder);
      m.def(
        "require_usable",
        [](const std::string &directory, const bool resume, const bool overwrite, const bool can_resume) {
          Opening opening;
          opening.resume     = resume;
          opening.overwrite  = overwrite;
          opening.can_resume = can_resume;
          require_usable(directory, opening);
        },
        py::arg("directory"), py::arg("resume"), py::arg("overwrite"), py::arg("can_resume") = true);
      m.def("kept_in", &kept_in);
      m.def("require_unlocked", &require_unlocked);
      // the keys by which the scene differs from that of the folder: (sample, continuum, comparison)
      m.def("changes_since", [](const Scene &scene) {
        const SceneChanges changes = ResultFolder(scene).changes();
        return py::make_tuple(changes.sample, changes.continuum, changes.comparison);
      });
      m.def("check_part", &check_files);
      m.def("record_files", &record_files);
      m.def("forget_files", &forget_files);
      m.def("copy_record", &copy_record);
      m.def("forget_fact", &forget_fact);
      m.def("recorded_scene", &recorded_scene);
      // (scene's name, seeds, command) and (phase, wall s, CPU s, peak memory MB)
      m.def("record_phase", [](const std::string &directory, const std::tuple<std::string, std::vector<int>, std::string> &origin,
                               const std::tuple<std::string, double, double, double> &phase) {
        const auto &[scene, seeds, command]               = origin;
        const auto &[name, wall_s, cpu_s, peak_memory_mb] = phase;
        record_phases(directory, {scene, seeds, command}, {{name, wall_s, cpu_s, peak_memory_mb}});
      });
    }
  } // namespace

  void bind_campaigns(py::module_ &m)
  {
    bind_scenes(m);
    bind_folders(m);
    py::class_<TakenSignals>(m, "TakenSignals").def(py::init<>()); // they are given back when it is deleted
    m.def("install_signals", &install_signals);
    m.def("stop_requested", &stop_requested);
  }
} // namespace diptych::python
