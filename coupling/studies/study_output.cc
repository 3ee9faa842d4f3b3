// diptych: result files of a study
// SPDX-License-Identifier: LGPL-2.1-or-later
#include "coupling/studies/study_output.h"

#include <algorithm>
#include <cmath>
#include <set>
#include <sstream>

#include "coupling/cells/principal_axes.h"
#include "coupling/numbers/number_json.h"
#include "coupling/scene/keys.h"
#include "coupling/studies/study_numbers.h"
#include "coupling/version.h"
#include "discrete/files/text_file.h"
#include "discrete/files/words.h"

namespace diptych::coupling
{
  namespace
  {
    // A cell of a table, quoted if it contains a separator.
    std::string cell(std::string text)
    {
      if (text.find_first_of(",\"\n") == std::string::npos)
        return text;
      for (std::size_t at = text.find('"'); at != std::string::npos; at = text.find('"', at + 2))
        text.insert(at, 1, '"');
      return '"' + text + '"';
    }

    std::string cell(const double value)
    {
      return std::isfinite(value) ? text_of(value) : "";
    }

    std::set<std::string> phases_of(const StudyResults &results)
    {
      std::set<std::string> names;
      for (const std::vector<RunResult> &runs : results)
        for (const RunResult &run : runs)
          for (const PhaseCost &phase : run.phases)
            names.insert(phase.name);
      return names;
    }

    double difference(const StudyQuantity &quantity, const double value, const double reference)
    {
      if (quantity.is_relative)
        return value / reference - 1;
      return quantity.is_line ? line_turn(value, reference) : value - reference;
    }

    void add_line(const StudyTables &t, const std::size_t point, const std::size_t sample, std::vector<std::string> &line)
    {
      const ScenePoint  &of     = t.points[point];
      const PointRecord &record = t.record.points[point];
      const RunResult   &run    = t.results[point][sample];
      double             memory = NAN;
      for (const PhaseCost &phase : run.phases)
        memory = std::fmax(memory, phase.peak_memory_mb);
      line = {std::to_string(point),
              cell(of.family < 0 ? "reference" : t.study.families[std::size_t(of.family)].name),
              cell(discrete::joined(of.settings, "; ")),
              t.study.seeds.empty() ? "" : std::to_string(t.study.seeds[sample]),
              cell(discrete::name_of(record.kind)),
              run.is_known ? std::to_string(run.exit_code) : "",
              std::to_string(run.halved_steps),
              cell(run.cut_backs),
              cell(run.sweeps),
              cell(run.newton_iterations),
              cell(memory),
              "runs/" + of.runs[sample].name};
      for (std::size_t q = 0; q < t.study.quantities.size(); ++q)
        {
          line.push_back(cell(run.values[q]));
          line.push_back(cell(difference(t.study.quantities[q], run.values[q], t.results[of.reference][sample].values[q])));
        }
      for (const std::string &name : phases_of(t.results))
        {
          const auto found = std::find_if(run.phases.begin(), run.phases.end(),
                                          [&](const PhaseCost &p) { return p.name == name; });
          line.push_back(found == run.phases.end() ? "" : cell(found->cpu_s));
        }
    }
  } // namespace

  void write_study_json(const std::string &directory, const StudyTables &tables)
  {
    nlohmann::json plain = nlohmann::json::object();
    NumbersToJson  writer{plain, 1};
    list_numbers(StudyDocument{tables.study, tables.points, tables.record, git_revision}, writer);
    discrete::write_text(directory + "/study.json", plain.dump(1) + "\n");
  }

  void write_study_csv(const std::string &directory, const StudyTables &tables)
  {
    std::ostringstream out;
    out << header_of(study_columns());
    for (const StudyQuantity &quantity : tables.study.quantities)
      out << ',' << cell(quantity.name) << ',' << cell("error of " + quantity.name);
    for (const std::string &phase : phases_of(tables.results))
      out << ",cpu_s of " << phase;
    out << '\n';
    std::vector<std::string> line;
    for (std::size_t point = 0; point < tables.points.size(); ++point)
      for (std::size_t sample = 0; sample < tables.results[point].size(); ++sample)
        {
          add_line(tables, point, sample, line);
          for (std::size_t k = 0; k < line.size(); ++k)
            out << (k > 0 ? "," : "") << line[k];
          out << '\n';
        }
    discrete::write_text(directory + "/study.csv", out.str());
  }

  void write_study_cost(const std::string &directory, const StudyCost &cost)
  {
    nlohmann::json root = nlohmann::json::object();
    NumbersToJson  writer{root, 1};
    list_numbers(cost, writer);
    discrete::write_text(directory + "/study_cost.json", root.dump(1) + "\n");
  }
} // namespace diptych::coupling
