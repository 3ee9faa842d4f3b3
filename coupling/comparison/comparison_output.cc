// diptych: writes a comparison to files
// SPDX-License-Identifier: LGPL-2.1-or-later
#include "coupling/comparison/comparison_output.h"

#include <charconv>
#include <cmath>
#include <map>
#include <sstream>

#include "coupling/comparison/comparison_numbers.h"
#include "coupling/comparison/comparison_schema.h"
#include "coupling/numbers/number_json.h"
#include "coupling/store/file_names.h"
#include "discrete/files/text_file.h"

namespace diptych::coupling
{
  namespace
  {
    using nlohmann::json;

    json descriptions()
    {
      json result = json::object();
      for (const NumberDescription &number : comparison_schema())
        result[number.place] = {
          {"shape", number.shape}, {"unit", number.unit}, {"meaning", number.meaning}, {"kind", discrete::name_of(number.kind)}};
      return result;
    }

    // The start and the stages as the scene gives them: without the rounding error of a multiple of the interval.
    std::vector<double> requested_stages(std::vector<double> requested)
    {
      for (double &stage : requested)
        {
          char              text[32];
          const char *const end = std::to_chars(text, text + sizeof text, stage, std::chars_format::general, 15).ptr;
          std::from_chars(text, end, stage);
        }
      requested.insert(requested.begin(), 0.);
      return requested;
    }

    // Collects one line of the .csv for every known number of a JSON value. An interval and its ends share one line.
    class CsvLines
    {
    public:
      explicit CsvLines(const std::vector<double> &stages)
          : stages(requested_stages(stages))
      {
        for (const NumberDescription &number : comparison_schema())
          units[number.place] = number.unit;
        out << header_of(comparison_columns()) << '\n';
      }

      // `line`: the first columns of the line; `place`: place of the value in the list of numbers.
      void add(const json &value, const std::string &line, const std::string &place, const std::string &quantity)
      {
        if (value.is_object() && value.contains("value") && value.contains("low"))
          write(line, quantity, text(value["value"]) + ',' + text(value["low"]) + ',' + text(value["high"]), place);
        else if (known(value))
          write(line, quantity, text(value) + ",,", place);
        else if (value.is_structured())
          for (const auto &[key, part] : value.items())
            {
              const bool  list = value.is_array();
              std::string name = list && part.is_object() && part.contains("name") ? part["name"].get<std::string>() : key;
              if (list && name == key)
                name = std::to_string(std::stoi(key) + 1);
              add(part, line, list ? place : place + "/" + key, quantity.empty() ? name : quantity + "/" + name);
            }
      }

      void add_increments(const json &increments, const std::string &place, const std::string &prefix)
      {
        for (const json &increment : increments)
          {
            const json from = increment.contains("from") ? increment["from"] : json(),
                       to   = increment.contains("to") ? increment["to"] : increment["progress"];
            for (const auto &[panel, part] : increment.items())
              if (part.is_structured())
                add(part, progress(from) + ',' + progress(to) + ',' + prefix + panel + ',', place + "/" + panel, "");
          }
      }

      std::string finished() const { return out.str(); }

    private:
      static bool        known(const json &v) { return v.is_number() && std::isfinite(v.get<double>()); }
      static std::string text(const json &v) { return known(v) ? v.dump() : std::string(); }

      std::string progress(const json &reached) const
      {
        for (const double stage : stages)
          if (reached.is_number() && std::abs(reached.get<double>() - stage) <= 1e-6 * stage)
            return json(stage).dump();
        return reached.dump();
      }

      void write(const std::string &line, const std::string &quantity, const std::string &numbers, const std::string &place)
      {
        const auto unit = units.find(place);
        out << line << quantity << ',' << numbers << ',' << (unit == units.end() ? "" : unit->second) << '\n';
      }

      std::vector<double>                stages;
      std::ostringstream                 out;
      std::map<std::string, std::string> units; // by place
    };

    std::string table_of(const std::vector<double> &stages, const json &comparison)
    {
      CsvLines lines(stages);
      lines.add_increments(comparison["stages"], "stages", "");
      lines.add_increments(comparison["windows"], "windows", "");
      if (const json &coarse = comparison["continuum_coarse"]; coarse.is_object())
        lines.add_increments(coarse["windows"], "continuum_coarse/windows", "coarse_");
      for (const char *part : {"discrete_summary", "continuum_summary", "resolution_study", "theory", "cost"})
        lines.add(comparison[part], std::string(",,") + part + ',', part, "");
      return lines.finished();
    }
  } // namespace

  NumberSchema comparison_schema()
  {
    static const NumberSchema schema = [] {
      NumberSchema             result;
      const Scene              scene;
      const Comparison         comparison;
      CollectNumbers           collector{result, ""};
      const ComparisonDocument document{scene, comparison};
      list_numbers(document, collector);
      return result;
    }();
    return schema;
  }

  void write_comparison(const std::string &directory, const ComparisonDocument &document)
  {
    json          root = json::object();
    NumbersToJson writer{root, document.scene.sample.mean_diameter};
    list_numbers(document, writer);
    root["numbers"] = descriptions();
    discrete::write_text(comparison_json(directory), root.dump(1) + "\n");
    discrete::write_text(summary_csv(directory),
                         csv_of(key_numbers(document.comparison),
                                checks_of(document.scene.discrete, document.scene.comparison, document.comparison)));
    discrete::write_text(comparison_csv(directory), table_of(stages(document.scene.loading), root));
  }
} // namespace diptych::coupling
