// diptych: parts of the compiled Python modules
// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <pybind11/pybind11.h>

namespace diptych::python
{
  // diptych._diptych: scenes, grains, operators, results.
  void bind_campaigns(pybind11::module_ &m);
  void bind_scene(pybind11::module_ &m);
  void bind_histories(pybind11::module_ &m);
  void bind_snapshots(pybind11::module_ &m);
  void bind_grains(pybind11::module_ &m);
  void bind_averaging(pybind11::module_ &m);
  void bind_bands(pybind11::module_ &m);
  void bind_probes(pybind11::module_ &m);
  void bind_problems(pybind11::module_ &m);
  void bind_results(pybind11::module_ &m);
  void bind_import(pybind11::module_ &m);

  // Translates coupling::SceneError to diptych.SceneError in the calling module.
  void translate_errors();
} // namespace diptych::python
