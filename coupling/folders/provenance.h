// diptych: where a result comes from and what it cost
// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <chrono>
#include <string>
#include <vector>

#include "coupling/folders/facts.h"
#include "coupling/scene/scene.h"

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

  // CPU seconds of the process, all threads; children (the report) only with `children`.
  double cpu_seconds(bool children = false);

  // provenance.json of the result folder, merged: phases of the same name are replaced, other members kept, so that each
  // command adds its own. Throws std::runtime_error where it cannot be written, std::invalid_argument where what stands there is
  // broken. `seeds`: of the samples; that of the scene where none are given.
  void record_phases(const std::string            &directory,
                     const Scene                  &scene,
                     const std::string            &command,
                     const std::vector<PhaseCost> &phases);
  void record_phases(const std::string            &directory,
                     const Scene                  &scene,
                     const std::string            &command,
                     const std::vector<PhaseCost> &phases,
                     const std::vector<int>       &seeds);

  // The facts of one part, "discrete", "continuum" or "continuum_coarse", and the sums of its files as they now are.
  void record_facts(const std::string &directory, const DiscreteFacts &facts);
  void record_facts(const std::string &directory, const std::string &part, const ContinuumFacts &facts);

  // Over the bytes of a file (FNV-1a of 64 bits, hexadecimal); empty where there is none.
  std::string sum_over(const std::string &file);

  // The sums of a part's files as they now are: comparison.json and .h5 of the part "comparison", those of "ensemble".
  void record_files(const std::string &directory, const std::string &part);

  // The text that this process has just written to scene.prm: its sum, the part "echo", is recorded with every phase from now on,
  // whatever stands there by then.
  void remember_echo(const std::string &directory, const std::string &text);

  // Takes the facts of a part of an earlier run away, before a new one makes them untrue; or the sums of its files alone, which
  // an interrupted run that goes on is about to change.
  void forget_fact(const std::string &directory, const std::string &part);
  void forget_files(const std::string &directory, const std::string &part);

  // Throws std::invalid_argument naming the file where one of those whose sums are recorded is missing, or is not what the run
  // left: a number was changed, a row is gone, it is another run's. `part` empty: of both panels and their echo.
  void check_files(const std::string &directory, const std::string &part = "");

  // A sentence where tables, snapshots or a comparison stand there of which no sum is recorded, as where provenance.json was
  // removed or is of an earlier version: nothing tells then whether they are as the run left them. Empty where all have theirs.
  // Throws as check_files() of a broken record.
  std::string doubt_about_files(const std::string &directory);

  // What is not there has the values of facts that nobody recorded. Throws std::invalid_argument naming the file where one stands
  // there that is no record of a run.
  RunFacts    read_run_facts(const std::string &directory);
  std::string recorded_scene(const std::string &directory); // its name; empty where there is none
} // namespace diptych::coupling
