// diptych: what the finished members of an ensemble say together
// SPDX-License-Identifier: LGPL-2.1-or-later
#include "coupling/program/ensemble_record.h"

#include <algorithm>
#include <fstream>
#include <sstream>
#include <stdexcept>

#include <nlohmann/json.hpp>

#include "coupling/ensembles/ensemble_curves.h"
#include "coupling/ensembles/ensemble_folder.h"
#include "coupling/numbers/record_file.h"
#include "coupling/processes/worker.h"
#include "coupling/program/report_command.h"
#include "coupling/scene/scene_file.h"
#include "coupling/store/file_names.h"

namespace diptych::coupling
{
  namespace
  {
    using nlohmann::json;

    Member read_member(const Scene &scene, const int seed)
    {
      const std::string folder = member_folder(scene.output.directory, seed), path = comparison_json(folder);
      check_files(folder);
      check_files(folder, "comparison");
      demand_member(scene, seed);
      const json record = read_record_file(path);
      try
        {
          Member member = member_of(record);
          if (member.seed != seed)
            throw std::invalid_argument("is of the seed " + std::to_string(member.seed) + ", in the folder of another");
          if (is_mirror_symmetric(scene))
            fold(member);
          return member;
        }
      catch (const std::invalid_argument &error)
        {
          throw std::invalid_argument(path + ": " + error.what());
        }
    }

    // "window 0-0.01 band angle_deg: cannot tell: continuum - grains -1.1 [-3.8, 1.6] degrees, margin 3, 8 pairs"
    std::string text_of(const PanelVerdict &verdict)
    {
      const Equivalence &e     = verdict.equivalence;
      const double       scale = verdict.relative ? 100 : 1;
      const std::string  unit  = verdict.relative ? " % of the grains' mean" : verdict.unit == "-" ? "" : " " + verdict.unit;
      std::ostringstream out;
      out.precision(3);
      out << verdict.quantity << ": " << coupling::text_of(e.verdict);
      if (e.n > 0)
        out << ": continuum - grains " << scale * e.difference.value << " [" << scale * e.difference.low << ", "
            << scale * e.difference.high << ']' << unit << ", margin " << scale * verdict.margin;
      out << ", " << e.n << " pairs";
      return out.str();
    }

    Scene scene_of_ensemble(const CommandLine &line)
    {
      for (const std::string &text : line.overrides)
        if (text.rfind("comparison/margin_", 0) != 0 && text.rfind("output/", 0) != 0)
          throw SceneError("--set " + text +
                           ": only comparison/margin_* and output/ can be changed without running the members again");
        else
          refuse_other_folder(text);
      Scene scene            = read_computed_scene(line.target + "/ensemble.prm", line.overrides);
      scene.output.directory = line.target;
      if (const std::string name = recorded_scene(line.target); !name.empty())
        scene.name = name;
      return scene;
    }
  } // namespace

  void refuse_other_folder(const std::string &override_text)
  {
    if (override_text.rfind("output/directory=", 0) == 0)
      throw SceneError("--set " + override_text + ": a comparison stands in the folder that it is of");
  }

  EnsembleRecord record_of(const Scene &scene, const std::vector<int> &seeds, const std::vector<MemberOutcome> &outcomes)
  {
    EnsembleRecord record;
    record.seeds              = seeds;
    std::vector<int> finished = seeds;
    const auto       drop     = [&finished](const int seed) {
      finished.erase(std::remove(finished.begin(), finished.end(), seed), finished.end());
    };
    for (const MemberOutcome &outcome : outcomes)
      if (outcome.interrupted)
        {
          record.interrupted.push_back(outcome.seed);
          drop(outcome.seed);
        }
      else if (outcome.exit_code != 0)
        {
          const std::string log = member_log(scene.output.directory, outcome.seed);
          record.failed.push_back({outcome.seed, outcome.exit_code, last_words(log)});
          drop(outcome.seed);
        }
    std::vector<Member> members;
    for (const int seed : finished)
      members.push_back(read_member(scene, seed));
    record.ensemble = evaluate(members, scene.comparison.margins);
    return record;
  }

  void write_record(const CommandLine &line, const Scene &scene, const EnsembleRecord &record, const PhaseTimer &timer)
  {
    const std::string &directory = scene.output.directory;
    check_member_histories(directory, record.ensemble.seeds);
    forget_files(directory, "ensemble");        // killed from here on, it leaves none that look changed
    remove_results(directory, {"report.html"}); // of other statistics, also where none is drawn
    write_ensemble_curves(directory, scene, record.ensemble.seeds);
    write_ensemble_json(directory, scene, record);
    write_ensemble_csv(directory, record.ensemble);
    record_phases(directory, {scene.name, record.seeds, line.text}, {timer.stop()});
    record_files(directory, "ensemble");
    for (const PanelVerdict &verdict : record.ensemble.verdicts)
      say(line, text_of(verdict));
  }

  int compare_ensemble_again(const CommandLine &line)
  {
    const Scene       scene = scene_of_ensemble(line);
    const PhaseTimer  timer("statistics");
    const std::string path = line.target + "/ensemble.json";
    check_files(line.target, "ensemble");
    const json                 earlier = read_record_file(path);
    std::vector<MemberOutcome> outcomes;
    const auto                 seeds = from_record(path, [&] {
      for (const json &failed : earlier.value("failed", json::array()))
        outcomes.push_back({failed.at("seed"), failed.at("exit_code")});
      for (const int seed : earlier.value("interrupted", std::vector<int>()))
        outcomes.push_back({seed, 0, true});
      return earlier.at("seeds").get<std::vector<int>>();
    });
    write_record(line, scene, record_of(scene, seeds, outcomes), timer);
    if (scene.output.report)
      draw_page(line, Drawing::ensemble, scene.output.directory);
    return done;
  }
} // namespace diptych::coupling
