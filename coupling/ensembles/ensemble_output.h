// diptych: an ensemble as files
// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <string>
#include <vector>

#include "coupling/ensembles/ensemble.h"

namespace diptych::coupling
{
  // A realisation that ended with another exit code than 0.
  struct FailedMember
  {
    int         seed      = 0;
    int         exit_code = 0; // 128 + signal where a signal ended it
    std::string message;
  };

  // What became of each seed.
  struct EnsembleRecord
  {
    std::vector<int>          seeds;       // asked for, ascending
    std::vector<FailedMember> failed;      // ascending
    std::vector<int>          interrupted; // stopped or not begun, ascending
    Ensemble                  ensemble;    // of the rest
  };

  std::string text_of(const BandCount &count); // "one band in 6 of 8, none in 2"

  // ensemble.json: every mean, interval and verdict with the value of every member (null where it has none); numbers of members
  // are in the order of "done". Nothing in it depends on when, where and in which order the members ran.
  void write_ensemble_json(const std::string &directory, const Scene &scene, const EnsembleRecord &record);

  // ensemble.csv: a line a quantity, a column a seed.
  void write_ensemble_csv(const std::string &directory, const Ensemble &ensemble);
} // namespace diptych::coupling
