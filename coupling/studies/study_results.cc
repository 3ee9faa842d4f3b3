// diptych: results of one run of a study, read from its folder
// SPDX-License-Identifier: LGPL-2.1-or-later
#include "coupling/studies/study_results.h"

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <limits>
#include <map>

#include <nlohmann/json.hpp>

#include "continuum/history.h"
#include "continuum/laws/material_point_row.h"
#include "coupling/ensembles/ensemble.h"
#include "coupling/numbers/record_file.h"
#include "coupling/processes/worker.h"
#include "coupling/store/file_names.h"
#include "coupling/store/provenance.h"
#include "discrete/files/table_file.h"
#include "discrete/panel/history.h"

namespace diptych::coupling
{
  namespace
  {
    constexpr double no_value = std::numeric_limits<double>::quiet_NaN();

    template <class Row> HistoryTable table_of(const std::string &file)
    {
      return std::filesystem::exists(file) ? history_table(discrete::read_rows<Row>(file)) : HistoryTable();
    }

    // Tables and numbers of one result folder, each read once.
    class Folder
    {
    public:
      Folder(std::string path, const Scene &scene)
          : path(std::move(path)),
            scene(scene)
      {}

      const HistoryTable &table(const Source source)
      {
        const auto [found, is_new] = tables.emplace(source, HistoryTable());
        if (is_new)
          found->second = panel_table(path, source);
        return found->second;
      }

      double number(const std::string &name)
      {
        if (!member)
          {
            member = member_of(read_record_file(comparison_json(path)));
            if (is_mirror_symmetric(scene))
              fold(*member);
          }
        for (const MemberNumber &one : member->numbers)
          if (one.name == name)
            return one.value;
        return no_value;
      }

    private:
      std::string                    path;
      const Scene                   &scene;
      std::map<Source, HistoryTable> tables;
      std::optional<Member>          member;
    };

    bool reaches(const HistoryTable &table, const double progress)
    {
      const auto found = table.find("progress");
      return found != table.end() && !found->second.empty() && !is_beyond(progress, found->second.back());
    }

    double value_of(const StudyQuantity &quantity, Folder &folder)
    {
      if (quantity.reduction == Reduction::number)
        return folder.number(quantity.column);
      const HistoryTable &table = folder.table(quantity.source);
      if (table.empty() || table.at("progress").empty())
        return no_value;
      switch (quantity.reduction)
        {
        case Reduction::strength:
          return reaches(table, quantity.to) ? ratio_of_means(table, quantity.from, quantity.to) : no_value;
        case Reduction::mean:
          return reaches(table, quantity.to) ? mean_over_progress(table, quantity.column, quantity.from, quantity.to) : no_value;
        case Reduction::at:
          return reaches(table, quantity.from) ? mean_over_progress(table, quantity.column, quantity.from, quantity.from)
                                               : no_value;
        case Reduction::peak:
          return peak_of_running_mean(table, quantity.column, quantity.to).value;
        case Reduction::largest:
          return *std::max_element(table.at(quantity.column).begin(), table.at(quantity.column).end());
        default:
          return table.at(quantity.column).back();
        }
    }

    // Removes the study's folder, so that messages do not depend on where the study is.
    std::string without(const std::string &directory, std::string words)
    {
      const std::string name = directory + "/";
      for (std::size_t at = words.find(name); at != std::string::npos; at = words.find(name))
        words.erase(at, name.size());
      return words;
    }

    void add_effort(Folder &folder, RunResult &result)
    {
      if (const HistoryTable &grains = folder.table(Source::discrete); !grains.empty())
        {
          result.sweeps = 0;
          for (const double sweeps : grains.at("sweeps"))
            result.sweeps += sweeps;
        }
      if (const HistoryTable &continuum = folder.table(Source::continuum); !continuum.empty() && !continuum.at("step").empty())
        {
          result.newton_iterations = continuum.at("newton_iterations").back();
          result.cut_backs         = continuum.at("cut_backs").back();
        }
    }
  } // namespace

  HistoryTable panel_table(const std::string &folder, const Source source)
  {
    switch (source)
      {
      case Source::discrete:
        return table_of<discrete::HistoryRow>(discrete_csv(folder));
      case Source::continuum:
        return table_of<continuum::HistoryRow>(continuum_csv(folder));
        case Source::material_point: {
          HistoryTable table = table_of<continuum::MaterialPointRow>(material_point_csv(folder));
          if (!table.empty()) // the loading variable of a point is its axial strain
            table["progress"] = table["axial_strain"];
          return table;
        }
      default:
        return {};
      }
  }

  RunResult result_of(const std::string &directory, const Study &study, const StudyRun &run)
  {
    RunResult result;
    result.values.assign(study.quantities.size(), no_value);
    if (!run.scene)
      {
        result.is_known = result.is_refused = true;
        result.exit_code                    = 2;
        result.words                        = run.refusal;
        return result;
      }
    const std::optional<RunEnd> end = found_end(directory, run);
    if (!end)
      return result;
    result.is_known   = true;
    result.exit_code  = end->exit_code;
    result.is_refused = end->exit_code == 2;
    result.load       = end->load;
    result.at_once    = end->at_once;
    if (result.exit_code != 0)
      result.words = without(directory, last_words(run_log(directory, run)));
    const std::string path = run_folder(directory, run);
    if (!std::filesystem::exists(path))
      return result;
    const RunFacts facts = read_run_facts(path);
    result.phases        = facts.phases;
    result.halved_steps  = facts.discrete.halved_steps;
    result.warned        = !facts.discrete.warnings.empty();
    Folder folder(path, *run.scene);
    add_effort(folder, result);
    if (result.exit_code == 0)
      for (std::size_t k = 0; k < study.quantities.size(); ++k)
        result.values[k] = value_of(study.quantities[k], folder);
    return result;
  }
} // namespace diptych::coupling
