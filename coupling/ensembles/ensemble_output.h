// diptych: an ensemble as files
// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <string>
#include <vector>

#include "coupling/ensembles/ensemble.h"

namespace diptych::coupling
{
  // ensemble.json: every mean, interval and verdict with the value of every member (null where it has none); numbers of members
  // are in the order of "done". Nothing in it depends on when, where and in which order the members ran.
  void write_ensemble_json(const std::string &directory, const Scene &scene, const EnsembleRecord &record);

  // ensemble.csv: a line a quantity, a column a seed.
  void write_ensemble_csv(const std::string &directory, const Ensemble &ensemble);
} // namespace diptych::coupling
