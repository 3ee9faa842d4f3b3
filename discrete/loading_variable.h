// diptych: loading variable, the quantity that a loading path is measured in
// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <string>

#include "discrete/choices.h"

namespace diptych::discrete
{
  // Loading variable. Stages are values of it. Shear strain is the travel of the upper platen / initial height.
  enum class LoadingVariable
  {
    axial_strain,
    shear_strain,
    time,
    path // progress of the path of a cell
  };

  constexpr auto choices(LoadingVariable)
  {
    return std::array{std::pair{LoadingVariable::axial_strain, "axial_strain"},
                      std::pair{LoadingVariable::shear_strain, "shear_strain"}, std::pair{LoadingVariable::time, "time"},
                      std::pair{LoadingVariable::path, "path"}};
  }

  // Text for messages: "2.5 % axial strain", "1 % shear strain", "time 3".
  std::string text_of(LoadingVariable loading_variable, double progress);
} // namespace diptych::discrete
