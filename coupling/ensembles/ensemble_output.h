// diptych: result files of an ensemble
// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <string>
#include <vector>

#include "coupling/ensembles/ensemble.h"

namespace diptych::coupling
{
  // ensemble.json: every mean, interval and verdict with the values of all members (null if one has none), in the order of
  // "done". It does not depend on when, where or in which order the members ran.
  void write_ensemble_json(const std::string &directory, const Scene &scene, const EnsembleRecord &record);

  // ensemble.csv: one line per quantity, one column per seed.
  void write_ensemble_csv(const std::string &directory, const Ensemble &ensemble);
} // namespace diptych::coupling
