// diptych: what the compiled modules of the Python package are made of
// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <pybind11/pybind11.h>

namespace diptych::python
{
  // diptych._diptych: scenes, grains, operators, results.
  void bind_scene(pybind11::module_ &m);
  void bind_snapshots(pybind11::module_ &m);
  void bind_grains(pybind11::module_ &m);
  void bind_averaging(pybind11::module_ &m);
  void bind_bands(pybind11::module_ &m);
  void bind_probes(pybind11::module_ &m);
  void bind_problems(pybind11::module_ &m);
  void bind_results(pybind11::module_ &m);

  // coupling::SceneError becomes diptych.SceneError, in the module that calls this.
  void translate_errors();
} // namespace diptych::python
