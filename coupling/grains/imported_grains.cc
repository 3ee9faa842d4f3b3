// diptych: frames of another code as the grains of a run
// SPDX-License-Identifier: LGPL-2.1-or-later
#include "coupling/grains/imported_grains.h"

#include <cmath>
#include <filesystem>

#include <nlohmann/json.hpp>

#include "coupling/scene/keys.h"
#include "coupling/scene/scene_error.h"
#include "coupling/scene/scene_file.h"
#include "coupling/store/file_names.h"
#include "coupling/store/provenance.h"
#include "coupling/store/result_folder.h"
#include "discrete/files/table_file.h"
#include "discrete/files/text_file.h"
#include "discrete/panel/snapshot_file.h"

namespace diptych::coupling
{
  namespace
  {
    // The name in discrete/file with {seed} replaced.
    std::string imported_file(std::string file, const int seed)
    {
      const std::string mark = "{seed}";
      for (std::size_t at = file.find(mark); at != std::string::npos; at = file.find(mark))
        file.replace(at, mark.size(), std::to_string(seed));
      return file;
    }

    // Samples of one ensemble have nearly the same strains, but not the same bits.
    constexpr double same_stage = 1e-3; // relative to the stage

    void take_stages(const std::vector<double> &wanted, const std::string &file, DiscreteResults &results)
    {
      if (results.snapshots.size() != wanted.size() + 1)
        throw SceneError("discrete/file = '" + file + "' holds " + std::to_string(results.snapshots.size()) +
                         " frames, but loading/stages need " + std::to_string(wanted.size()) + " and one at the start");
      for (std::size_t k = 0; k < wanted.size(); ++k)
        if (std::abs(results.snapshots[k + 1].progress - wanted[k]) > same_stage * wanted[k])
          throw SceneError("discrete/file = '" + file + "': frame " + std::to_string(k + 1) + " is at " +
                           text_of(results.snapshots[k + 1].progress) + ", but loading/stages has " + text_of(wanted[k]));
      if (results.rows.size() != results.snapshots.size())
        throw SceneError("discrete/file = '" + file + "': discrete.csv in the same folder has " +
                         std::to_string(results.rows.size()) + " rows instead of one per frame");
      for (std::size_t k = 0; k < wanted.size(); ++k)
        results.snapshots[k + 1].progress = results.rows[k + 1].progress = wanted[k];
    }

    // Runs copy the record of the import unchanged, so it must be valid.
    void check_record_of_import(const std::string &file)
    {
      if (!std::filesystem::exists(file))
        return;
      constexpr std::size_t most_bytes = std::size_t(1) << 28;
      const nlohmann::json  record     = nlohmann::json::parse(discrete::read_input(file, most_bytes), nullptr, false);
      if (!record.is_object() || !record.contains("format") || !record.contains("frames"))
        throw std::invalid_argument(file + ": is not the record of an import");
    }
  } // namespace

  DiscreteResults load_imported(const Scene &scene)
  {
    const std::string file = imported_file(scene.discrete.method.file, scene.sample.seed);
    if (file.empty())
      throw SceneError("discrete/method = imported needs discrete/file, the discrete.h5 of `diptych import`");
    const std::string folder = std::filesystem::path(file).parent_path().string();
    DiscreteResults   results;
    try
      {
        results.snapshots = discrete::read_snapshots(file);
        results.rows      = discrete::read_rows<discrete::HistoryRow>(discrete_csv(folder));
        results.facts     = read_run_facts(folder).discrete;
        check_record_of_import(import_json(folder));
        check_files(folder, "discrete");
      }
    catch (const std::invalid_argument &error)
      {
        throw SceneError("discrete/file = '" + file + "': " + error.what());
      }
    take_stages(stages(scene.loading), file, results);
    return results;
  }

  ImportedWalls imported_walls(const DiscreteResults &results)
  {
    const discrete::Snapshot &first = results.snapshots.front();
    ImportedWalls             walls;
    walls.initial_height = first.upper_y - first.lower_y;
    for (std::size_t k = 0; k < results.snapshots.size(); ++k)
      {
        const discrete::Snapshot &s   = results.snapshots[k];
        const auto                add = [&](discrete::TimeTable &table, const double value) {
          if (std::isfinite(value))
            {
              table.time.push_back(s.progress);
              table.value.push_back(value);
            }
        };
        add(walls.upper_x, s.upper_platen_displacement.x());
        add(walls.upper_y, s.upper_y - s.lower_y - walls.initial_height);
        add(walls.right_x, s.right_x - first.right_x - (s.left_x - first.left_x));
        add(walls.right_pressure, -results.rows[k].right_force.x() / (s.upper_y - s.lower_y));
      }
    return walls;
  }

  void take_imported(const RunOptions &options, const Scene &scene)
  {
    const std::string    &directory = scene.output.directory;
    const PhaseTimer      timer("discrete");
    const DiscreteResults imported = load_imported(scene);
    forget_fact(directory, "discrete"); // until the files are complete
    discrete::TableFile table(discrete_csv(directory), discrete::csv_header<discrete::HistoryRow>());
    for (const discrete::HistoryRow &row : imported.rows)
      table.add(discrete::csv_line(row));
    table.flush();
    discrete::write_snapshots(directory + "/discrete", imported.snapshots);
    record_phases(directory, {scene.name, {scene.sample.seed}, options.text}, {timer.stop()});
    record_facts(directory, imported.facts);
    const std::string file   = imported_file(scene.discrete.method.file, scene.sample.seed);
    const std::string folder = std::filesystem::path(file).parent_path().string();
    if (const std::string record = discrete::read_text(import_json(folder)); !record.empty())
      discrete::write_text(import_json(directory), record); // lists the quantities that the files lack
    say(options, "the grains are those of " + file);
  }
} // namespace diptych::coupling
