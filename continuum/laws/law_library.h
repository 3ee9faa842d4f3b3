// diptych: a shared library that holds a law of the user
// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <string>
#include <vector>

#include "continuum/laws/diptych_law.h"
#include "continuum/laws/options.h"

namespace diptych::continuum
{
  // An opened library with its checked description. It stays open until the program ends.
  struct LawLibrary
  {
    const diptych_law            *law    = nullptr;
    decltype(&diptych_law_update) update = nullptr;
    decltype(&diptych_law_start)  start  = nullptr; // nullptr: the library has none
    std::vector<unsigned int>     tensors;          // first state variable of each tensor

    bool is_cosserat() const { return law->n_components == 6; }
  };

  // Opens a library once. Throws WrongKeys (law_library) if it cannot be opened, lacks a function or has a wrong description.
  const LawLibrary &law_library(const std::string &path);

  // Names of the library's state variables with the prefix that results use: "law.NAME".
  std::vector<std::string> variable_names(const LawLibrary &library);

  // Gives the parameters that the scene does not set their usual values, and all of them unit, meaning and range, in the order of
  // the library. Throws WrongKeys (law_library or law.NAME), also for an unknown parameter or a value out of range.
  void complete(LibraryOptions &options);
} // namespace diptych::continuum
