// diptych: the module diptych._continuum: the continuum panel and its laws
// SPDX-License-Identifier: LGPL-2.1-or-later
#include <set>

#include <pybind11/functional.h>
#include <pybind11/stl.h>

#include "continuum/mesh/mesh.h"
#include "continuum/panel/panel.h"
#include "coupling/panels/continuum_loading.h"
#include "coupling/panels/continuum_mesh.h"
#include "coupling/panels/initial_stress.h"
#include "coupling/python/bindings.h"
#include "coupling/python/driven_panel.h"
#include "coupling/python/law_binding.h"
#include "coupling/python/mpi.h"
#include "coupling/python/panel_results.h"

namespace diptych::python
{
  namespace
  {
    using SharedGrains = std::shared_ptr<discrete::Snapshot>;

    // One run on the scene's mesh.
    class ContinuumPanel
    {
    public:
      using Driven = DrivenPanel<continuum::Panel, continuum::Hooks, continuum::HistoryRow>;

      ContinuumPanel(const coupling::Scene &scene, SharedGrains grains)
          : scene(scene),
            grains(std::move(grains))
      {
        coupling::require_continuum(scene);
        const bool outline = scene.continuum.mesh.kind == continuum::MeshOption::Kind::outline;
        if (outline && !this->grains)
          throw coupling::SceneError("continuum/mesh = outline needs the prepared grains: hand over their first snapshot");
        start_mpi();
        const continuum::QuadMesh mesh = coupling::mesh_of(scene, coupling::continuum_parts(scene).front(), this->grains.get());
        const double              fraction = outline ? coupling::solid_fraction(*this->grains) : scene.sample.solid_fraction;
        const continuum::Loading  loading  = coupling::continuum_loading(scene, coupling::measured(mesh, fraction));
        driven                             = std::make_unique<Driven>([&](const continuum::Hooks &hooks) {
          return continuum::Panel(mesh, coupling::continuum_units(scene), loading, scene.continuum, hooks);
        });
        living().insert(this);
      }
      ContinuumPanel(const ContinuumPanel &)            = delete;
      ContinuumPanel &operator=(const ContinuumPanel &) = delete;
      ~ContinuumPanel() { living().erase(this); }

      std::string prepare(const py::object &on_step)
      {
        coupling::map_initial_state(scene, grains.get(), driven->panel());
        return driven->prepare(on_step);
      }

      // At the end of the process, before MPI ends.
      static void close_all()
      {
        for (ContinuumPanel *panel : living())
          panel->driven->release();
        end_mpi();
      }

      coupling::Scene         scene;
      SharedGrains            grains;
      std::unique_ptr<Driven> driven;

    private:
      static std::set<ContinuumPanel *> &living()
      {
        static std::set<ContinuumPanel *> panels;
        return panels;
      }
    };

    py::dict report_of(const ContinuumPanel &panel)
    {
      const continuum::Report &r = panel.driven->panel().report();
      py::dict                 report;
      report["message"]               = r.message;
      report["progress"]              = r.progress;
      report["axial_strain"]          = r.axial_strain;
      report["shear_strain"]          = r.shear_strain;
      report["n_cells"]               = r.n_cells;
      report["n_unknowns"]            = r.n_unknowns;
      report["steps"]                 = r.steps;
      report["cut_backs"]             = r.cut_backs;
      report["newton_iterations"]     = r.newton_iterations;
      report["localisation_progress"] = r.localisation_progress;
      report["localisation_angle"]    = r.localisation_angle;
      return report;
    }

    void bind_panel(py::module_ &m)
    {
      py::class_<ContinuumPanel>(m, "ContinuumPanel")
        .def(py::init<const coupling::Scene &, SharedGrains>(), py::arg("scene"), py::arg("grains") = py::none())
        .def("prepare", &ContinuumPanel::prepare)
        .def("advance", [](ContinuumPanel &panel, const int stage,
                           const py::object &on_step) { return panel.driven->advance(stage, on_step); })
        .def("snapshot",
             [](const ContinuumPanel &panel) { return std::make_shared<continuum::Snapshot>(panel.driven->snapshot()); })
        .def("stage", [](const ContinuumPanel &panel) { return panel.driven->panel().stage(); })
        .def("history", [](const ContinuumPanel &panel) { return columns_dict(panel.driven->rows()); })
        .def("report", &report_of)
        .def("results", [](const ContinuumPanel &panel, const ContinuumSnapshots &snapshots) {
          return ContinuumResults{panel.driven->rows(), snapshots};
        });
    }
  } // namespace
} // namespace diptych::python

PYBIND11_MODULE(_continuum, m)
{
  using namespace diptych::python;
  m.doc() = "The continuum panel of Diptych and its laws; use them through the package diptych.";
  py::module_::import("diptych._diptych"); // knows scenes and snapshots
  translate_errors();
  bind_panel(m);
  bind_laws(m);
  py::module_::import("atexit").attr("register")(py::cpp_function(&ContinuumPanel::close_all));
}
