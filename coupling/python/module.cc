// diptych: the Python module diptych._diptych with scenes, grains, operators and results; it does not load deal.II
// SPDX-License-Identifier: LGPL-2.1-or-later
#include "coupling/program/commands.h"
#include "coupling/python/bindings.h"
#include "coupling/python/run_binding.h"

PYBIND11_MODULE(_diptych, m)
{
  using namespace diptych::python;
  using namespace diptych::coupling;
  m.doc() = "Scenes, grains, operators and results of Diptych; use them through the package diptych.";
  translate_errors();
  bind_scene(m);
  bind_campaigns(m);
  bind_histories(m);
  bind_snapshots(m);
  bind_results(m);
  bind_grains(m);
  bind_averaging(m);
  bind_bands(m);
  bind_probes(m);
  bind_problems(m);
  bind_import(m);
  bind_runs(m, {{"discrete", {Command::discrete, run_discrete}}});
}
