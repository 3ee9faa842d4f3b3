// diptych: runs the continuum panel and writes its files
// SPDX-License-Identifier: LGPL-2.1-or-later
#include "coupling/panels/recorded_continuum.h"

#include <filesystem>
#include <sstream>

#include "continuum/mesh/mesh.h"
#include "coupling/panels/continuum_loading.h"
#include "coupling/panels/initial_stress.h"
#include "coupling/panels/processes.h"
#include "coupling/processes/stop_signal.h"
#include "coupling/scene/identity.h"
#include "coupling/scene/scene_error.h"
#include "coupling/store/file_names.h"

namespace diptych::coupling
{
  namespace
  {
    // Gives all processes the mesh of the first.
    continuum::QuadMesh shared(continuum::QuadMesh mesh)
    {
      if (n_processes() == 1)
        return mesh;
      std::vector<double> numbers = {double(mesh.vertices.size()), double(mesh.cells.size())};
      for (const Eigen::Vector2d &x : mesh.vertices)
        numbers.insert(numbers.end(), {x.x(), x.y()});
      for (const auto &cell : mesh.cells)
        numbers.insert(numbers.end(), cell.begin(), cell.end());
      for (const auto &edge : mesh.boundary)
        numbers.insert(numbers.end(), {double(edge.vertices[0]), double(edge.vertices[1]), double(edge.id)});
      numbers = from_first_process(std::move(numbers));

      mesh               = {};
      const double *next = numbers.data() + 2, *end = numbers.data() + numbers.size();
      for (std::size_t k = 0; k < std::size_t(numbers[0]); ++k, next += 2)
        mesh.vertices.emplace_back(next[0], next[1]);
      for (std::size_t k = 0; k < std::size_t(numbers[1]); ++k, next += 4)
        mesh.cells.push_back({unsigned(next[0]), unsigned(next[1]), unsigned(next[2]), unsigned(next[3])});
      for (; next < end; next += 3)
        mesh.boundary.push_back({{unsigned(next[0]), unsigned(next[1])}, continuum::BoundaryId(int(next[2]))});
      return mesh;
    }

    continuum::QuadMesh made(const continuum::Options &options, const ContinuumPart &part, const discrete::Snapshot *grains)
    {
      continuum::QuadMesh mesh;
      on_first_process([&] {
        mesh = mesh_of(options, part.edge, grains);
        leave_if_stopped(part.title);
        std::filesystem::create_directories(part.directory);
        continuum::write_mesh(mesh, sample_msh(part.directory));
        leave_if_stopped(part.title);
        return 0;
      });
      return shared(std::move(mesh));
    }
  } // namespace

  RecordedContinuum::RecordedContinuum(const RunOptions         &options,
                                       const Scene              &scene,
                                       const ContinuumPart      &part,
                                       const discrete::Snapshot *grains,
                                       const double              solid_fraction,
                                       const bool                resume)
      : options(options),
        scene(scene),
        part(part),
        grains(grains),
        mesh(made(scene.continuum, part, grains)),
        loading(continuum_loading(scene, measured(mesh, solid_fraction))),
        scene_identity(text_of(continuum_identity(scene))),
        sample_identity(identity_of(mesh)),
        progress(options.quiet),
        panel(std::make_unique<continuum::Panel>(mesh, continuum_units(scene), loading, scene.continuum, hooks())),
        is_under_way(resume)
  {
    if (resume)
      take_up();
  }

  void RecordedContinuum::take_up()
  {
    ContinuumCheckpoint checkpoint;
    on_first_process([&] {
      checkpoint = read_continuum_checkpoint(part.checkpoint());
      if (checkpoint.scene != scene_identity || checkpoint.sample != sample_identity)
        throw SceneError("--resume: " + part.checkpoint() + " belongs to another " +
                         (checkpoint.scene != scene_identity ? "scene" : "mesh"));
      return 0;
    });
    try
      {
        panel->resume(checkpoint.panel);
      }
    catch (const std::invalid_argument &error)
      {
        throw std::invalid_argument(part.checkpoint() + ": " + error.what());
      }
    on_first_process([&] {
      table.emplace(continuum_csv(part.directory), discrete::csv_header<continuum::HistoryRow>(), checkpoint.n_rows);
      snapshots.emplace(path("continuum"), std::size_t(checkpoint.panel.stage) + 1);
      return 0;
    });
  }

  continuum::Hooks RecordedContinuum::hooks()
  {
    continuum::Hooks   hooks;
    std::ostringstream phase;
    phase << "continuum, elements of " << part.element_size << " d";
    hooks.check_stop = [this] {
      if (any_process(stop_requested())) // so that all leave
        throw StoppedOnRequest(part.title + ": stopped on request while it was set up");
    };
    hooks.stop_requested = stop_requested;
    hooks.before_step    = [this] {
      flush_now_and_then();
      const double passed = std::chrono::duration<double>(Clock::now() - saved).count();
      if (any_process(is_first_process() && passed >= 60 * scene.continuum.checkpoint_minutes))
        save();
    };
    hooks.on_progress = [this, name = phase.str()](const std::string &, const double fraction) {
      progress.update(name, fraction, reached_text(results.rows));
    };
    hooks.on_row = [this](const continuum::HistoryRow &row) { add_row(row); };
    return hooks;
  }

  const continuum::Report &RecordedContinuum::run()
  {
    if (!is_under_way)
      prepare();
    for (int stage = panel->stage() + 1;
         panel->report().status == continuum::Status::finished && stage <= int(loading.stages.size()); ++stage)
      {
        const bool reached = panel->advance_to(stage) == continuum::Status::finished;
        if (reached || panel->report().progress > 0)
          add_snapshot();
      }
    progress.finish(panel->report().status == continuum::Status::finished);
    if (panel->report().status == continuum::Status::stopped_by_user && is_under_way)
      save();
    on_first_process([&] {
      flush_rows();
      if (panel->report().status == continuum::Status::finished)
        {
          snapshots->close();
          std::filesystem::remove(part.checkpoint());
        }
      return 0;
    });
    return panel->report();
  }

  void RecordedContinuum::prepare()
  {
    on_first_process([&] {
      table.emplace(continuum_csv(part.directory), discrete::csv_header<continuum::HistoryRow>());
      snapshots.emplace(path("continuum"));
      return 0;
    });
    map_initial_state(scene.continuum, scene.loading.pressure, grains, *panel);
    if (panel->prepare() != continuum::Status::finished)
      return;
    is_under_way = true;
    add_snapshot();
  }

  // Only the first process collects rows; flush_now_and_then() reports an error of writing to all processes.
  void RecordedContinuum::add_row(const continuum::HistoryRow &row)
  {
    table->add(discrete::csv_line(row));
    results.rows.push_back(row);
  }

  void RecordedContinuum::flush_now_and_then()
  {
    on_first_process([&] {
      if (Clock::now() - flushed >= std::chrono::seconds(1))
        {
          flush_rows();
          flushed = Clock::now();
        }
      return 0;
    });
  }

  void RecordedContinuum::flush_rows()
  {
    if (table)
      table->flush();
  }

  void RecordedContinuum::add_snapshot()
  {
    continuum::Snapshot snapshot = panel->snapshot();
    on_first_process([&] {
      flush_rows();
      snapshots->add(snapshot);
      if (keeps_snapshots)
        results.snapshots.push_back(std::move(snapshot));
      return 0;
    });
  }

  // Rows first: the checkpoint records how many rows belong to it.
  void RecordedContinuum::save()
  {
    const continuum::Checkpoint checkpoint = panel->checkpoint();
    on_first_process([&] {
      flush_rows();
      write_continuum_checkpoint(part.checkpoint(), {checkpoint, table->n_rows(), scene_identity, sample_identity});
      return 0;
    });
    saved = Clock::now();
  }
} // namespace diptych::coupling
