// diptych: lists of numbers, vectors, tensors and choices as the arrays of a file
// SPDX-License-Identifier: LGPL-2.1-or-later
#include "discrete/files/field_arrays.h"

#include <cmath>
#include <stdexcept>

namespace diptych::discrete
{
  void ArrayCheck::refuse(const std::string &name, const std::string &what) const
  {
    throw std::invalid_argument(place + "/" + name + " " + what);
  }

  void ArrayCheck::size(const std::string &name, const std::size_t found, const std::size_t wanted) const
  {
    if (found != wanted)
      refuse(name, "holds " + std::to_string(found) + " entries, not " + std::to_string(wanted));
  }

  void ArrayCheck::finite(const std::string &name, const std::vector<double> &numbers, const std::size_t per_entry) const
  {
    for (std::size_t k = 0; k < numbers.size(); ++k)
      if (!std::isfinite(numbers[k]))
        refuse(name, "holds a number that is not finite, in entry " + std::to_string(k / per_entry) + " (counted from 0)");
  }
} // namespace diptych::discrete
