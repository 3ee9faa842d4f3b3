// diptych: how several processes divide the blocks of a contact problem
// SPDX-License-Identifier: LGPL-2.1-or-later
#include <algorithm>
#include <functional>
#include <stdexcept>

#include "discrete/solvers/batched_sweep.h"

namespace diptych::discrete
{
  namespace
  {
    // Machines of different kinds round some functions differently, and then the rows of the processes do not match.
    void require_agreement(const ContactProblem &problem, Processes &processes)
    {
      const std::size_t   size = std::size_t(processes.size());
      std::vector<double> sums(size, double(problem.contacts.size()));
      for (const BodyVelocity &v : problem.free_velocity)
        sums[processes.rank()] += v.x - v.y + v.surface;
      processes.gather(sums, std::vector<int>(size, 1));
      if (std::adjacent_find(sums.begin(), sums.end(), std::not_equal_to<>()) != sums.end())
        throw std::runtime_error("the processes have computed different numbers: all machines need one kind of processor and the "
                                 "same libraries");
    }
  } // namespace

  Processes &only_process()
  {
    static Processes one;
    return one;
  }

  BatchedContacts::Range BatchedContacts::blocks_of(const int process) const
  {
    const int n = int(blocks_.size()), size = processes_.size();
    return {n * process / size, n * (process + 1) / size};
  }

  // The gap above each block, if there is one.
  BatchedContacts::Range BatchedContacts::gaps_of(const int process) const
  {
    const Range blocks = blocks_of(process);
    return {std::min(blocks.begin, int(between_.size())), std::min(blocks.end, int(between_.size()))};
  }

  // If parts cannot be divided evenly among the threads, the rounding changes with every sweep, so that the work evens out.
  BatchedContacts::Range BatchedContacts::share_of(const Range own, const int rank, const int n_threads, const int sweep)
  {
    const int n = own.end - own.begin, turn = sweep % n_threads;
    return {own.begin + (n * rank + turn) / n_threads, own.begin + (n * (rank + 1) + turn) / n_threads};
  }

  void BatchedContacts::divide()
  {
    require_agreement(problem_, processes_);
    const std::size_t n_processes = std::size_t(processes_.size());
    std::vector<int>  owner(problem_.free_velocity.size(), -1);
    for (SharedEntries *shared : {&parts_, &rows_, &bodies_, &rest_bodies_})
      shared->entries.resize(n_processes);
    const auto take = [&](const Part &part, const int number, const int process) {
      parts_.entries[process].push_back(number);
      for (const std::array<int, 4> &members : part.rows)
        for (const int row : members)
          if (row >= 0)
            {
              rows_.entries[process].push_back(row);
              owner[problem_.contacts[row].i] = owner[problem_.contacts[row].j] = process;
            }
    };
    for (int process = 0; process < int(n_processes); ++process)
      for (int b = blocks_of(process).begin; b < blocks_of(process).end; ++b)
        take(blocks_[b], b, process);
    for (int process = 0; process < int(n_processes); ++process) // they have the last word
      for (int g = gaps_of(process).begin; g < gaps_of(process).end; ++g)
        take(between_[g], int(blocks_.size()) + g, process);
    for (std::size_t body = 0; body < owner.size(); ++body)
      if (owner[body] >= 0 && moves(problem_, int(body)))
        bodies_.entries[owner[body]].push_back(int(body));
    for (const int row : rest_)
      for (const int body : {problem_.contacts[row].i, problem_.contacts[row].j})
        if (owner[body] >= 0 && moves(problem_, body))
          {
            rest_bodies_.entries[owner[body]].push_back(body);
            owner[body] = -1;
          }
    const Range own = blocks_of(processes_.rank());
    if (own.begin == own.end)
      return;
    const auto process_of = [&](const int block) {
      int process = 0;
      while (blocks_of(process).end <= block)
        ++process;
      return process;
    };
    if (own.begin > 0)
      lower_ = border_at(own.begin - 1, process_of(own.begin - 1));
    if (own.end < int(blocks_.size()))
      upper_ = border_at(own.end - 1, process_of(own.end));
  }

  // The bodies of the contacts in a gap that have contacts within the block above it, too.
  BatchedContacts::Border BatchedContacts::border_at(const int gap, const int neighbour) const
  {
    Border            border{gap, neighbour, {}};
    std::vector<char> in_block(problem_.free_velocity.size(), false);
    const auto        for_each_body = [&](const Part &part, const auto &function) {
      for (const std::array<int, 4> &members : part.rows)
        for (const int row : members)
          for (const int body : {row < 0 ? -1 : problem_.contacts[row].i, row < 0 ? -1 : problem_.contacts[row].j})
            if (body >= 0 && moves(problem_, body))
              function(body);
    };
    for_each_body(blocks_[gap + 1], [&](const int body) { in_block[body] = true; });
    for_each_body(between_[gap], [&](const int body) {
      if (in_block[body])
        border.bodies.push_back(body);
      in_block[body] = false;
    });
    return border;
  }

  void BatchedContacts::send(const Border &border)
  {
    if (border.gap < 0)
      return;
    std::vector<double> values;
    values.reserve(3 * border.bodies.size());
    for (const int body : border.bodies)
      values.insert(values.end(), {v_[body].x, v_[body].y, v_[body].surface});
    processes_.send(border.neighbour, values);
  }

  void BatchedContacts::receive(const Border &border)
  {
    if (border.gap < 0)
      return;
    std::vector<double> values(3 * border.bodies.size());
    processes_.receive(border.neighbour, values);
    const double *value = values.data();
    for (const int body : border.bodies)
      {
        v_[body].x       = *value++;
        v_[body].y       = *value++;
        v_[body].surface = *value++;
      }
  }

  void BatchedContacts::exchange(const SharedEntries &bodies)
  {
    using Velocity = std::array<double, 3>;
    bodies.exchange(
      processes_,
      [&](const int body) {
        return Velocity{v_[body].x, v_[body].y, v_[body].surface};
      },
      [&](const int body, const Velocity &v) {
        v_[body] = {v[0], v[1], v[2], v_[body].inverse_mass};
      });
  }
} // namespace diptych::discrete
