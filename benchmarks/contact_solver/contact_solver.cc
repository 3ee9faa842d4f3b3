// diptych: tables of the cost and accuracy of the contact solver
// SPDX-License-Identifier: LGPL-2.1-or-later
#include "benchmarks/contact_solver/sections.h"
#include "benchmarks/sections.h"

int main(const int n_words, const char *const *words)
{
  using namespace diptych::benchmarks;
  return print_sections({"contact_solver_benchmark",
                         "--states",
                         "keep sheared samples there, so that they are prepared once",
                         {{"update_cost", "ns per update, 4000 discs", update_cost},
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
                          {"compliant", "steps with implicit compliant contacts", compliant}}},
                        {words + 1, words + n_words});
}
