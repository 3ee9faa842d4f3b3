// diptych: where a result comes from and what it cost
// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <chrono>
#include <ctime>
#include <string>
#include <vector>

#include <nlohmann/json_fwd.hpp>

#include "coupling/scene.h"

namespace diptych::coupling
{
  // Cost of one phase of a run. Memory is the peak of the whole process so far [MB].
  struct PhaseCost
  {
    std::string name;
    double      wall_s = 0, cpu_s = 0, peak_memory_mb = 0;
  };

  class PhaseTimer
  {
  public:
    explicit PhaseTimer(std::string name);
    PhaseCost stop() const;

  private:
    std::string                           name;
    std::chrono::steady_clock::time_point wall;
    double                                cpu;
  };

  // CPU seconds of the process, all threads; children (the report) only with `children`.
  double cpu_seconds(bool children = false);

  // provenance.json of the result folder, merged: phases of the same name are replaced, other members kept, so that each
  // command adds its own. `facts` is merged in at the top level ("discrete", "continuum").
  void update_provenance(const std::string            &directory,
                         const Scene                  &scene,
                         const std::string            &command,
                         const std::vector<PhaseCost> &phases,
                         const nlohmann::json         &facts);

  // Takes a fact of an earlier run away, before a new one makes it untrue.
  void forget_fact(const std::string &directory, const std::string &name);

  nlohmann::json read_provenance(const std::string &directory); // empty object where there is none
} // namespace diptych::coupling
