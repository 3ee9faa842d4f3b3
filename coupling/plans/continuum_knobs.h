// diptych: settings of the continuum that a plan varies
// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <cstddef>
#include <optional>
#include <string>

#include "continuum/laws/options.h"
#include "coupling/studies/study.h"

namespace diptych::coupling
{
  // A size that the plan halves.
  struct Knob
  {
    std::string name;
    double      coarsest = 1, share = 0; // share of the accuracy
    Settings (*settings)(double size) = nullptr;
    std::size_t least_points          = 2; // values needed for an error estimate
    bool        may_have_no_limit     = false;
    double      dearer_per_halving    = 8;
  };

  Settings of_element_size(double size);
  Settings of_load_step(double size);

  // The law without and with an internal length. with_length() is empty for a law that does not yield or already has one.
  const char                *without_length(continuum::LawKind law);
  std::optional<std::string> with_length(continuum::LawKind law);

  void append(Settings &to, const Settings &more);
} // namespace diptych::coupling
