// diptych: provenance.json: the origin of a result and its cost
// SPDX-License-Identifier: LGPL-2.1-or-later
#include "coupling/store/provenance.h"

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <stdexcept>
#include <thread>

#include <sys/resource.h>

#include "coupling/numbers/number_json.h"
#include "coupling/numbers/record_file.h"
#include "coupling/scene/identity.h"
#include "coupling/store/file_names.h"
#include "coupling/store/origin.h"
#include "discrete/files/text_file.h"

namespace diptych::coupling
{
  namespace
  {
    double seconds(const timeval &t)
    {
      return double(t.tv_sec) + 1e-6 * double(t.tv_usec);
    }

    rusage usage(const int who)
    {
      rusage result{};
      getrusage(who, &result);
      return result;
    }

    std::string cpu_name()
    {
      std::ifstream file("/proc/cpuinfo");
      for (std::string line; std::getline(file, line);)
        if (line.rfind("model name", 0) == 0)
          return line.substr(line.find(':') + 2);
      return "unknown";
    }

    std::string now_utc()
    {
      const std::time_t now = std::time(nullptr);
      char              text[32];
      std::strftime(text, sizeof text, "%Y-%m-%dT%H:%M:%SZ", std::gmtime(&now));
      return text;
    }

    using nlohmann::json;

    std::string path_of(const std::string &directory)
    {
      return directory + "/provenance.json";
    }

    // Every command writes these entries. A file without them belongs to another program.
    void demand_record_of_a_run(const std::string &path, const json &record)
    {
      const auto demand = [&](const char *key, const bool good) {
        if (!good)
          throw std::invalid_argument(path + ": is not a record of a run of diptych: '" + key + "' is missing or wrong");
      };
      const auto entry = [&](const char *key) { return record.value(key, json()); };
      demand("program", entry("program") == "diptych");
      for (const char *key : {"version", "command", "scene", "date"})
        demand(key, entry(key).is_string());
      for (const char *key : {"libraries", "host"})
        demand(key, entry(key).is_object());
      const json seeds = entry("seeds");
      demand("seeds",
             seeds.is_array() && std::all_of(seeds.begin(), seeds.end(), [](const json &s) { return s.is_number_integer(); }));
      demand("phases", entry("phases").is_array());
    }

    json read_record(const std::string &directory)
    {
      const std::string path = path_of(directory);
      if (!std::filesystem::exists(path))
        return json::object();
      json record = read_record_file(path);
      demand_record_of_a_run(path, record);
      return record;
    }

    void write_record(const std::string &directory, const json &record)
    {
      discrete::write_text(path_of(directory), record.dump(2) + "\n");
    }

    constexpr const char *panel_parts[] = {"discrete", "continuum", "continuum_coarse"};

    bool is_panel(const std::string &part)
    {
      return std::find(std::begin(panel_parts), std::end(panel_parts), part) != std::end(panel_parts);
    }

    std::string table_of(const std::string &directory, const std::string &part)
    {
      return part == "continuum_coarse" ? continuum_csv(coarse_folder(directory))
                                        : directory + "/" + part + (is_panel(part) ? ".csv" : ".json");
    }

    std::string snapshots_of(const std::string &directory, const std::string &part)
    {
      return std::filesystem::path(table_of(directory, part)).replace_extension(".h5").string();
    }

    void put_sums(const std::string &directory, const std::string &part, json &record)
    {
      NumbersToJson  sums{record[part + "_files"] = json::object(), 1};
      const FileSums files{sum_over(table_of(directory, part)), sum_over(snapshots_of(directory, part))};
      list_numbers(files, sums);
    }

    template <class Facts> void put_facts(const std::string &directory, const std::string &part, const Facts &facts)
    {
      json          record = read_record(directory);
      NumbersToJson writer{record[part] = json::object(), 1};
      list_numbers(facts, writer);
      put_sums(directory, part, record);
      write_record(directory, record);
    }

    // In the place of an earlier phase of the same name.
    void put_phase(json &record, const json &row)
    {
      json      &stored = record["phases"];
      const auto old    = std::find_if(stored.begin(), stored.end(), [&](const json &one) {
        return one.is_object() && one.value("name", json()) == row.at("name");
      });
      if (old != stored.end())
        *old = row;
      else
        stored.push_back(row);
    }

    template <class Facts> void get_facts(const json &record, const std::string &part, Facts &facts)
    {
      if (const auto found = record.find(part); found != record.end())
        {
          NumbersFromJson reader{*found};
          list_numbers(facts, reader);
        }
    }

    FileSums sums_of(const std::string &directory, const json &record, const std::string &part)
    {
      FileSums sums;
      from_record(path_of(directory), [&] { get_facts(record, part + "_files", sums); });
      return sums;
    }

    RunFacts run_facts_of(const json &record)
    {
      RunFacts facts;
      get_facts(record, "discrete", facts.discrete);
      get_facts(record, "continuum", facts.continuum);
      get_facts(record, "continuum_coarse", facts.continuum_coarse);
      get_facts(record, "discrete_files", facts.discrete_files);
      get_facts(record, "continuum_files", facts.continuum_files);
      get_facts(record, "continuum_coarse_files", facts.continuum_coarse_files);
      get_facts(record, "comparison_files", facts.comparison_files);
      get_facts(record, "ensemble_files", facts.ensemble_files);
      get_facts(record, "hashes", facts.hashes);
      for (const json &row : record.value("phases", json::array()).get<std::vector<json>>())
        {
          NumbersFromJson reader{row};
          list_numbers(facts.phases.emplace_back(), reader);
        }
      return facts;
    }
  } // namespace

  double cpu_seconds(const bool children)
  {
    const rusage self = usage(RUSAGE_SELF);
    double       sum  = seconds(self.ru_utime) + seconds(self.ru_stime);
    if (children)
      {
        const rusage others = usage(RUSAGE_CHILDREN);
        sum += seconds(others.ru_utime) + seconds(others.ru_stime);
      }
    return sum;
  }

  PhaseTimer::PhaseTimer(std::string name)
      : name(std::move(name)),
        wall(std::chrono::steady_clock::now()),
        cpu(cpu_seconds(true))
  {}

  PhaseCost PhaseTimer::stop() const
  {
    return {name, std::chrono::duration<double>(std::chrono::steady_clock::now() - wall).count(), cpu_seconds(true) - cpu,
            double(usage(RUSAGE_SELF).ru_maxrss) / 1024};
  }

  std::string sum_over(const std::string &file)
  {
    std::error_code none;
    if (!std::filesystem::is_regular_file(file, none))
      return {};
    std::ifstream     in(file, std::ios::binary);
    std::vector<char> piece(1 << 20);
    std::uint64_t     sum = empty_digest;
    while (in.read(piece.data(), std::streamsize(piece.size())), in.gcount() > 0)
      sum = digest_on(sum, {piece.data(), std::size_t(in.gcount())});
    return hexadecimal(sum);
  }

  void forget_fact(const std::string &directory, const std::string &part)
  {
    json record = read_record(directory);
    if (record.erase(part) + record.erase(part + "_files") > 0)
      write_record(directory, record);
  }

  void forget_files(const std::string &directory, const std::string &part)
  {
    json record = read_record(directory);
    if (record.erase(part + "_files") > 0)
      write_record(directory, record);
  }

  void record_files(const std::string &directory, const std::string &part)
  {
    json record = read_record(directory);
    put_sums(directory, part, record);
    write_record(directory, record);
  }

  void check_scene_file(const std::string &directory)
  {
    const std::string recorded = read_run_facts(directory).hashes.text, file = scene_prm(directory);
    if (!recorded.empty() && sum_over(file) != recorded)
      throw std::invalid_argument(file + " was changed after the run had written it (checksum in provenance.json); keys of " +
                                  "comparison/ are changed with diptych compare --set");
  }

  void check_files(const std::string &directory, const std::string &part)
  {
    const json record = read_record(directory);
    const auto check  = [](const std::string &file, const std::string &recorded) {
      if (recorded.empty())
        return;
      const std::string found = sum_over(file);
      if (found != recorded)
        throw std::invalid_argument(file + (found.empty() ? " is missing" : " was changed after the run had written it") +
                                     " (checksum in provenance.json)");
    };
    const auto check_part = [&](const std::string &one) {
      const FileSums sums = sums_of(directory, record, one);
      check(table_of(directory, one), sums.table);
      check(snapshots_of(directory, one), sums.snapshots);
    };
    if (!part.empty())
      return check_part(part);
    check_scene_file(directory);
    for (const char *one : panel_parts)
      check_part(one);
  }

  void record_phases(const std::string &directory, const RunOrigin &origin, const std::vector<PhaseCost> &phases)
  {
    json          record = read_record(directory);
    NumbersToJson into{record, 1};
    Origin        written;
    written.command = origin.command;
    written.scene   = origin.scene;
    written.seeds   = origin.seeds;
    written.date    = now_utc();
    written.cpu     = cpu_name();
    written.cores   = std::thread::hardware_concurrency();
    list_numbers(written, into);
    if (record["phases"].is_null())
      record["phases"] = json::array();
    for (const PhaseCost &phase : phases)
      {
        json          row = json::object();
        NumbersToJson writer{row, 1};
        list_numbers(phase, writer);
        put_phase(record, row);
      }
    write_record(directory, record);
  }

  PhaseCost with_earlier_sessions(const std::string &directory, PhaseCost cost)
  {
    for (const PhaseCost &earlier : read_run_facts(directory).phases)
      if (earlier.name == cost.name)
        {
          cost.wall_s += earlier.wall_s;
          cost.cpu_s += earlier.cpu_s;
          cost.peak_memory_mb = std::max(cost.peak_memory_mb, earlier.peak_memory_mb);
        }
    return cost;
  }

  void record_facts(const std::string &directory, const discrete::Report &report)
  {
    put_facts(directory, "discrete", report);
  }

  void record_facts(const std::string &directory, const std::string &part, const continuum::Report &report)
  {
    put_facts(directory, part, report);
  }

  void record_scene(const std::string &directory, const RunOrigin &origin, const SceneHashes &hashes)
  {
    record_phases(directory, origin, {});
    json          record = read_record(directory);
    NumbersToJson writer{record["hashes"] = json::object(), 1};
    list_numbers(hashes, writer);
    write_record(directory, record);
  }

  void complete_record(const std::string &directory, const std::string &next)
  {
    const json earlier = read_record(directory), added = read_record(next);
    json       record = earlier;
    for (const char *entry : {"comparison_files", "phases"})
      record.erase(entry);
    if (added.contains("continuum"))
      for (const char *entry : {"continuum", "continuum_files", "continuum_coarse", "continuum_coarse_files"})
        record.erase(entry);
    record.update(added);
    for (const char *entry : {"discrete", "discrete_files"})
      if (earlier.contains(entry))
        record[entry] = earlier[entry];
    record["phases"] = json::array();
    for (const json &phase : earlier.value("phases", json::array()))
      if (phase.value("name", "") != report_phase)
        put_phase(record, phase);
    for (const json &phase : added.at("phases"))
      put_phase(record, phase);
    write_record(next, record);
  }

  void copy_record(const std::string &from, const std::string &to)
  {
    write_record(to, read_record(from));
  }

  bool has_report(const RunFacts &facts)
  {
    return std::any_of(facts.phases.begin(), facts.phases.end(), [](const PhaseCost &p) { return p.name == report_phase; });
  }

  RunFacts read_run_facts(const std::string &directory)
  {
    const json record = read_record(directory);
    return from_record(path_of(directory), [&] { return run_facts_of(record); });
  }

  std::string recorded_scene(const std::string &directory)
  {
    const json record = read_record(directory);
    return from_record(path_of(directory), [&] { return record.value("scene", ""); });
  }
} // namespace diptych::coupling
