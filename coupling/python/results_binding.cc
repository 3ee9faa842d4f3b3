// diptych: Python binding of result folders and the comparison
// SPDX-License-Identifier: LGPL-2.1-or-later
#include <pybind11/stl.h>

#include "coupling/comparison/comparison_arrays.h"
#include "coupling/comparison/comparison_numbers.h"
#include "coupling/numbers/number_json.h"
#include "coupling/python/arrays.h"
#include "coupling/python/bindings.h"
#include "coupling/python/panel_results.h"
#include "coupling/python/rows.h"
#include "coupling/store/continuum_snapshot_file.h"
#include "coupling/store/file_names.h"
#include "coupling/store/provenance.h"
#include "coupling/store/result_folder.h"
#include "discrete/files/table_file.h"
#include "discrete/panel/snapshot_file.h"

namespace diptych::python
{
  namespace
  {
    template <class Snapshot> std::vector<std::shared_ptr<Snapshot>> shared(std::vector<Snapshot> snapshots)
    {
      std::vector<std::shared_ptr<Snapshot>> list;
      for (Snapshot &snapshot : snapshots)
        list.push_back(std::make_shared<Snapshot>(std::move(snapshot)));
      return list;
    }

    template <class Snapshot> std::vector<Snapshot> values_of(const std::vector<std::shared_ptr<Snapshot>> &list)
    {
      std::vector<Snapshot> snapshots;
      for (const auto &snapshot : list)
        snapshots.push_back(*snapshot);
      return snapshots;
    }

    template <class Row> void write_rows(const std::string &path, const std::vector<Row> &rows)
    {
      discrete::TableFile table(path, discrete::csv_header<Row>());
      for (const Row &row : rows)
        table.add(discrete::csv_line(row));
      table.flush();
    }

    GrainResults read_grains(const std::string &folder)
    {
      return {discrete::read_rows<discrete::HistoryRow>(coupling::discrete_csv(folder)),
              shared(discrete::read_snapshots(coupling::discrete_h5(folder)))};
    }

    void write_grains(const GrainResults &results, const std::string &folder)
    {
      discrete::write_snapshots(folder + "/discrete", values_of(results.snapshots));
      write_rows(coupling::discrete_csv(folder), results.rows);
    }

    ContinuumResults read_nodes(const std::string &folder)
    {
      return {discrete::read_rows<continuum::HistoryRow>(coupling::continuum_csv(folder)),
              shared(coupling::read_continuum_snapshots(coupling::continuum_h5(folder)))};
    }

    void write_nodes(const ContinuumResults &results, const std::string &folder)
    {
      coupling::ContinuumSnapshotFile file(folder + "/continuum");
      for (const auto &snapshot : results.snapshots)
        file.add(*snapshot);
      file.close();
      write_rows(coupling::continuum_csv(folder), results.rows);
    }

    coupling::Results joined(const GrainResults     &grains,
                             const ContinuumResults &nodes,
                             const ContinuumResults *coarse,
                             const std::string      &folder)
    {
      const coupling::RunFacts facts = folder.empty() ? coupling::RunFacts() : coupling::read_run_facts(folder);
      coupling::Results        results{{grains.rows, values_of(grains.snapshots), facts.discrete},
                                {nodes.rows, values_of(nodes.snapshots), facts.continuum},
                                {},
                                facts.phases};
      if (coarse != nullptr)
        results.coarse = {coarse->rows, values_of(coarse->snapshots), facts.continuum_coarse};
      return results;
    }

    py::dict arrays_of(const coupling::CellFields &fields, const coupling::Increment &increment)
    {
      py::dict dict;
      coupling::list_cell_arrays(fields, coupling::motion_units(increment),
                                 [&](const coupling::ArrayEntry &entry, const auto &values) {
                                   using Value     = typename std::decay_t<decltype(values)>::value_type;
                                   dict[entry.key] = own(std::vector<Value>(values));
                                 });
      std::vector<std::array<unsigned int, 4>> cells = fields.mesh.cell;
      dict["nodes"]                                  = own(std::vector<Eigen::Vector2d>(fields.mesh.node));
      dict["cells"]                                  = own(std::move(cells));
      return dict;
    }

    // (text of comparison.json, arrays of every stage on the mesh, arrays of every stage on the grid)
    py::tuple compare(coupling::Scene         scene,
                      const GrainResults     &grains,
                      const ContinuumResults &nodes,
                      const ContinuumResults *coarse,
                      const std::string      &folder)
    {
      std::string          text;
      coupling::Comparison comparison;
      {
        const py::gil_scoped_release release;
        if (const std::string name = folder.empty() ? "" : coupling::recorded_scene(folder); !name.empty())
          scene.name = name;
        comparison                   = coupling::compare(scene, joined(grains, nodes, coarse, folder));
        nlohmann::json          root = nlohmann::json::object();
        coupling::NumbersToJson writer{root, scene.sample.mean_diameter};
        coupling::list_numbers(coupling::ComparisonDocument{scene, comparison}, writer);
        text = root.dump();
      }
      py::list on_mesh, on_grid;
      for (const coupling::StageRecord &stage : comparison.stages)
        {
          on_mesh.append(arrays_of(stage.fields, stage.increment));
          on_grid.append(arrays_of(stage.grid, stage.increment));
        }
      return py::make_tuple(text, on_mesh, on_grid);
    }

    template <class Results> void bind_one(py::module_ &m, const char *name)
    {
      py::class_<Results>(m, name).def_readonly("snapshots", &Results::snapshots).def("history", [](const Results &results) {
        return columns_dict(results.rows);
      });
    }
  } // namespace

  void bind_results(py::module_ &m)
  {
    bind_one<GrainResults>(m, "GrainResults");
    bind_one<ContinuumResults>(m, "ContinuumResults");
    // These keep the GIL, because HDF5 is not thread safe.
    m.def("read_grains", &read_grains);
    m.def("read_nodes", &read_nodes);
    m.def("write_grains", &write_grains);
    m.def("write_nodes", &write_nodes);
    m.def("compare", &compare);
    m.def("check_files", [](const std::string &folder) { coupling::check_files(folder); });
    m.def("continuum_columns", &column_meanings<continuum::HistoryRow>);
  }
} // namespace diptych::python
