// diptych: over-relaxed sweeps over four independent contacts at a time, on one or more threads
// SPDX-License-Identifier: LGPL-2.1-or-later
#include "discrete/solvers/batched_sweep.h"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <limits>
#include <numeric>

#include "discrete/contacts/contact_law.h"

namespace diptych::discrete
{
  namespace
  {
    ContactBatch empty_batch(const int idle_body)
    {
      ContactBatch batch{};
      std::fill_n(batch.i, lanes, idle_body);
      std::fill_n(batch.j, lanes, idle_body);
      return batch;
    }

    // Number of sweeps that a part has finished, visible to other threads. Each counter has a cache line of its own.
    class alignas(64) Progress
    {
    public:
      void advance_to(const int sweeps) { done_.store(sweeps, std::memory_order_release); }
      void wait_for(const int sweeps) const
      {
        ThreadTeam::wait_until([&] { return done_.load(std::memory_order_acquire) >= sweeps; });
      }

    private:
      std::atomic<int> done_{0};
    };

    // Consecutive parts of `n` for one thread. If they cannot be divided evenly, the rounding changes with every sweep, so that
    // the work evens out.
    struct Share
    {
      int begin, end;
    };

    Share share_of(const int n, const int rank, const int n_threads, const int sweep)
    {
      const int turn = sweep % n_threads;
      return {(n * rank + turn) / n_threads, (n * (rank + 1) + turn) / n_threads};
    }
  } // namespace

  bool BatchedContacts::fits_a_batch(const ContactRow &c) const
  {
    const double wi = problem_.free_velocity[c.i].inverse_mass, wj = problem_.free_velocity[c.j].inverse_mass;
    const auto   same = [](const double a, const double b) {
      return std::abs(a - b) <= 1e-14 * std::abs(b);
    }; // files round these numbers
    return c.cell < 0 && same(c.jx, wj) && same(c.jy, wj) && same(c.ki, 2 * wi) && same(c.kj, 2 * wj) &&
           (c.normal_compliance > 0 || same(c.inverse_wtt, c.inverse_wnn * disc_wnn_over_wtt));
  }

  BatchedContacts::BatchedContacts(const ContactProblem &problem, const std::vector<int> &held, const std::vector<Impulse> &guess)
      : problem_(problem),
        v_(problem.free_velocity),
        batch_of_(problem.free_velocity.size(), -2)
  {
    constexpr int    rows_of_a_block = 2000, most_blocks = 64;
    std::vector<int> order = problem.order, rows;
    if (order.empty())
      {
        order.resize(problem.contacts.size());
        std::iota(order.begin(), order.end(), 0);
      }
    std::vector<bool> is_held(problem.contacts.size(), false);
    for (const int row : held)
      is_held[row] = true;
    for (const int row : order)
      if (!is_held[row])
        (fits_a_batch(problem.contacts[row]) ? rows : rest_).push_back(row);
    is_idle_.resize(problem.contacts.size());
    if (std::any_of(guess.begin(), guess.end(), [](const Impulse &r) { return r.normal > 0; }))
      std::transform(guess.begin(), guess.end(), is_idle_.begin(), [](const Impulse &r) { return !(r.normal > 0); });
    n_swept_rest_ = rest_.size();
    rest_.insert(rest_.end(), held.begin(), held.end());
    rest_impulses_.resize(rest_.size());
    int n_blocks = std::clamp(int(rows.size()) / rows_of_a_block, 1, most_blocks);
    while (!cut(rows, n_blocks))
      n_blocks /= 2;
  }

  // False: a contact would join blocks that are not neighbours, or a body has contacts in two gaps between blocks.
  bool BatchedContacts::cut(const std::vector<int> &rows, const int n_blocks)
  {
    const std::size_t n_bodies = problem_.free_velocity.size();
    std::vector<int>  first(n_bodies, n_blocks), last(n_bodies, -1), gap_of(n_bodies, -1);
    const auto        block_of = [&](const std::size_t k) { return int(k * n_blocks / rows.size()); };
    for (std::size_t k = 0; k < rows.size(); ++k)
      for (const int body : {problem_.contacts[rows[k]].i, problem_.contacts[rows[k]].j})
        if (moves(problem_, body))
          {
            first[body] = std::min(first[body], block_of(k));
            last[body]  = std::max(last[body], block_of(k));
          }
    std::vector<std::vector<int>> inside(n_blocks), gaps(n_blocks - 1);
    for (std::size_t k = 0; k < rows.size(); ++k)
      {
        const ContactRow &c    = problem_.contacts[rows[k]];
        int               from = n_blocks, to = -1;
        for (const int body : {c.i, c.j})
          if (moves(problem_, body))
            {
              from = std::min(from, first[body]);
              to   = std::max(to, last[body]);
            }
        if (from == to)
          inside[from].push_back(rows[k]);
        else if (to == from + 1)
          gaps[from].push_back(rows[k]);
        else
          return false;
        if (from != to)
          for (const int body : {c.i, c.j})
            if (moves(problem_, body))
              {
                if (gap_of[body] >= 0 && gap_of[body] != from)
                  return false;
                gap_of[body] = from;
              }
      }
    for (const std::vector<int> &part : inside)
      blocks_.push_back(make_part(part));
    for (const std::vector<int> &part : gaps)
      between_.push_back(make_part(part));
    return true;
  }

  // First fit. A batch takes, from a window of 64 waiting rows, the oldest ones that share no moving body. If possible they
  // share no moving body with the previous batch either: then the sweep need not wait for its velocities.
  BatchedContacts::Part BatchedContacts::make_part(const std::vector<int> &rows)
  {
    std::vector<int> own; // immovable bodies, each with a private copy
    Part             part;
    part.idle_body = int(v_.size());
    v_.push_back({0, 0, 0, 0});
    part.batches.reserve(rows.size() / 3 + 2);
    part.rows.reserve(rows.size() / 3 + 2);
    part.extras.reserve(rows.size() / 3 + 2);
    std::vector<int> awake, idle;
    for (const int row : rows)
      (is_idle_[row] ? idle : awake).push_back(row);
    pack(awake, part, own);
    part.n_awake = part.batches.size();
    pack(idle, part, own);
    if (std::all_of(rows.begin(), rows.end(), [&](const int row) {
          return problem_.contacts[row].tangential_term == 0 && problem_.contacts[row].normal_compliance == 0;
        }))
      part.extras.clear();
    return part;
  }

  void BatchedContacts::pack(const std::vector<int> &rows, Part &part, std::vector<int> &own)
  {
    constexpr int      window_size = 64;
    const int          n = int(rows.size()), first_own = part.idle_body + 1;
    const ContactBatch empty = empty_batch(part.idle_body);
    const auto         place = [&](const int body) {
      if (moves(problem_, body))
        return body;
      const auto known = std::find(own.begin(), own.end(), body);
      if (known != own.end())
        return first_own + int(known - own.begin());
      own.push_back(body);
      v_.push_back(problem_.free_velocity[body]);
      return int(v_.size()) - 1;
    };

    // Waiting rows as a linked list: after[k + 1] follows row k, and after[0] is the oldest row.
    std::vector<int> after(n + 1);
    std::iota(after.begin(), after.end(), 0);
    int waiting = 0, entered = 0, taken_rows = 0;
    for (int batch = 0; taken_rows < n; ++batch)
      {
        entered = std::min(n, entered + window_size - waiting);
        waiting = entered - taken_rows;
        part.batches.push_back(empty);
        part.rows.push_back({-1, -1, -1, -1});
        part.extras.push_back({});
        int filled = 0;
        for (const int distance : {1, 0})
          for (int before = 0; after[before] < entered && filled < lanes;)
            {
              const int         k = after[before];
              const ContactRow &c = problem_.contacts[rows[k]];
              const auto taken    = [&](const int body) { return moves(problem_, body) && batch_of_[body] >= batch - distance; };
              if (taken(c.i) || taken(c.j))
                {
                  before = k + 1;
                  continue;
                }
              batch_of_[c.i] = batch_of_[c.j] = batch;
              fill_lane(part, filled, rows[k]);
              part.batches.back().i[filled] = place(c.i);
              part.batches.back().j[filled] = place(c.j);
              after[before]                 = after[k + 1];
              ++filled;
              ++taken_rows;
              --waiting;
            }
      }
    for (const int row : rows)
      batch_of_[problem_.contacts[row].i] = batch_of_[problem_.contacts[row].j] = -2;
  }

  void BatchedContacts::fill_lane(Part &part, const int lane, const int row) const
  {
    const ContactRow &c               = problem_.contacts[row];
    ContactBatch     &data            = part.batches.back();
    data.nx[lane]                     = c.nx;
    data.ny[lane]                     = c.ny;
    data.normal_term[lane]            = c.normal_term;
    data.friction[lane]               = c.friction;
    data.inverse_wnn[lane]            = c.inverse_wnn;
    BatchExtras &extras               = part.extras.back();
    extras.tangential_term[lane]      = c.tangential_term;
    extras.inverse_wtt[lane]          = c.inverse_wtt;
    extras.normal_compliance[lane]    = c.normal_compliance;
    extras.tangential_compliance[lane] = c.tangential_compliance;
    part.rows.back()[lane]            = row;
  }

  template <class Function> void BatchedContacts::for_each_part(Function &&function)
  {
    for (Part &part : blocks_)
      function(part);
    for (Part &part : between_)
      function(part);
  }

  void BatchedContacts::set_impulses(const std::vector<Impulse> &impulses)
  {
    for_each_part([&](Part &part) {
      for (std::size_t b = 0; b < part.batches.size(); ++b)
        for (int lane = 0; lane < lanes; ++lane)
          if (const int row = part.rows[b][lane]; row >= 0)
            {
              part.batches[b].normal[lane]     = impulses[row].normal;
              part.batches[b].tangential[lane] = impulses[row].tangential;
            }
    });
    for (std::size_t k = 0; k < rest_.size(); ++k)
      rest_impulses_[k] = impulses[rest_[k]];
    refresh_velocities();
  }

  std::vector<Impulse> BatchedContacts::impulses() const
  {
    std::vector<Impulse> result(problem_.contacts.size());
    for (const std::vector<Part> *parts : {&blocks_, &between_})
      for (const Part &part : *parts)
        for (std::size_t b = 0; b < part.batches.size(); ++b)
          for (int lane = 0; lane < lanes; ++lane)
            if (const int row = part.rows[b][lane]; row >= 0)
              result[row] = {part.batches[b].normal[lane], part.batches[b].tangential[lane]};
    for (std::size_t k = 0; k < rest_.size(); ++k)
      result[rest_[k]] = rest_impulses_[k];
    return result;
  }

  void BatchedContacts::refresh_velocities()
  {
    std::copy(problem_.free_velocity.begin(), problem_.free_velocity.end(), v_.begin());
    for_each_part([&](Part &part) { add_impulses(part.batches.data(), part.batches.size(), v_.data()); });
    for (std::size_t k = 0; k < rest_.size(); ++k)
      apply_impulse(problem_.contacts[rest_[k]], rest_impulses_[k], v_);
  }

  void BatchedContacts::sweep_part(Part &part, const double omega_sticking, const double omega_slipping, const bool with_idle)
  {
    sweep_batches(part.batches.data(), part.extras.empty() ? nullptr : part.extras.data(),
                  with_idle ? part.batches.size() : part.n_awake, omega_sticking, omega_slipping, v_.data());
    if (with_idle)
      wake(part);
  }

  // A batch with a newly acting contact joins the batches that are swept every time and stays there. If it stayed idle, contacts
  // that come and go would keep the sweeps from converging.
  void BatchedContacts::wake(Part &part)
  {
    for (std::size_t b = part.n_awake; b < part.batches.size(); ++b)
      {
        const double *normal = part.batches[b].normal;
        if (!(normal[0] + normal[1] + normal[2] + normal[3] > 0))
          continue;
        std::swap(part.batches[b], part.batches[part.n_awake]);
        std::swap(part.rows[b], part.rows[part.n_awake]);
        if (!part.extras.empty())
          std::swap(part.extras[b], part.extras[part.n_awake]);
        ++part.n_awake;
      }
  }

  void BatchedContacts::sweep_rest(const double omega_sticking, const double omega_slipping)
  {
    for (std::size_t row = 0; row < n_swept_rest_; ++row)
      {
        const ContactRow &c     = problem_.contacts[rest_[row]];
        Impulse          &r     = rest_impulses_[row];
        const double      omega = is_slipping(c.friction, r) ? omega_slipping : omega_sticking;
        update(c, omega, v_, r);
      }
  }

  // There is no barrier between blocks and the contacts between them. A block waits for the contacts at both its ends, and these
  // wait for the blocks on both sides. So a thread that has fewer blocks in this sweep can start the next one, where it has more.
  void BatchedContacts::sweep(const double omega_sticking, const double omega_slipping, const int n, ThreadTeam &team)
  {
    const int             n_blocks = int(blocks_.size()), n_between = int(between_.size());
    std::vector<Progress> blocks(n_blocks), between(n_between);
    team.run([&](const int rank) {
      for (int k = 0; k < n; ++k)
        {
          const bool  with_idle = k % idle_every == idle_every - 1 || k == n - 1;
          const Share mine = share_of(n_blocks, rank, team.size(), k), ends = share_of(n_between, rank, team.size(), k);
          for (int b = mine.begin; b < mine.end; ++b)
            {
              blocks[b].wait_for(k); // another thread may have swept it, and a single block has no ends to wait for
              if (b > 0)
                between[b - 1].wait_for(k);
              if (b < n_between)
                between[b].wait_for(k);
              sweep_part(blocks_[b], omega_sticking, omega_slipping, with_idle);
              blocks[b].advance_to(k + 1);
            }
          for (int b = ends.begin; b < ends.end; ++b)
            {
              blocks[b].wait_for(k + 1);
              blocks[b + 1].wait_for(k + 1);
              sweep_part(between_[b], omega_sticking, omega_slipping, with_idle);
              between[b].advance_to(k + 1);
            }
          if (n_swept_rest_ == 0)
            continue;
          team.barrier();
          if (rank == 0)
            sweep_rest(omega_sticking, omega_slipping);
          team.barrier();
        }
    });
  }

  NaturalMapSquares BatchedContacts::residual_squares(const Part &part) const
  {
    NaturalMapSquares squares;
    add_squares(part.batches.data(), part.extras.empty() ? nullptr : part.extras.data(), part.batches.size(),
                v_.data(), &squares.difference, &squares.norm);
    return squares;
  }

  double BatchedContacts::residual(ThreadTeam &team) const
  {
    const std::size_t              n = blocks_.size() + between_.size();
    std::vector<NaturalMapSquares> squares(n);
    team.run([&](const int rank) {
      // First the blocks that this thread sweeps, because they are in its cache, then the contacts between blocks.
      const Share mine = share_of(int(blocks_.size()), rank, team.size(), 0);
      const Share ends = share_of(int(between_.size()), rank, team.size(), 0);
      for (int b = mine.begin; b < mine.end; ++b)
        squares[b] = residual_squares(blocks_[b]);
      for (int b = ends.begin; b < ends.end; ++b)
        squares[blocks_.size() + b] = residual_squares(between_[b]);
    });
    NaturalMapSquares sum; // in the order of the parts, so that the sum does not depend on the threads
    for (const NaturalMapSquares &s : squares)
      {
        sum.difference += s.difference;
        sum.norm += s.norm;
      }
    for (std::size_t k = 0; k < rest_.size(); ++k)
      sum.add(problem_.contacts[rest_[k]], v_, rest_impulses_[k]);
    return relative_norm(sum.difference, sum.norm);
  }

  std::size_t BatchedContacts::n_batches() const
  {
    std::size_t n = 0;
    for (const std::vector<Part> *parts : {&blocks_, &between_})
      for (const Part &part : *parts)
        n += part.batches.size();
    return n;
  }

  std::vector<int> BatchedContacts::order() const
  {
    std::vector<int> rows;
    for (const std::vector<Part> *parts : {&blocks_, &between_})
      for (const Part &part : *parts)
        for (const std::array<int, 4> &members : part.rows)
          for (const int row : members)
            if (row >= 0)
              rows.push_back(row);
    rows.insert(rows.end(), rest_.begin(), rest_.end());
    return rows;
  }
} // namespace diptych::discrete
