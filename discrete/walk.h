// diptych: what a loading walks along
// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <string>

#include "discrete/choices.h"

namespace diptych::discrete
{
  // What a loading walks along: its stages are values of it. Shear strain: travel of the upper platen / initial height.
  enum class Walk
  {
    axial_strain,
    shear_strain,
    time
  };

  constexpr auto choices(Walk)
  {
    return std::array{std::pair{Walk::axial_strain, "axial_strain"}, std::pair{Walk::shear_strain, "shear_strain"},
                      std::pair{Walk::time, "time"}};
  }

  // "2.5 % axial strain", "1 % shear strain", "time 3": for messages.
  std::string text_of(Walk walk, double progress);
} // namespace diptych::discrete
