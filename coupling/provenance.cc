// diptych: where a result comes from and what it cost
// SPDX-License-Identifier: LGPL-2.1-or-later
#include "coupling/provenance.h"

#include <fstream>
#include <thread>

#include <sys/resource.h>

#include <nlohmann/json.hpp>

#include "coupling/version.h"
#include "discrete/text_file.h"

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

  nlohmann::json read_provenance(const std::string &directory)
  {
    std::ifstream file(directory + "/provenance.json");
    return file ? nlohmann::json::parse(file) : nlohmann::json::object();
  }

  void forget_fact(const std::string &directory, const std::string &name)
  {
    nlohmann::json record = read_provenance(directory);
    if (record.erase(name) > 0)
      discrete::write_text(directory + "/provenance.json", record.dump(2) + "\n");
  }

  void update_provenance(const std::string            &directory,
                         const Scene                  &scene,
                         const std::string            &command,
                         const std::vector<PhaseCost> &phases,
                         const nlohmann::json         &facts)
  {
    nlohmann::json record  = read_provenance(directory);
    record["program"]      = "diptych";
    record["version"]      = version;
    record["git_revision"] = git_revision;
    record["libraries"]    = {{"deal.II", deal_ii_version}, {"Trilinos", trilinos_version}, {"Eigen", eigen_version},
                              {"HDF5", hdf5_version},       {"compiler", compiler_version}, {"build", build_type}};
    record["command"]      = command;
    record["scene"]        = scene.name;
    record["seed"]         = scene.sample.seed;
    record["host"]         = {{"cpu", cpu_name()}, {"cores", std::thread::hardware_concurrency()}};
    record["date"]         = now_utc();
    nlohmann::json &stored = record["phases"];
    if (!stored.is_array())
      stored = nlohmann::json::array();
    for (const PhaseCost &phase : phases)
      {
        const nlohmann::json row = {
          {"name", phase.name}, {"wall_s", phase.wall_s}, {"cpu_s", phase.cpu_s}, {"peak_memory_mb", phase.peak_memory_mb}};
        bool replaced = false;
        for (nlohmann::json &old : stored)
          if (old["name"] == phase.name)
            old = row, replaced = true;
        if (!replaced)
          stored.push_back(row);
      }
    record.update(facts);
    discrete::write_text(directory + "/provenance.json", record.dump(2) + "\n");
  }
} // namespace diptych::coupling
