// diptych: a whole step of 500 to 64000 discs: total time, time outside the solver, memory
// SPDX-License-Identifier: LGPL-2.1-or-later
#include <cstdio>
#include <stdexcept>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include "benchmarks/contact_solver/measuring.h"
#include "benchmarks/contact_solver/sections.h"
#include "benchmarks/contact_solver/sheared_states.h"

namespace diptych::benchmarks
{
  using namespace diptych::discrete;

  namespace
  {
    constexpr LoadCase load{"A at 1e-4", 1e-3, 0.02, 1e-4};
    constexpr int      steps_before = 100, steps_measured = 21;

    // Detection with the margins of time_stepping.h on a separate list: with the kept list, and with a new list.
    Spread detection(const Sheared &sheared, NeighbourList &list)
    {
      const Grains                      &g     = sheared.state.grains;
      const double                       h     = sheared.setting.step;
      const std::vector<Eigen::Vector2d> force = applied_forces(sheared.state, sheared.setting);
      std::vector<double>                margin(g.size());
      for (std::size_t i = 0; i < g.size(); ++i)
        margin[i] = 0.04 + 1.2 * h *
                             (std::max(g.velocity[i].norm(), sheared.state.walls[1].velocity.norm()) +
                              h * force[i].norm() * g.inverse_mass(i));
      return timed(1, cpu_seconds, [&] { (void)list.find_contacts(sheared.state, margin); });
    }

    void print_size(const int grains)
    {
      Sheared sheared = start_shear(grains, load);
      for (int k = 0; k < steps_before; ++k)
        (void)advance(sheared);
      std::vector<double> whole, solver, kept, renewed, sweeps;
      std::size_t         contacts = 0;
      NeighbourList       list;
      (void)detection(sheared, list);
      for (int k = 0; k < steps_measured; ++k)
        {
          NeighbourList fresh;
          kept.push_back(detection(sheared, list).median);
          renewed.push_back(detection(sheared, fresh).median);
          const double     begin  = cpu_seconds();
          const StepResult result = advance(sheared);
          whole.push_back(cpu_seconds() - begin);
          solver.push_back(result.solve.cpu_s);
          sweeps.push_back(double(result.solve.sweeps));
          contacts = result.contacts.size();
        }
      std::vector<double> outside;
      for (int k = 0; k < steps_measured; ++k)
        outside.push_back(whole[k] - solver[k]);
      const double all = spread(whole).median, out = spread(outside).median, found = spread(kept).median;
      std::printf("%6d %8zu %7.0f %9.4f %9.4f %9.2f %5.1f %% %9.2f %9.2f %5.1f %%", grains, contacts, spread(sweeps).median, all,
                  spread(solver).median, 1e3 * out, 100 * out / all, 1e3 * found, 1e3 * spread(renewed).median,
                  100 * found / all);
    }

    // Each size runs in its own process, because the peak memory is that of a process.
    void print_in_child(const int grains)
    {
      std::fflush(stdout);
      const pid_t child = fork();
      if (child < 0)
        throw std::runtime_error("cannot start a process");
      if (child == 0)
        {
          print_size(grains);
          std::fflush(stdout);
          _exit(0);
        }
      int    status = 0;
      rusage usage{};
      wait4(child, &status, 0, &usage);
      if (!WIFEXITED(status) || WEXITSTATUS(status) != 0)
        throw std::runtime_error("the process with " + std::to_string(grains) + " discs failed");
      std::printf(" %7.0f\n", double(usage.ru_maxrss) / 1024);
    }
  } // namespace

  void whole_step(const std::string &)
  {
    std::printf("I = 1e-3, step 0.02, tolerance 1e-4, steps %d to %d of the loading, medians, CPU time; solver including "
                "its batches\n",
                steps_before + 1, steps_before + steps_measured);
    std::printf(" discs contacts  sweeps    s/step  solver s outside ms share  list kept ms   new ms share  peak MB\n");
    for (const int grains : {500, 1000, 2000, 4000, 8000, 16000, 32000, 64000})
      print_in_child(grains);
  }
} // namespace diptych::benchmarks
