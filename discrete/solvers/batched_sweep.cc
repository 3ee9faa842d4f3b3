// diptych: over-relaxed sweeps over four independent contacts at a time, on one or more threads
// SPDX-License-Identifier: LGPL-2.1-or-later
#include "discrete/solvers/batched_sweep.h"

#include <algorithm>
#include <atomic>

#include "discrete/contacts/contact_law.h"
#include "discrete/contacts/lattice_motion.h"

namespace diptych::discrete
{
  namespace
  {
    template <class Part> auto couples_of(Part &part)
    {
      return part.rolling.empty() ? nullptr : part.rolling.data();
    }

    template <class Part> auto terms_of(Part &part)
    {
      return part.terms.empty() ? nullptr : part.terms.data();
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

  } // namespace

  BatchedContacts::BatchedContacts(const ContactProblem       &problem,
                                   const std::vector<int>     &held,
                                   const std::vector<Impulse> &guess,
                                   Processes                  &processes)
      : problem_(problem),
        v_(problem.free_velocity),
        batch_of_(problem.free_velocity.size(), -2),
        processes_(processes)
  {
    std::vector<Ends> rows;
    std::vector<bool> is_held(problem.contacts.size(), false);
    for (const int row : held)
      is_held[row] = true;
    const auto end_of = [&](const int body) { return moves(problem, body) ? body : -1 - body; };
    const auto take   = [&](const int row) {
      if (is_held[row])
        return;
      const ContactRow &c = problem.contacts[row];
      if (fits_a_batch(c))
        rows.push_back({row, end_of(c.i), end_of(c.j)});
      else
        rest_.push_back(row);
      has_couples_ = has_couples_ || c.rolling_friction != 0;
      has_terms_   = has_terms_ || c.tangential_term != 0 || c.normal_compliance != 0;
    };
    rows.reserve(problem.contacts.size());
    std::for_each(problem.order.begin(), problem.order.end(), take);
    for (int row = 0; problem.order.empty() && row < int(problem.contacts.size()); ++row)
      take(row);
    is_idle_.resize(problem.contacts.size());
    if (std::any_of(guess.begin(), guess.end(), [](const Impulse &r) { return r.normal > 0; }))
      std::transform(guess.begin(), guess.end(), is_idle_.begin(), [](const Impulse &r) { return !(r.normal > 0); });
    n_swept_rest_ = rest_.size();
    rest_.insert(rest_.end(), held.begin(), held.end());
    rest_impulses_.resize(rest_.size());
    int n_blocks = std::clamp(int(rows.size()) / rows_of_a_block, 1, most_blocks);
    while (!cut(rows, n_blocks))
      n_blocks /= 2;
    if (processes.size() > 1)
      divide();
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
              if (!part.rolling.empty())
                part.rolling[b].rolling[lane] = impulses[row].rolling;
            }
    });
    for (std::size_t k = 0; k < rest_.size(); ++k)
      rest_impulses_[k] = impulses[rest_[k]];
    refresh_velocities();
  }

  std::vector<Impulse> BatchedContacts::impulses() const
  {
    std::vector<Impulse> result(problem_.contacts.size()); // rows of other processes are overwritten below
    for (const std::vector<Part> *parts : {&blocks_, &between_})
      for (const Part &part : *parts)
        for (std::size_t b = 0; b < part.batches.size(); ++b)
          for (int lane = 0; lane < lanes; ++lane)
            if (const int row = part.rows[b][lane]; row >= 0)
              result[row] = {part.batches[b].normal[lane], part.batches[b].tangential[lane],
                             part.rolling.empty() ? 0 : part.rolling[b].rolling[lane]};
    for (std::size_t k = 0; k < rest_.size(); ++k)
      result[rest_[k]] = rest_impulses_[k];
    using Parts = std::array<double, 3>;
    rows_.exchange(
      processes_,
      [&](const int row) {
        return Parts{result[row].normal, result[row].tangential, result[row].rolling};
      },
      [&](const int row, const Parts &r) {
        result[row] = {r[0], r[1], r[2]};
      });
    return result;
  }

  void BatchedContacts::refresh_velocities()
  {
    std::copy(problem_.free_velocity.begin(), problem_.free_velocity.end(), v_.begin());
    const auto  add = [&](Part &part) { add_impulses(part.batches.data(), couples_of(part), part.batches.size(), v_.data()); };
    const Range own = blocks_of(processes_.rank()), gaps = gaps_of(processes_.rank());
    for (int b = own.begin; b < own.end; ++b)
      add(blocks_[b]);
    send(lower_);
    receive(upper_);
    for (int g = gaps.begin; g < gaps.end; ++g)
      add(between_[g]);
    exchange(bodies_);
    for (std::size_t k = 0; k < rest_.size(); ++k)
      apply_impulse(problem_.contacts[rest_[k]], rest_impulses_[k], v_);
    follow_lattice();
  }

  // Rows across the edge of a lattice are among those taken one by one.
  void BatchedContacts::follow_lattice()
  {
    if (!problem_.lattice)
      return;
    Eigen::Matrix2d crossing = Eigen::Matrix2d::Zero();
    for (std::size_t k = 0; k < rest_.size(); ++k)
      crossing += crossing_of(problem_.contacts[rest_[k]], rest_impulses_[k], *problem_.lattice);
    follow_crossing(*problem_.lattice, problem_.free_velocity, crossing, v_);
  }

  void BatchedContacts::sweep_part(Part &part, const double omega_sticking, const double omega_slipping, const bool with_idle)
  {
    sweep_batches(part.batches.data(), couples_of(part), terms_of(part), with_idle ? part.batches.size() : part.n_awake,
                  omega_sticking, omega_slipping, v_.data());
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
        if (!part.rolling.empty())
          std::swap(part.rolling[b], part.rolling[part.n_awake]);
        if (!part.terms.empty())
          std::swap(part.terms[b], part.terms[part.n_awake]);
        ++part.n_awake;
      }
  }

  void BatchedContacts::sweep_rest(const double omega_sticking, const double omega_slipping)
  {
    for (std::size_t row = 0; row < n_swept_rest_; ++row)
      update(problem_.contacts[rest_[row]], {omega_sticking, omega_slipping}, v_, rest_impulses_[row]);
  }

  // There is no barrier between blocks and the contacts between them. A block waits for the contacts at both its ends, and these
  // wait for the blocks on both sides. So a thread that has fewer blocks in this sweep can start the next one, where it has more.
  void BatchedContacts::sweep(const double omega_sticking, const double omega_slipping, const int n, ThreadTeam &team)
  {
    const Range           own = blocks_of(processes_.rank()), gaps = gaps_of(processes_.rank());
    const bool            has_rest = n_swept_rest_ > 0 || problem_.lattice;
    std::vector<Progress> blocks(blocks_.size()), between(between_.size());
    team.run([&](const int rank) {
      for (int k = 0; k < n; ++k)
        {
          const bool  with_idle = k % idle_every == idle_every - 1 || k == n - 1;
          const Range mine = share_of(own, rank, team.size(), k), ends = share_of(gaps, rank, team.size(), k);
          for (int b = mine.begin; b < mine.end; ++b)
            {
              blocks[b].wait_for(k); // another thread may have swept it, and a single block has no ends to wait for
              if (b > own.begin)
                between[b - 1].wait_for(k);
              else if (k > 0 && !has_rest)
                receive(lower_);
              if (b < gaps.end)
                between[b].wait_for(k);
              sweep_part(blocks_[b], omega_sticking, omega_slipping, with_idle);
              if (b == own.begin)
                send(lower_);
              blocks[b].advance_to(k + 1);
            }
          for (int b = ends.end - 1; b >= ends.begin; --b) // the neighbour waits for the last one
            {
              blocks[b].wait_for(k + 1);
              if (b == upper_.gap)
                receive(upper_);
              else
                blocks[b + 1].wait_for(k + 1);
              sweep_part(between_[b], omega_sticking, omega_slipping, with_idle);
              if (b == upper_.gap)
                send(upper_);
              between[b].advance_to(k + 1);
            }
          if (!has_rest)
            continue;
          team.barrier();
          if (rank == 0)
            {
              receive(lower_);
              exchange(problem_.lattice ? bodies_ : rest_bodies_); // a lattice follows all grains
              sweep_rest(omega_sticking, omega_slipping);
              follow_lattice();
            }
          team.barrier();
        }
    });
    if (n > 0 && !has_rest)
      receive(lower_);
  }

  NaturalMapSquares BatchedContacts::residual_squares(const Part &part) const
  {
    NaturalMapSquares squares;
    add_squares(part.batches.data(), couples_of(part), terms_of(part), part.batches.size(), v_.data(), &squares.difference,
                &squares.norm);
    return squares;
  }

  double BatchedContacts::residual(ThreadTeam &team) const
  {
    const std::size_t              n = blocks_.size() + between_.size();
    std::vector<NaturalMapSquares> squares(n);
    const Range                    own = blocks_of(processes_.rank()), gaps = gaps_of(processes_.rank());
    team.run([&](const int rank) {
      // First the blocks that this thread sweeps, because they are in its cache, then the contacts between blocks.
      const Range mine = share_of(own, rank, team.size(), 0), ends = share_of(gaps, rank, team.size(), 0);
      for (int b = mine.begin; b < mine.end; ++b)
        squares[b] = residual_squares(blocks_[b]);
      for (int b = ends.begin; b < ends.end; ++b)
        squares[blocks_.size() + b] = residual_squares(between_[b]);
    });
    using Pair = std::array<double, 2>;
    parts_.exchange(
      processes_,
      [&](const int part) {
        return Pair{squares[part].difference, squares[part].norm};
      },
      [&](const int part, const Pair &sums) {
        squares[part] = {sums[0], sums[1]};
      });
    NaturalMapSquares sum; // in the order of the parts, so that the sum does not depend on threads and processes
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
