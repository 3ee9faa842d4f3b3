// diptych: import FORMAT FILES: other codes' samples as results of the discrete panel
// SPDX-License-Identifier: LGPL-2.1-or-later
#include "coupling/program/import_command.h"

#include <cmath>
#include <cstdio>
#include <filesystem>
#include <functional>
#include <iostream>
#include <map>
#include <sstream>

#include <nlohmann/json.hpp>

#include "coupling/import/arrival.h"
#include "coupling/import/import_record.h"
#include "coupling/import/imported_folder.h"
#include "coupling/import/imported_results.h"
#include "coupling/import/readers.h"
#include "coupling/numbers/number_json.h"
#include "coupling/scene/scene_file.h"
#include "coupling/scene/scene_text.h"
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
    namespace fs = std::filesystem;

    ForeignSample read_foreign(const std::string &format, const ForeignOptions &options)
    {
      const std::map<std::string, std::function<ForeignSample(const ForeignOptions &)>> readers = {
        {"lammps", read_lammps}, {"liggghts", read_liggghts},     {"yade", read_yade},
        {"lmgc90", read_lmgc90}, {"mercurydpm", read_mercurydpm}, {"csv", read_plain_csv}};
      return readers.at(format)(options);
    }

    // What is announced as a scene must be one: units, or what the command line says, may lead out of the ranges of its keys.
    void check_scene(const std::string &format, const std::string &text)
    {
      std::istringstream in(text);
      try
        {
          (void)scene_of_entries("scene.prm", entries_of_prm("scene.prm", in), false);
        }
      catch (const SceneError &error)
        {
          throw SceneError("import " + format + ": the scene of this sample would not run: " + error.what());
        }
    }

    std::string cell(const double value, const char *format)
    {
      char text[32];
      std::snprintf(text, sizeof text, format, value);
      return std::isfinite(value) ? text : "-";
    }

    void say_checks(const CommandLine &line, const Arrival &arrival)
    {
      say(line,
          "frame              strain %  grains  contacts  on walls  solid fr.  stress xx         yy         xy    walls diff %  "
          "balance rms     overlap/d");
      for (const ArrivalCheck &c : arrival.checks)
        {
          const int walls = c.lower_contacts + c.upper_contacts + c.left_contacts + c.right_contacts;
          char      text[256];
          std::snprintf(text, sizeof text, "%-18.18s %8s %7d %9d %9d %10s %10s %10s %10s %14s %12s %13s", c.name.c_str(),
                        cell(100 * c.axial_strain, "%.4f").c_str(), c.grains, c.contacts, walls,
                        cell(c.solid_fraction, "%.4f").c_str(), cell(c.contact_stress(0, 0), "%.6g").c_str(),
                        cell(c.contact_stress(1, 1), "%.6g").c_str(),
                        cell(0.5 * (c.contact_stress(0, 1) + c.contact_stress(1, 0)), "%.4g").c_str(),
                        cell(100 * c.stress_difference, "%.2g").c_str(), cell(c.balance_rms, "%.2g").c_str(),
                        cell(c.largest_overlap, "%.2g").c_str());
          say(line, text);
        }
      say(line, arrival.checks.back().against_resultants
                  ? "balance: forces on each grain minus the resultant that the files tell, over the mean contact force"
                  : "balance: forces on each grain, over the mean contact force (the files tell no resultants: motion is in it)");
      for (const std::string &text : arrival.remarks)
        say(line, "note: " + text);
      for (const std::string &text : arrival.lacking)
        say(line, "not in the files: " + text);
      for (const std::string &text : arrival.doubtful)
        std::cerr << "diptych import: warning: " << text << std::endl;
    }

    void write_imported(const CommandLine     &line,
                        const Arrival         &arrival,
                        const DiscreteResults &results,
                        const std::string     &scene_text)
    {
      const std::string &directory = line.output;
      nlohmann::json     json;
      const ImportRecord record{line.foreign.files, arrival};
      NumbersToJson      into{json, 1};
      list_numbers(record, into);
      discrete::write_text(import_json(directory),
                           json.dump(2) + "\n"); // first: the folder is an import's, even if killed now
      discrete::TableFile table(discrete_csv(directory), discrete::csv_header<discrete::HistoryRow>());
      for (const discrete::HistoryRow &row : results.rows)
        table.add(discrete::csv_line(row));
      table.flush();
      discrete::write_snapshots(directory + "/discrete", results.snapshots);
      if (!scene_text.empty())
        discrete::write_text(scene_prm(directory), scene_text);
    }
  } // namespace

  int import_sample(const CommandLine &line)
  {
    const PhaseTimer timer("import");
    require_usable(line.output, opening_of(line));
    for (const std::string &file : line.foreign.files)
      if (!fs::is_directory(file))
        discrete::require_regular_file(file);
    const Arrival         arrival = arrive(read_foreign(line.target, line.foreign), line.foreign);
    const DiscreteResults results = imported_results(arrival);
    const bool            loaded  = results.snapshots.size() > 1;
    const std::string     scene   = loaded ? imported_scene(arrival, results, line.foreign.pressure) : "";
    if (loaded)
      check_scene(line.target, scene);
    return writing(line.output, [&](FolderLock &lock) {
      if (line.overwrite && !is_empty_folder(line.output))
        {
          InputFiles inputs;
          for (const std::string &file : line.foreign.files)
            inputs.emplace_back("the file", file);
          set_aside(lock, inputs);
        }
      write_imported(line, arrival, results, scene);
      Scene described;
      described.name             = fs::path(line.output).filename().string();
      described.output.directory = line.output;
      record_phases(line.output, {described.name, {described.sample.seed}, line.text}, {timer.stop()});
      record_facts(line.output, results.facts);
      say_checks(line, arrival);
      say(line, loaded ? "written to " + line.output + "; both panels: diptych run " + scene_prm(line.output)
                       : "written to " + line.output + "; one frame is no loading, so there is no scene");
      return done;
    });
  }
} // namespace diptych::coupling
