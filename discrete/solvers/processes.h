// diptych: processes that sweep one contact problem together
// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <tuple>
#include <vector>

namespace diptych::discrete
{
  // Contacts of a block of the solver, and the most blocks of a problem. More processes than blocks have no work.
  inline constexpr int rows_of_a_block = 2000, most_blocks = 64;

  // Every process runs the same program on the same data and computes the same bits. Only the sweeps are shared
  // (batched_sweep.h). This class is a single process; one for MPI is in coupling/panels.
  class Processes
  {
  public:
    virtual ~Processes() = default;

    virtual int rank() const { return 0; }
    virtual int size() const { return 1; }

    // A message from one process to another. send() does not wait for the receiver, and receive() knows the size of `values`.
    virtual void send(int /*to*/, const std::vector<double> & /*values*/) {}
    virtual void receive(int /*from*/, std::vector<double> & /*values*/) {}

    // Collective. `values` holds counts[0] numbers of process 0, then those of process 1, and so on. Each process sets its own
    // and receives the others.
    virtual void gather(std::vector<double> & /*values*/, const std::vector<int> & /*counts*/) {}

    // Collective: the number of process 0.
    virtual int of_first(const int number) { return number; }
  };

  Processes &only_process();

  // Some entries of a list that all processes hold, split among them: entries[p] are those of process p.
  struct SharedEntries
  {
    std::vector<std::vector<int>> entries;

    // Each process gives the others get(entry), an array of doubles, of its entries. They take it by set(entry, array).
    template <class Get, class Set> void exchange(Processes &processes, Get &&get, Set &&set) const
    {
      using Numbers              = decltype(get(0));
      constexpr std::size_t    n = std::tuple_size<Numbers>::value;
      std::vector<int>         counts;
      std::vector<std::size_t> begin = {0};
      for (const std::vector<int> &own : entries)
        {
          counts.push_back(int(n * own.size()));
          begin.push_back(begin.back() + n * own.size());
        }
      if (begin.back() == 0)
        return;
      const auto          own = std::size_t(processes.rank());
      std::vector<double> values(begin.back());
      double             *value = values.data() + begin[own];
      for (const int entry : entries[own])
        for (const double number : get(entry))
          *value++ = number;
      processes.gather(values, counts);
      for (std::size_t process = 0; process < entries.size(); ++process)
        for (std::size_t k = 0; process != own && k < entries[process].size(); ++k)
          {
            Numbers numbers;
            std::copy_n(values.data() + begin[process] + n * k, n, numbers.begin());
            set(entries[process][k], numbers);
          }
    }
  };
} // namespace diptych::discrete
