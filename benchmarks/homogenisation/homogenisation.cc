// diptych: tables of the cost and accuracy of averaging grains over cells
// SPDX-License-Identifier: LGPL-2.1-or-later
#include <cstdio>
#include <cstring>
#include <exception>
#include <string>
#include <vector>

#include "benchmarks/homogenisation/sections.h"

namespace
{
  struct Section
  {
    const char *name, *meaning;
    void (*print)(const std::string &samples);
  };

  using namespace diptych::benchmarks;
  constexpr Section sections[] = {{"cost", "CPU seconds at 4000 and 64000 grains", cost},
                                  {"known_stress", "error against a known stress field", known_stress},
                                  {"sheared_grains", "scatter on a sheared sample", sheared_grains},
                                  {"resolution", "stress against the averaging length", resolution}};

  int usage()
  {
    std::printf("homogenisation_benchmark [--samples DIR] SECTION... | all\n");
    std::printf("  --samples DIR    keep the sheared sample there, so that it is prepared once\n");
    for (const Section &s : sections)
      std::printf("  %-16s %s\n", s.name, s.meaning);
    return 2;
  }
} // namespace

int main(const int n_words, const char *const *words)
{
  std::string                  samples;
  std::vector<const Section *> chosen;
  for (int k = 1; k < n_words; ++k)
    {
      if (std::strcmp(words[k], "--samples") == 0 && k + 1 < n_words)
        {
          samples = words[++k];
          continue;
        }
      const std::size_t before = chosen.size();
      for (const Section &s : sections)
        if (std::strcmp(words[k], "all") == 0 || std::strcmp(words[k], s.name) == 0)
          chosen.push_back(&s);
      if (chosen.size() == before)
        return usage();
    }
  if (chosen.empty())
    return usage();
  try
    {
      for (const Section *s : chosen)
        {
          std::printf("== %s: %s\n", s->name, s->meaning);
          std::fflush(stdout);
          s->print(samples);
          std::printf("\n");
        }
    }
  catch (const std::exception &error)
    {
      std::fprintf(stderr, "homogenisation_benchmark: %s\n", error.what());
      return 1;
    }
  return 0;
}
