// diptych: description of a number: whether it may be NaN or infinite, or is measured on the clock
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

    static Meaning of_clock(const char *text) // another one in every run
    {
      Meaning meaning(text);
      meaning.is_clock = true;
      return meaning;
    }

    const char *text;
    bool        may_be_nan, may_be_infinite, is_clock = false;
  };
} // namespace diptych::discrete
