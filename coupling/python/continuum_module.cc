// diptych: the Python module diptych._continuum with the continuum panel and its laws
// SPDX-License-Identifier: LGPL-2.1-or-later
#include <mutex>
#include <set>

#include <pybind11/functional.h>
#include <pybind11/stl.h>

#include "continuum/mesh/mesh.h"
#include "continuum/panel/panel.h"
#include "coupling/panels/continuum_loading.h"
#include "coupling/panels/continuum_mesh.h"
#include "coupling/panels/initial_stress.h"
#include "coupling/processes/stop_signal.h"
#include "coupling/program/commands.h"
#include "coupling/python/bindings.h"
#include "coupling/python/driven_panel.h"
#include "coupling/python/law_binding.h"
#include "coupling/python/mpi.h"
#include "coupling/python/panel_results.h"
#include "coupling/python/run_binding.h"

namespace diptych::python
{
  namespace
  {
    using SharedGrains = std::shared_ptr<discrete::Snapshot>;

    // MPI and gmsh are not thread safe, so panels in several threads take turns. The callback of a panel may use other panels.
    // A thread waits without the GIL, because the running thread may need it for its callback.
    std::unique_lock<std::recursive_mutex> own_turn()
    {
      static std::recursive_mutex            continuum;
      const py::gil_scoped_release           release;
      std::unique_lock<std::recursive_mutex> turn(continuum);
      return turn;
    }

    class ContinuumPanel
    {
    public:
      using Driven = DrivenPanel<continuum::Panel, continuum::Hooks, continuum::HistoryRow>;

      ContinuumPanel(const coupling::Scene &given, SharedGrains prepared)
          : scene(given),
            grains(std::move(prepared))
      {
        coupling::require_continuum(scene);
        if (needs_grains() && !grains)
          throw coupling::SceneError({{}, "continuum/mesh", "outline"}, "needs the prepared grains; give their first snapshot");
        const auto turn = own_turn();
        start_mpi();
        {
          const py::gil_scoped_release release;
          driven = made();
        }
        living().insert(this);
      }
      ContinuumPanel(const ContinuumPanel &)            = delete;
      ContinuumPanel &operator=(const ContinuumPanel &) = delete;
      ~ContinuumPanel()
      {
        const auto turn = own_turn();
        living().erase(this);
        driven.reset();
      }

      std::string prepare(const py::object &on_step)
      {
        const auto turn = own_turn();
        {
          const py::gil_scoped_release release;
          coupling::map_initial_state(scene.continuum, scene.loading.pressure, grains.get(), driven->panel());
        }
        return driven->prepare(on_step);
      }

      std::string advance(const int stage, const py::object &on_step)
      {
        driven->demand_rest();
        const auto turn = own_turn();
        return driven->advance(stage, on_step);
      }

      std::shared_ptr<continuum::Snapshot> snapshot() const
      {
        driven->demand_rest();
        const auto turn = own_turn();
        return std::make_shared<continuum::Snapshot>(driven->snapshot());
      }

      const Driven &driver() const { return *driven; }

      // Called at the end of the process, before MPI ends.
      static void close_all()
      {
        const auto turn = own_turn();
        for (ContinuumPanel *panel : living())
          panel->driven->release();
        end_mpi();
      }

    private:
      bool needs_grains() const { return scene.continuum.mesh.kind == continuum::MeshOption::Kind::outline; }

      std::unique_ptr<Driven> made() const
      {
        const auto                part     = coupling::continuum_parts(scene).front();
        const continuum::QuadMesh mesh     = coupling::mesh_of(scene.continuum, part.edge, grains.get());
        const double              fraction = needs_grains() ? coupling::solid_fraction(*grains) : scene.sample.solid_fraction;
        const continuum::Loading  loading  = coupling::continuum_loading(scene, coupling::measured(mesh, fraction));
        return std::make_unique<Driven>([&](const continuum::Hooks &hooks) {
          return continuum::Panel(mesh, coupling::continuum_units(scene), loading, scene.continuum, hooks);
        });
      }

      static std::set<ContinuumPanel *> &living()
      {
        static std::set<ContinuumPanel *> panels;
        return panels;
      }

      coupling::Scene         scene;
      SharedGrains            grains;
      std::unique_ptr<Driven> driven;
    };

    // Raises what makes all samples with these seeds fail; prints their resources.
    void check(const coupling::Scene &scene, const std::vector<int> &seeds, const py::dict &options)
    {
      coupling::CommandLine line;
      line.command     = coupling::Command::run;
      line.threads     = options["threads"].cast<int>();
      line.quiet       = options["quiet"].cast<bool>();
      line.resume      = options["resume"].cast<bool>();
      line.checks_only = options["check"].cast<bool>();
      const coupling::TakenSignals taken;
      coupling::check_run(line, coupling::with_options(line, scene), seeds);
      coupling::leave_if_stopped("checking the scene");
    }

    void bind_panel(py::module_ &m)
    {
      py::class_<ContinuumPanel>(m, "ContinuumPanel")
        .def(py::init<const coupling::Scene &, SharedGrains>(), py::arg("scene"), py::arg("grains") = py::none())
        .def("prepare", &ContinuumPanel::prepare)
        .def("advance", &ContinuumPanel::advance)
        .def("snapshot", &ContinuumPanel::snapshot)
        .def("stage", [](const ContinuumPanel &panel) { return panel.driver().panel().stage(); })
        .def("history", [](const ContinuumPanel &panel) { return columns_dict(panel.driver().rows()); })
        .def("report", [](const ContinuumPanel &panel) { return panel.driver().report(); })
        .def("results", [](const ContinuumPanel &panel, const ContinuumSnapshots &snapshots) {
          return ContinuumResults{panel.driver().rows(), snapshots};
        });
    }
  } // namespace
} // namespace diptych::python

PYBIND11_MODULE(_continuum, m)
{
  using namespace diptych::python;
  m.doc() = "The continuum panel of Diptych and its laws; use them through the package diptych.";
  py::module_::import("diptych._diptych"); // registers the types of scenes and snapshots
  translate_errors();
  bind_panel(m);
  bind_laws(m);
  using namespace diptych::coupling;
  bind_runs(m,
            {{"run", {Command::run, run_both}},
             {"discrete", {Command::discrete, run_discrete}},
             {"continuum", {Command::continuum, run_continuum}},
             {"material-point", {Command::material_point, run_material_point}}},
            start_mpi);
  m.def("check", &check);
  m.def("require_continuum", &diptych::coupling::require_continuum);
  m.def("write_mesh",
        [](const diptych::coupling::Scene &scene, const diptych::discrete::Snapshot &grains, const std::string &file) {
          const auto                   turn = own_turn();
          const py::gil_scoped_release release;
          const double                 edge = diptych::coupling::continuum_parts(scene).front().edge;
          diptych::continuum::write_mesh(diptych::coupling::mesh_of(scene.continuum, edge, &grains), file);
        });
  py::module_::import("atexit").attr("register")(py::cpp_function(&ContinuumPanel::close_all));
}
