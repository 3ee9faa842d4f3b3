// diptych: four numbers side by side in a vector register
// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <cmath>

// A function so marked is compiled for 128-, 256- and 512-bit machines and chosen when the program starts. Without contraction
// and reassociation (see the build's flags) all give the same bits.
#if defined(__x86_64__) && defined(__GNUC__) && !defined(__clang__) && !defined(__SANITIZE_ADDRESS__)
#define DIPTYCH_FOR_EACH_MACHINE __attribute__((target_clones("arch=skylake-avx512", "avx2", "default")))
#else
#define DIPTYCH_FOR_EACH_MACHINE
#endif

// What a function marked so calls must become part of it.
#define DIPTYCH_INLINE inline __attribute__((always_inline))

namespace diptych::discrete
{
  typedef double    Four __attribute__((vector_size(32)));
  typedef long long Mask __attribute__((vector_size(32)));

  // Transposes a 4x4 block; its own inverse. Turns four records of four numbers into columns.
  DIPTYCH_INLINE void transpose(Four &a, Four &b, Four &c, Four &d)
  {
    const Four ab_low = __builtin_shuffle(a, b, Mask{0, 4, 2, 6}), ab_high = __builtin_shuffle(a, b, Mask{1, 5, 3, 7});
    const Four cd_low = __builtin_shuffle(c, d, Mask{0, 4, 2, 6}), cd_high = __builtin_shuffle(c, d, Mask{1, 5, 3, 7});
    a = __builtin_shuffle(ab_low, cd_low, Mask{0, 1, 4, 5});
    b = __builtin_shuffle(ab_high, cd_high, Mask{0, 1, 4, 5});
    c = __builtin_shuffle(ab_low, cd_low, Mask{2, 3, 6, 7});
    d = __builtin_shuffle(ab_high, cd_high, Mask{2, 3, 6, 7});
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
