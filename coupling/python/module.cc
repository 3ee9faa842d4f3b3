// diptych: the module diptych._diptych: scenes, grains, operators, results; starts without deal.II
// SPDX-License-Identifier: LGPL-2.1-or-later
#include "coupling/python/bindings.h"

PYBIND11_MODULE(_diptych, m)
{
  using namespace diptych::python;
  m.doc() = "Scenes, grains, operators and results of Diptych; use them through the package diptych.";
  translate_errors();
  bind_scene(m);
  bind_snapshots(m);
  bind_results(m);
  bind_grains(m);
  bind_averaging(m);
  bind_bands(m);
  bind_probes(m);
  bind_problems(m);
}
