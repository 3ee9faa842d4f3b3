// diptych: loading variable as text
// SPDX-License-Identifier: LGPL-2.1-or-later
#include "discrete/walk.h"

#include <sstream>

namespace diptych::discrete
{
  std::string text_of(const Walk walk, const double progress)
  {
    std::ostringstream out;
    out.precision(4);
    if (walk == Walk::time)
      out << "time " << progress;
    else
      out << 100 * progress << (walk == Walk::axial_strain ? " % axial strain" : " % shear strain");
    return out.str();
  }
} // namespace diptych::discrete
