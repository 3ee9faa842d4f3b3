// diptych: compiler attributes of the innermost functions
// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

// A function marked with this is compiled for 128-, 256- and 512-bit registers; the program chooses at start. Without contraction
// and reassociation (compiler flags of the build) all versions give the same bits. The choice is made before a sanitizer is
// ready, so sanitized builds do without it.
#if defined(__x86_64__) && defined(__GNUC__) && !defined(__clang__) && !defined(__SANITIZE_ADDRESS__) &&                         \
  !defined(__SANITIZE_THREAD__)
#define DIPTYCH_FOR_EACH_MACHINE __attribute__((target_clones("arch=skylake-avx512", "avx2", "default")))
#else
#define DIPTYCH_FOR_EACH_MACHINE
#endif

// Functions that are called from a marked function must be inlined into it.
#define DIPTYCH_INLINE inline __attribute__((always_inline))
