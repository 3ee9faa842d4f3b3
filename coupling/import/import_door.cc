// diptych: takes frames of another code, checks them and writes them as results of the discrete panel
// SPDX-License-Identifier: LGPL-2.1-or-later
#include "coupling/import/import_door.h"

#include <cmath>
#include <cstdio>
#include <filesystem>
#include <iostream>
#include <sstream>

#include <nlohmann/json.hpp>

#include "coupling/import/arrival.h"
#include "coupling/import/import_record.h"
#include "coupling/import/imported_results.h"
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
    // Units and options may lead out of the ranges of a scene's keys.
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

    void say_checks(const RunOptions &run, const Arrival &arrival)
    {
      say(run,
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
          say(run, text);
        }
      say(run, arrival.checks.back().against_resultants
                 ? "balance: forces on each grain minus its net force in the files, over the mean contact force"
                 : "balance: forces on each grain, over the mean contact force (the files hold no net forces, so "
                   "accelerations count as imbalance)");
      for (const std::string &text : arrival.remarks)
        say(run, "note: " + text);
      for (const std::string &text : arrival.lacking)
        say(run, "not in the files: " + text);
      for (const std::string &text : arrival.doubtful)
        std::cerr << "diptych import: warning: " << text << std::endl;
    }

    void write_imported(const std::string     &directory,
                        const std::string     &record,
                        const DiscreteResults &results,
                        const std::string     &scene_text)
    {
      discrete::write_text(import_json(directory), record); // first, so that a killed import is still recognised as one
      discrete::TableFile table(discrete_csv(directory), discrete::csv_header<discrete::HistoryRow>());
      for (const discrete::HistoryRow &row : results.rows)
        table.add(discrete::csv_line(row));
      table.flush();
      discrete::write_snapshots(directory + "/discrete", results.snapshots);
      if (!scene_text.empty())
        discrete::write_text(scene_prm(directory), scene_text);
    }
  } // namespace

  std::string import_record(const ForeignOptions &options, const Arrival &arrival)
  {
    nlohmann::json     json;
    const ImportRecord record{options.files, arrival};
    NumbersToJson      into{json, 1};
    list_numbers(record, into);
    return json.dump(2) + "\n";
  }

  void import_frames(const ForeignSample &sample, const ForeignOptions &options, const std::string &output, const RunOptions &run)
  {
    const PhaseTimer timer("import");
    InputFiles       inputs;
    for (const std::string &file : options.files)
      inputs.emplace_back("the file", file);
    require_usable(output, {false, run.overwrite, false, false, run.text, inputs});
    const Arrival         arrival = arrive(sample, options);
    const DiscreteResults results = imported_results(arrival);
    const bool            loaded  = results.snapshots.size() > 1;
    const std::string     scene   = loaded ? imported_scene(arrival, results, options.pressure) : "";
    if (loaded)
      check_scene(sample.format, scene);
    writing(output, [&](FolderLock &lock) {
      if (run.overwrite && !is_empty_folder(output))
        set_aside(lock, inputs);
      write_imported(output, import_record(options, arrival), results, scene);
      Scene described;
      described.name             = std::filesystem::path(output).filename().string();
      described.output.directory = output;
      record_phases(output, {described.name, {described.sample.seed}, run.text}, {timer.stop()});
      record_facts(output, results.facts);
      say_checks(run, arrival);
      say(run, loaded ? "written to " + output + "; both panels: diptych run " + scene_prm(output)
                      : "written to " + output + "; one frame is no loading, so there is no scene");
      return 0;
    });
  }
} // namespace diptych::coupling
