// diptych: meanings of keys and results
// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <functional>

#include "coupling/program/command_line.h"
#include "coupling/program/result_entries.h"

namespace diptych::coupling
{
  ResultList discrete_result_entries();   // discrete.csv, discrete.h5
  ResultList comparison_result_entries(); // files of the continuum and of the comparison
  ResultList python_result_entries();     // files that the Python package writes

  // explain [SECTION]: prints the keys of a scene, or for SECTION = results the entries in `lists`; --json: all of both.
  int explain(const CommandLine &line, const std::vector<std::function<ResultList()>> &lists);
} // namespace diptych::coupling
