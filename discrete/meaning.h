// diptych: description of a number, and whether it may be NaN or infinite
// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

namespace diptych::discrete
{
  // Description of a column or attribute. A plain text means that all numbers are finite.
  struct Meaning
  {
    Meaning(const char *text, const bool may_be_nan = false, const bool may_be_infinite = false)
        : text(text),
          may_be_nan(may_be_nan),
          may_be_infinite(may_be_infinite)
    {}
    operator const char *() const { return text; }

    const char *text;
    bool        may_be_nan, may_be_infinite;
  };
} // namespace diptych::discrete
