// diptych: provenance.json: the origin of a result and its cost
// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <chrono>
#include <string>
#include <vector>

#include "coupling/store/facts.h"

namespace diptych::coupling
{
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

  // CPU seconds of all threads of the process; `children` adds those of its child processes (the report).
  double cpu_seconds(bool children = false);

  // The command that wrote results, and the scene that they are of.
  struct RunOrigin
  {
    std::string      scene; // its name
    std::vector<int> seeds; // of its samples
    std::string      command;
  };

  // Adds phases to provenance.json; a phase of the same name is replaced, other entries stay. Throws std::runtime_error if the
  // file cannot be written, std::invalid_argument if it is damaged.
  void record_phases(const std::string &directory, const RunOrigin &origin, const std::vector<PhaseCost> &phases);

  // The facts of one part, "discrete", "continuum" or "continuum_coarse", and the checksums of its files.
  void record_facts(const std::string &directory, const DiscreteFacts &facts);
  void record_facts(const std::string &directory, const std::string &part, const ContinuumFacts &facts);

  // Checksum of a file's bytes (FNV-1a, 64 bits, hexadecimal); empty where there is no file.
  std::string sum_over(const std::string &file);

  // The checksums of a part's files: "comparison" has comparison.json and .h5, "ensemble" likewise.
  void record_files(const std::string &directory, const std::string &part);

  // The scene that the folder's results are of, and the hashes by which it is recognised.
  void record_scene(const std::string &directory, const RunOrigin &origin, const SceneHashes &hashes);

  // Facts, checksums, hashes and phases of the continuum in the folder `from` take the place of those recorded in `directory`.
  void take_continuum_facts(const std::string &directory, const std::string &from);

  // Removes the facts and checksums of a part, or its checksums only, before the part is computed again.
  void forget_fact(const std::string &directory, const std::string &part);
  void forget_files(const std::string &directory, const std::string &part);

  // Throws std::invalid_argument naming a file that is missing or has changed since its checksum was recorded. `part` empty: both
  // panels.
  void check_files(const std::string &directory, const std::string &part = "");

  // Facts that are not recorded keep their defaults. Throws std::invalid_argument where provenance.json is not a run's record.
  RunFacts    read_run_facts(const std::string &directory);
  std::string recorded_scene(const std::string &directory); // its name; empty where there is none
} // namespace diptych::coupling
