// diptych: what keys and results mean
// SPDX-License-Identifier: LGPL-2.1-or-later
#include "coupling/program/explain_command.h"

#include <algorithm>
#include <cctype>
#include <iostream>

#include <nlohmann/json.hpp>

#include "coupling/numbers/record_file.h"
#include "coupling/program/python_package.h"
#include "coupling/program/result_entries.h"
#include "coupling/scene/keys.h"
#include "coupling/scene/scene_error.h"
#include "coupling/scene/scene_file.h"
#include "coupling/store/origin.h"
#include "discrete/panel/history.h"
#include "discrete/snapshot_fields.h"

namespace diptych::coupling
{
  namespace
  {
    // Compares small letters with small letters.
    bool contains(const std::string &text, const std::string &word)
    {
      const auto same = [](const unsigned char a, const unsigned char b) { return std::tolower(a) == std::tolower(b); };
      return std::search(text.begin(), text.end(), word.begin(), word.end(), same) != text.end();
    }

    nlohmann::ordered_json schema(const std::vector<std::function<ResultList()>> &lists)
    {
      using Json   = nlohmann::ordered_json;
      Json keys    = Json::array();
      Json results = Json::array();
      for (const KeyDescription &key : described_keys(""))
        keys.push_back(Json{{"section", key.section},
                            {"key", key.name},
                            {"default", key.value},
                            {"unit", key.unit},
                            {"allowed", key.allowed},
                            {"meaning", key.meaning}});
      for (const auto &list : lists)
        for (const ResultEntry &entry : list())
          results.push_back(Json{{"file", entry.file},
                                 {"entry", entry.name},
                                 {"shape", entry.shape},
                                 {"unit", entry.unit.empty() ? "-" : entry.unit},
                                 {"meaning", entry.meaning}});
      return Json{{"keys", keys}, {"results", results}};
    }
  } // namespace

  ResultList discrete_result_entries()
  {
    using namespace discrete;
    ResultList result;
    add_columns<discrete::HistoryRow>("discrete.csv", result);
    result.push_back({"discrete.h5", "stages", "attribute, whole number", "-", "number of groups stage_NNNN"});
    const std::string  h5 = "discrete.h5, group stage_NNNN";
    discrete::Snapshot s;
    const auto         add = [&](const std::string &name, const auto &values, const char *unit, const char *meaning) {
      using Value = typename std::decay_t<decltype(values)>::value_type;
      result.push_back({h5, name, array_shape<Value>(), unit, meaning});
    };
    visit_attributes(s, [&](const char *name, const auto &value, const char *unit, const char *meaning) {
      result.push_back({h5, name, "attribute, " + value_shape(value), unit, meaning});
    });
    visit_grain_fields(s, add);
    visit_contact_lists(s, [&](const std::string &list, const auto &, const char *, const char *meaning) {
      result.push_back({h5, list, "group", "", meaning});
      result.push_back({h5, list + "/body", "pairs of whole numbers", "-", contact_bodies});
      ContactForce prototype{};
      visit_contact_fields(prototype, [&](const std::string &name, const auto &value, const char *unit, const char *what) {
        result.push_back({h5, list + "/" + name, array_shape<std::decay_t<decltype(value)>>(), unit, what});
      });
    });
    result.push_back({h5, "contacts/impulse", "pairs of numbers", "pressure length time", contact_impulses});
    visit_contact_values(s, add);
    visit_outline(s, add);
    add_record("provenance.json", ProvenanceDocument{Origin(), RunFacts()}, result);
    result.push_back({h5, "not_told", "attribute, name", "-",
                      "arrays that are missing here because the files of another code did not hold them (imported)"});
    result.push_back({"checkpoint.h5, continuum_checkpoint.h5", "/", "group", "",
                      "state from which --resume continues; its layout changes with the program"});
    return result;
  }

  ResultList python_result_entries()
  {
    const std::string    path   = python_package() + "/diptych/result_entries.json"; // the build wrote it
    const nlohmann::json record = read_record_file(path);
    return from_record(path, [&] {
      ResultList result;
      for (const nlohmann::json &one : record.at("results"))
        result.push_back({one.at("file"), one.at("entry"), one.at("shape"), one.at("unit"), one.at("meaning")});
      return result;
    });
  }

  int explain(const CommandLine &line, const std::vector<std::function<ResultList()>> &lists)
  {
    if (line.prints_json)
      {
        std::cout << schema(lists).dump(1) << '\n';
        return done;
      }
    if (line.target != "results")
      {
        if (!line.word.empty())
          throw SceneError("explain " + line.target + " " + line.word +
                           ": a second word is only for results, as in "
                           "`diptych explain results angle`");
        std::cout << explain(line.target);
        return done;
      }
    std::string file;
    for (const auto &list : lists)
      for (const ResultEntry &entry : list())
        {
          if (!contains(entry.file + "\n" + entry.name + "\n" + entry.meaning, line.word))
            continue;
          if (entry.file != file)
            std::cout << (file.empty() ? "" : "\n") << entry.file << '\n';
          file = entry.file;
          std::cout << "  " << entry.name << "  [" << (entry.unit.empty() ? "-" : entry.unit) << "]  " << entry.shape
                    << "\n      " << entry.meaning << '\n';
        }
    if (file.empty())
      throw SceneError("explain results " + line.word +
                       ": no file, name or meaning contains this word; `diptych explain "
                       "results` prints all");
    return done;
  }
} // namespace diptych::coupling
