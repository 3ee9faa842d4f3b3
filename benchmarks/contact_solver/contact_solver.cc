// diptych: tables of the cost and accuracy of the contact solver
// SPDX-License-Identifier: LGPL-2.1-or-later
#include <cstdio>
#include <cstring>
#include <exception>
#include <string>
#include <vector>

#include "benchmarks/contact_solver/sections.h"

namespace
{
  struct Section
  {
    const char *name, *meaning;
    void (*print)(const std::string &states);
  };

  using namespace diptych::benchmarks;
  constexpr Section sections[] = {{"update_cost", "ns per update, 4000 discs", update_cost},
                                  {"stored_problems", "contact problems in files", stored_problems},
                                  {"step_solve", "solve of one step, 4000 discs", step_solve},
                                  {"how_far", "smallest residuals reached (25 min)", how_far},
                                  {"sweep_orders", "order of the sweeps and omega by status", sweep_orders},
                                  {"whole_step", "seconds per step and memory, 500 to 64000 discs", whole_step},
                                  {"threads", "two threads, wall time", threads},
                                  {"accuracy", "grain-stress error against residual", accuracy},
                                  {"warm_start", "with and without the impulses of the preceding step", warm_start},
                                  {"wandering", "a step on which the sweeps do not converge", wandering},
                                  {"stalls", "sweeps that stall on a few contacts", stalls},
                                  {"compliant", "steps with implicit compliant contacts", compliant}};

  int usage()
  {
    std::printf("contact_solver_benchmark [--states DIR] SECTION... | all\n");
    std::printf("  --states DIR     keep sheared samples there, so that they are prepared once\n");
    for (const Section &s : sections)
      std::printf("  %-16s %s\n", s.name, s.meaning);
    return 2;
  }

  const Section *find_section(const std::string &name)
  {
    for (const Section &s : sections)
      if (name == s.name)
        return &s;
    return nullptr;
  }
} // namespace

int main(const int n_words, const char *const *words)
{
  std::string                  states;
  std::vector<const Section *> chosen;
  for (int k = 1; k < n_words; ++k)
    if (std::strcmp(words[k], "--states") == 0 && k + 1 < n_words)
      states = words[++k];
    else if (std::strcmp(words[k], "all") == 0)
      for (const Section &s : sections)
        chosen.push_back(&s);
    else if (const Section *s = find_section(words[k]))
      chosen.push_back(s);
    else
      return usage();
  if (chosen.empty())
    return usage();
  try
    {
      for (const Section *s : chosen)
        {
          std::printf("== %s: %s\n", s->name, s->meaning);
          std::fflush(stdout);
          s->print(states);
          std::printf("\n");
        }
    }
  catch (const std::exception &error)
    {
      std::fprintf(stderr, "contact_solver_benchmark: %s\n", error.what());
      return 1;
    }
  return 0;
}
