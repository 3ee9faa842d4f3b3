// diptych: tables of the cost and accuracy of averaging grains over cells
// SPDX-License-Identifier: LGPL-2.1-or-later
#include "benchmarks/homogenisation/sections.h"
#include "benchmarks/sections.h"

int main(const int n_words, const char *const *words)
{
  using namespace diptych::benchmarks;
  return print_sections({"homogenisation_benchmark",
                         "--samples",
                         "keep the sheared sample there, so that it is prepared once",
                         {{"cost", "CPU seconds at 4000 and 64000 grains", cost},
                          {"known_stress", "error against a known stress field", known_stress},
                          {"sheared_grains", "scatter on a sheared sample", sheared_grains},
                          {"resolution", "stress against the averaging length", resolution}}},
                        {words + 1, words + n_words});
}
