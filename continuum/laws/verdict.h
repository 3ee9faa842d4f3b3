// diptych: reliability of a law's answer
// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include "continuum/choices.h"

namespace diptych::continuum
{
  // Reliability of a law's answer, from the best to the worst. `zz_outside`: sigma_zz, which the law ignores, is beyond the yield
  // surface (only drive_material_point() checks this). `unreliable`: the return converged, but softening is so fast that the
  // answer may not be unique. `failed`: stress and tangent are meaningless and the step must be cut.
  enum class Verdict
  {
    reliable,
    zz_outside,
    unreliable,
    failed
  };

  constexpr auto choices(Verdict)
  {
    return std::array{std::pair{Verdict::reliable, "reliable"}, std::pair{Verdict::zz_outside, "zz_outside"},
                      std::pair{Verdict::unreliable, "unreliable"}, std::pair{Verdict::failed, "failed"}};
  }
} // namespace diptych::continuum
