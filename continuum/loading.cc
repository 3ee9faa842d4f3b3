// diptych: loading of the continuum sample
// SPDX-License-Identifier: LGPL-2.1-or-later
#include "continuum/loading.h"

#include <sstream>
#include <stdexcept>
#include <string>

#include "continuum/require.h"

namespace diptych::continuum
{
  std::string text_of(const LoadingVariable loading_variable, const double progress)
  {
    std::ostringstream out;
    out.precision(4);
    if (loading_variable == LoadingVariable::time)
      out << "time " << progress;
    else
      out << 100 * progress << (loading_variable == LoadingVariable::axial_strain ? " % axial strain" : " % shear strain");
    return out.str();
  }

  void validate(const Loading &loading)
  {
    require(loading.pressure >= 0, "pressure = ", loading.pressure, " is negative: give 0 or more");
    require(loading.body_force.allFinite(), "body_force has an entry that is not finite");
    require(!loading.stages.empty(), "stages is empty: give at least one value of the progress");
    for (std::size_t i = 0; i < loading.stages.size(); ++i)
      require(loading.stages[i] >= 0 && (i == 0 || loading.stages[i] > loading.stages[i - 1]), "stages: ", loading.stages[i],
              " is out of order: the values must ascend from 0 or more");
    for (const auto &platen : loading.platens)
      for (const auto &drive : platen)
        require(!drive.is_force || drive.value, "a platen whose component is free needs a force");
    require(!(loading.platens[0][1].is_force && loading.platens[1][1].is_force),
            "both platens are free in the vertical: prescribe the motion of one of them");
  }
} // namespace diptych::continuum
