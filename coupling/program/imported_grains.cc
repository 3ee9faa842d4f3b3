// diptych: what stands in the place of an earlier run of the grains
// SPDX-License-Identifier: LGPL-2.1-or-later
#include "coupling/program/imported_grains.h"

#include <cstdio>
#include <filesystem>

#include "coupling/folders/provenance.h"
#include "coupling/folders/result_folder.h"
#include "coupling/import/imported_folder.h"
#include "discrete/files/table_file.h"
#include "discrete/files/text_file.h"
#include "discrete/panel/snapshot_file.h"

namespace diptych::coupling
{
  std::string problem_name(const int stage)
  {
    char name[32];
    std::snprintf(name, sizeof name, "/problem_%04d.h5", stage);
    return name;
  }

  int take_imported(const CommandLine &line, const Scene &scene)
  {
    const std::string    &directory = scene.output.directory;
    const PhaseTimer      timer("discrete");
    const DiscreteResults imported = load_imported(scene);
    forget_fact(directory, "discrete"); // until the files are complete
    discrete::TableFile table(directory + "/discrete.csv", discrete::csv_header<discrete::HistoryRow>());
    for (const discrete::HistoryRow &row : imported.rows)
      table.add(discrete::csv_line(row));
    table.flush();
    discrete::write_snapshots(directory + "/discrete", imported.snapshots);
    record_phases(directory, scene, line.text, {timer.stop()});
    record_facts(directory, imported.facts);
    const std::string folder = std::filesystem::path(imported_file(scene)).parent_path().string();
    if (const std::string said = discrete::read_text(folder + "/import.json"); !said.empty())
      discrete::write_text(directory + "/import.json", said); // what was not told must be known here, too
    say(line, "the grains are those of " + imported_file(scene));
    return done;
  }
} // namespace diptych::coupling
