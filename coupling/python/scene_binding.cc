// diptych: Python binding of scenes
// SPDX-License-Identifier: LGPL-2.1-or-later
#include <filesystem>
#include <optional>
#include <string>
#include <tuple>
#include <vector>

#include <pybind11/stl.h>

#include "coupling/program/command_examples.h"
#include "coupling/program/python_commands.h"
#include "coupling/python/bindings.h"
#include "coupling/scene/derived_keys.h"
#include "coupling/scene/identity.h"
#include "coupling/scene/path_warning.h"
#include "coupling/scene/scene_file.h"
#include "coupling/version.h"

namespace diptych::python
{
  namespace py = pybind11;

  namespace
  {
    using Change = std::tuple<std::string, std::string, std::string>; // section, key, value as in a file

    // A value as a Python object; words such as auto, choices and file names stay texts.
    struct ValueOfKey
    {
      py::dict &keys;

      template <class Number>
      void operator()(const char *name, const Number &value, const char *, coupling::Range, const char *) const
      {
        if constexpr (std::is_same_v<Number, std::optional<double>>)
          keys[name] = value ? py::object(py::float_(*value)) : py::object(py::str("auto"));
        else
          keys[name] = py::cast(value);
      }
      void operator()(const char *prefix, const continuum::LawParameters &parameters, const char *, const char *) const
      {
        for (const continuum::LawParameter &one : parameters.list)
          keys[py::str(prefix + one.name)] = one.value;
      }
      void operator()(const char *name, const bool value, const char *, const char *) const { keys[name] = value; }
      template <class Value> void operator()(const char *name, const Value &value, const char *, const char *) const
      {
        using coupling::text_of; // or the overload in the namespace of the value
        keys[name] = text_of(value);
      }
    };

    coupling::Scene read(const std::optional<std::string> &file, const std::vector<Change> &changes, const bool compares)
    {
      std::vector<coupling::Entry> entries;
      for (const auto &[section, key, value] : changes)
        {
          coupling::Entry entry;
          entry.section     = section;
          entry.key         = key;
          entry.value       = value;
          entry.place       = "scene";
          entry.folder      = std::filesystem::current_path().string();
          entry.of_resolved = true; // keys without effect give no warning
          entries.push_back(entry);
        }
      return file ? coupling::read_changed_scene(*file, entries, compares)
                  : coupling::scene_of_entries("scene", entries, compares);
    }

    py::dict scene_dict(const coupling::Scene &scene)
    {
      py::dict        sections;
      coupling::Scene copy = scene;
      coupling::for_each_section(copy, [&](const char *section, auto &options) {
        py::dict keys;
        visit_parameters(options, ValueOfKey{keys});
        sections[section] = keys;
      });
      return sections;
    }

    // Typed values by section/key: of the sample, the continuum or the members of an ensemble.
    coupling::Identity identity_of(const coupling::Scene &scene, const std::string &of)
    {
      return of == "sample" ? sample_identity(scene) : of == "continuum" ? continuum_identity(scene) : member_identity(scene);
    }

    coupling::Scene in_folder(coupling::Scene          scene,
                              const std::string       &directory,
                              const std::string       &name,
                              const std::optional<int> seed)
    {
      scene.output.directory = directory;
      scene.name             = name;
      scene.sample.seed      = seed.value_or(scene.sample.seed);
      return scene;
    }

    py::dict described()
    {
      py::dict keys;
      for (const coupling::KeyDescription &key : coupling::described_keys())
        keys[py::str(key.section + "/" + key.name)] = py::make_tuple(key.unit, key.allowed, key.meaning);
      return keys;
    }
  } // namespace

  void bind_scene(py::module_ &m)
  {
    py::class_<coupling::Scene>(m, "Scene")
      .def_readonly("name", &coupling::Scene::name)
      .def_readonly("warnings", &coupling::Scene::warnings)
      .def("dict", scene_dict)
      .def("text", [](const coupling::Scene &scene) { return coupling::resolved_text(scene); })
      .def("identity", identity_of)
      .def("input_files", &coupling::input_files)
      .def("averaging_width", &coupling::averaging_width)
      .def("is_mirror_symmetric", &coupling::is_mirror_symmetric)
      .def("cost_over_springs", &coupling::cost_over_springs)
      .def("loading_variable",
           [](const coupling::Scene &scene) {
             const bool is_path = scene.loading.mode == discrete::LoadingMode::path && !scene.loading.path.names_a_file();
             if (is_path) // its progress is a strain
               return std::string(scene.loading.path.text == "simple_shear" ? "shear_strain" : "axial_strain");
             return std::string(discrete::name_of(discrete::loading_variable_of(scene.loading.mode)));
           })
      .def("path_shape", // mode path: (progress, strain) of the rows, or of start and end where the progress is a strain
           [](const coupling::Scene &scene) {
             const coupling::LoadingOptions &o    = scene.loading;
             const std::vector<double>       ends = {0, o.axial_strain};
             if (!o.path.names_a_file())
               return py::make_tuple(ends, ends);
             const auto path = coupling::cell_path(o.path, {o.pressure});
             return py::make_tuple(path.progress, discrete::times_of(path, o.pressure, 1));
           })
      .def("reversal_warning",
           [](const coupling::Scene &scene) {
             return coupling::reversal_warning(scene.continuum, coupling::discrete_loading(scene.loading).path.values);
           })
      .def("in_folder", in_folder, py::arg("directory"), py::arg("name"), py::arg("seed") = py::none())
      .def_property_readonly("directory", [](const coupling::Scene &scene) { return scene.output.directory; })
      .def("unused_keys",
           [](const coupling::Scene &scene) {
             py::dict keys; // of the section continuum, with the key because of which no law reads them
             for (const auto &[key, because] : unused_keys(scene.continuum))
               keys[py::str(key)] = because;
             return keys;
           })
      .def("law_parameters",
           [](const coupling::Scene &scene) { // law.NAME, value, ends of its range: of a library
             py::list                        found;
             const continuum::LawParameters &all = scene.continuum.material.library.parameters;
             for (const continuum::LawParameter &one : all.list)
               found.append(py::make_tuple(all.prefix + one.name, one.value, one.range[0], one.range[1]));
             return found;
           })
      .def("stages", [](const coupling::Scene &scene) { return coupling::stages(scene.loading); });
    m.def("read_scene", read, py::arg("file"), py::arg("changes"), py::arg("compares"));
    m.def("described_keys", described);
    m.def("section_names", &coupling::section_names);
    m.def("commands", [] { // those of Python: name -> its line in `diptych --help`
      py::dict lines;
      for (const auto &[name, description] : coupling::python_commands)
        lines[name] = description;
      return lines;
    });
    m.def("example_of", &coupling::example_of);
    m.attr("__version__")  = coupling::version;
    m.attr("git_revision") = coupling::git_revision;
  }
} // namespace diptych::python
