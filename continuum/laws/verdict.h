// diptych: reliability of a law's answer
// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include "continuum/choices.h"

namespace diptych::continuum
{
  // Reliability of a law's answer. `failed`: stress and tangent are meaningless and the step must be cut. `unreliable`: the
  // return converged, but softening is so fast that the answer may not be unique.
  enum class Verdict
  {
    reliable,
    unreliable,
    failed
  };

  constexpr auto choices(Verdict)
  {
    return std::array{std::pair{Verdict::reliable, "reliable"}, std::pair{Verdict::unreliable, "unreliable"},
                      std::pair{Verdict::failed, "failed"}};
  }
} // namespace diptych::continuum
