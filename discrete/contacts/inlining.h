// diptych: how the innermost functions are compiled
// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

// A function so marked is compiled for 128-, 256- and 512-bit machines and chosen when the program starts. Without contraction
// and reassociation (see the build's flags) all give the same bits. The choice is made before a sanitizer is ready.
#if defined(__x86_64__) && defined(__GNUC__) && !defined(__clang__) && !defined(__SANITIZE_ADDRESS__) &&                         \
  !defined(__SANITIZE_THREAD__)
#define DIPTYCH_FOR_EACH_MACHINE __attribute__((target_clones("arch=skylake-avx512", "avx2", "default")))
#else
#define DIPTYCH_FOR_EACH_MACHINE
#endif

// What a function marked so calls must become part of it.
#define DIPTYCH_INLINE inline __attribute__((always_inline))
