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

  constexpr const char *report_phase = "report";

  // Command, scene and seeds that produced the results of a folder.
  struct RunOrigin
  {
    std::string      scene; // name of the scene
    std::vector<int> seeds; // seeds of its samples
    std::string      command;
  };

  // Adds phases to provenance.json. Replaces a phase of the same name and keeps all other entries. Throws std::runtime_error if
  // the file cannot be written, std::invalid_argument if it is damaged.
  void record_phases(const std::string &directory, const RunOrigin &origin, const std::vector<PhaseCost> &phases);
  // The cost of a phase that goes on from a checkpoint, with that of its earlier sessions in provenance.json.
  PhaseCost with_earlier_sessions(const std::string &directory, PhaseCost cost);

  // Records the facts of one part ("discrete", "continuum" or "continuum_coarse") and the checksums of its files.
  void record_facts(const std::string &directory, const discrete::Report &report);
  void record_facts(const std::string &directory, const std::string &part, const continuum::Report &report);

  // Checksum of a file's bytes (FNV-1a, 64 bits, hexadecimal); empty if there is no file.
  std::string sum_over(const std::string &file);

  // Records the checksums of a part's files. The files of "comparison" and "ensemble" are a .json and a .h5 file.
  void record_files(const std::string &directory, const std::string &part);

  // Records the scene of the folder's results and its hashes, which later commands compare.
  void record_scene(const std::string &directory, const RunOrigin &origin, const SceneHashes &hashes);

  // Copies the facts of the parts that the folder `next` lacks from the record of `directory`, except comparison and report.
  void complete_record(const std::string &directory, const std::string &next);

  // Writes the record of the folder `from` to the folder `to`.
  void copy_record(const std::string &from, const std::string &to);

  bool has_report(const RunFacts &facts); // true if they record that the report was drawn

  // Removes the facts and checksums of a part, or its checksums only, before the part is computed again.
  void forget_fact(const std::string &directory, const std::string &part);
  void forget_files(const std::string &directory, const std::string &part);

  // Throws std::invalid_argument if scene.prm has changed since a run wrote it.
  void check_scene_file(const std::string &directory);

  // Throws std::invalid_argument with the name of a file that is missing or has changed since its checksum was recorded. An empty
  // `part` checks scene.prm and both panels.
  void check_files(const std::string &directory, const std::string &part = "");

  // Facts that are not recorded keep their defaults. Throws std::invalid_argument if provenance.json does not describe a run.
  RunFacts    read_run_facts(const std::string &directory);
  std::string recorded_scene(const std::string &directory); // name of the scene; empty if none is recorded
} // namespace diptych::coupling
