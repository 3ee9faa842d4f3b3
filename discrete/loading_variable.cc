// diptych: loading variable as text
// SPDX-License-Identifier: LGPL-2.1-or-later
#include "discrete/loading_variable.h"

#include <sstream>

namespace diptych::discrete
{
  std::string text_of(const LoadingVariable loading_variable, const double progress)
  {
    std::ostringstream out;
    out.precision(4);
    if (loading_variable == LoadingVariable::time)
      out << "time " << progress;
    else if (loading_variable == LoadingVariable::path)
      out << "progress " << progress;
    else
      out << 100 * progress << (loading_variable == LoadingVariable::axial_strain ? " % axial strain" : " % shear strain");
    return out.str();
  }
} // namespace diptych::discrete
