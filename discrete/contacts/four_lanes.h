// diptych: four numbers side by side in a vector register
// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <cmath>

#include "discrete/contacts/inlining.h"

namespace diptych::discrete
{
  typedef double Four __attribute__((vector_size(32)));

  // Transposes a 4x4 block, i.e. turns four records of four numbers into columns. Applied twice, it restores the block.
  DIPTYCH_INLINE void transpose(Four &a, Four &b, Four &c, Four &d)
  {
    const Four ab_low = __builtin_shufflevector(a, b, 0, 4, 2, 6), ab_high = __builtin_shufflevector(a, b, 1, 5, 3, 7);
    const Four cd_low = __builtin_shufflevector(c, d, 0, 4, 2, 6), cd_high = __builtin_shufflevector(c, d, 1, 5, 3, 7);
    a = __builtin_shufflevector(ab_low, cd_low, 0, 1, 4, 5);
    b = __builtin_shufflevector(ab_high, cd_high, 0, 1, 4, 5);
    c = __builtin_shufflevector(ab_low, cd_low, 2, 3, 6, 7);
    d = __builtin_shufflevector(ab_high, cd_high, 2, 3, 6, 7);
  }

  DIPTYCH_INLINE Four read(const void *p)
  {
    Four value;
    __builtin_memcpy(&value, p, sizeof value);
    return value;
  }

  DIPTYCH_INLINE void write(void *p, const Four &value)
  {
    __builtin_memcpy(p, &value, sizeof value);
  }
} // namespace diptych::discrete
