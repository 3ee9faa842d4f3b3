// diptych: Python binding of the discrete panel
// SPDX-License-Identifier: LGPL-2.1-or-later
#include <pybind11/functional.h>
#include <pybind11/stl.h>

#include "coupling/python/arrays.h"
#include "coupling/python/bindings.h"
#include "coupling/python/driven_panel.h"
#include "coupling/python/panel_results.h"
#include "coupling/scene/scene.h"
#include "discrete/panel/panel.h"

namespace diptych::python
{
  namespace
  {
    using GrainPanel = DrivenPanel<discrete::Panel, discrete::Hooks, discrete::HistoryRow>;

    std::unique_ptr<GrainPanel> make_panel(const coupling::Scene &scene, const py::object &position, const py::object &radius)
    {
      std::optional<discrete::Grains> grains;
      if (!position.is_none())
        {
          const auto centres = vectors_of(position.cast<Numbers>(), "position");
          const auto radii   = numbers_of(radius.cast<Numbers>(), "radius");
          if (radii.size() != centres.size())
            throw std::invalid_argument("radius: one entry a grain is needed: " + std::to_string(centres.size()) + ", not " +
                                        std::to_string(radii.size()));
          grains.emplace();
          for (std::size_t k = 0; k < radii.size(); ++k)
            discrete::add_grain(*grains, centres[k], radii[k], scene.sample.density);
        }
      return std::make_unique<GrainPanel>([&](const discrete::Hooks &hooks) {
        return discrete::Panel(scene.sample, coupling::discrete_loading(scene.loading), scene.discrete, hooks, grains);
      });
    }

    std::shared_ptr<discrete::Snapshot> snapshot_of(const GrainPanel &panel)
    {
      if (!panel.panel().has_snapshot())
        throw std::runtime_error("no snapshot before prepare()");
      return std::make_shared<discrete::Snapshot>(panel.snapshot());
    }
  } // namespace

  void bind_grains(py::module_ &m)
  {
    py::class_<GrainPanel>(m, "GrainPanel")
      .def(py::init(&make_panel), py::arg("scene"), py::arg("position") = py::none(), py::arg("radius") = py::none())
      .def("prepare", &GrainPanel::prepare)
      .def("advance", &GrainPanel::advance)
      .def("snapshot", &snapshot_of)
      .def("stage", [](const GrainPanel &panel) { return panel.panel().stage(); })
      .def("history", [](const GrainPanel &panel) { return columns_dict(panel.rows()); })
      .def("report", &GrainPanel::report)
      .def("results", [](const GrainPanel &panel, const GrainSnapshots &snapshots) {
        return GrainResults{panel.rows(), snapshots};
      });
    m.def("discrete_columns", &column_meanings<discrete::HistoryRow>);
  }
} // namespace diptych::python
