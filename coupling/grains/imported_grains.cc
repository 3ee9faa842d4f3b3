// diptych: frames of another code as the grains of a run
// SPDX-License-Identifier: LGPL-2.1-or-later
#include "coupling/grains/imported_grains.h"

#include <filesystem>

#include "coupling/import/imported_folder.h"
#include "coupling/store/file_names.h"
#include "coupling/store/provenance.h"
#include "coupling/store/result_folder.h"
#include "discrete/files/table_file.h"
#include "discrete/files/text_file.h"
#include "discrete/panel/snapshot_file.h"

namespace diptych::coupling
{
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
