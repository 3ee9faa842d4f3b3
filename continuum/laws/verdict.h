// diptych: how far a law's answer can be trusted
// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include "continuum/choices.h"

namespace diptych::continuum
{
  // How far a law's answer can be trusted. `failed`: stress and tangent are meaningless, the step must be cut.
  // `unreliable`: the return converged, but softening was so fast that the answer may not be the only one.
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
