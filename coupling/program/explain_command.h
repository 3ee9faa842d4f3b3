// diptych: what keys and results mean
// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "coupling/program/command_line.h"

namespace diptych::coupling
{
  // One entry of a result file.
  struct ResultEntry
  {
    std::string file, name, shape, unit, meaning;
  };
  using ResultList = std::vector<ResultEntry>;

  ResultList discrete_result_entries();   // discrete.csv, discrete.h5
  ResultList comparison_result_entries(); // those of the continuum and of the comparison

  // explain [SECTION]: keys of a scene; SECTION = results: the entries that `lists` give.
  int explain(const CommandLine &line, const std::vector<std::function<ResultList()>> &lists);
} // namespace diptych::coupling
