// diptych: what the finished members of an ensemble say together
// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <string>
#include <vector>

#include "coupling/ensembles/ensemble.h"
#include "coupling/ensembles/ensemble_output.h"
#include "coupling/program/command_line.h"
#include "coupling/store/provenance.h"

namespace diptych::coupling
{
  struct MemberOutcome
  {
    int  seed        = 0;
    int  exit_code   = 0;
    bool interrupted = false; // it was asked to stop, or never begun
  };

  // Reads the members that finished and evaluates them. Throws std::invalid_argument naming a member's file that is broken.
  EnsembleRecord record_of(const Scene &scene, const std::vector<int> &seeds, const std::vector<MemberOutcome> &outcomes);

  // ensemble.json, .csv and .h5 and the phase; tells the verdicts.
  void write_record(const CommandLine &line, const Scene &scene, const EnsembleRecord &record, const PhaseTimer &timer);

  // Throws SceneError where a word of --set names another folder: compare DIR writes to DIR.
  void refuse_other_folder(const std::string &override_text);

  // compare DIR of an ensemble: statistics and verdicts again from the members' comparison.json; margins may be changed.
  int compare_ensemble_again(const CommandLine &line);
} // namespace diptych::coupling
