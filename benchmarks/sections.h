// diptych: the command line of a benchmark that prints one table per section
// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <cstdio>
#include <exception>
#include <string>
#include <vector>

namespace diptych::benchmarks
{
  struct Section
  {
    const char *name, *meaning;
    void (*print)(const std::string &folder);
  };

  struct Benchmark
  {
    const char          *program;
    const char          *folder_option, *folder_meaning; // the folder that keeps samples between runs
    std::vector<Section> sections;
  };

  inline int usage(const Benchmark &benchmark)
  {
    std::printf("%s [%s DIR] SECTION... | all\n", benchmark.program, benchmark.folder_option);
    std::printf("  %-16s %s\n", (std::string(benchmark.folder_option) + " DIR").c_str(), benchmark.folder_meaning);
    for (const Section &s : benchmark.sections)
      std::printf("  %-16s %s\n", s.name, s.meaning);
    return 2;
  }

  // Prints the chosen sections. Returns the exit code of the program.
  inline int print_sections(const Benchmark &benchmark, const std::vector<std::string> &words)
  {
    std::string                  folder;
    std::vector<const Section *> chosen;
    for (std::size_t k = 0; k < words.size(); ++k)
      {
        if (words[k] == benchmark.folder_option && k + 1 < words.size())
          {
            folder = words[++k];
            continue;
          }
        const std::size_t before = chosen.size();
        for (const Section &s : benchmark.sections)
          if (words[k] == "all" || words[k] == s.name)
            chosen.push_back(&s);
        if (chosen.size() == before)
          return usage(benchmark);
      }
    if (chosen.empty())
      return usage(benchmark);
    try
      {
        for (const Section *s : chosen)
          {
            std::printf("== %s: %s\n", s->name, s->meaning);
            std::fflush(stdout);
            s->print(folder);
            std::printf("\n");
          }
      }
    catch (const std::exception &error)
      {
        std::fprintf(stderr, "%s: %s\n", benchmark.program, error.what());
        return 1;
      }
    return 0;
  }
} // namespace diptych::benchmarks
