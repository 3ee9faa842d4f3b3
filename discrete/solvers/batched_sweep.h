// diptych: over-relaxed sweeps over four independent contacts at a time, on one or more threads
// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <array>
#include <vector>

#include "discrete/contacts/contact_law.h"
#include "discrete/solvers/batch_kernel.h"
#include "discrete/solvers/processes.h"
#include "discrete/solvers/thread_team.h"

namespace diptych::discrete
{
  // The contacts of a problem, cut in sweep order into blocks of similar size that share no grain. Contacts between
  // neighbouring blocks are separate. A sweep takes all blocks, then the contacts between blocks. Rows that do not fit a batch
  // come last (walls under a force, the edge of a free width). Contacts that are open in the guess have batches of their own; in
  // sheared samples these are a third of the rows. Until one of its four contacts acts, such a batch is idle: swept every
  // `idle_every` sweeps and at the last one of a call. Blocks depend only on the problem, so every number of threads gives the
  // same bits. The order within a batch does not matter, so every instruction set does too.
  //
  // Of several processes each one sweeps some neighbouring blocks, and the contacts between each of them and the next block. Two
  // messages per sweep pass each border: the bodies of the border's contacts that the upper block has moved, and the same bodies
  // back. All processes take the other rows one by one and so get the same bits, once they know the bodies of these rows.
  class BatchedContacts
  {
  public:
    // The problem must outlive this object. A problem that cannot be cut, or is too small, is one block. Rows in `held` are not
    // swept. Contacts with zero impulse in `guess` count as open. If `guess` is empty or all zero, no contact counts as open.
    explicit BatchedContacts(const ContactProblem       &problem,
                             const std::vector<int>     &held      = {},
                             const std::vector<Impulse> &guess     = {},
                             Processes                  &processes = only_process());

    void                 set_impulses(const std::vector<Impulse> &impulses); // one per row; the velocities follow from them
    std::vector<Impulse> impulses() const;

    // Does `n` sweeps. Contacts at their Coulomb bound (by their old impulse) take omega_slipping.
    void sweep(double omega_sticking, double omega_slipping, int n, ThreadTeam &team);

    // Calls solve(velocities, impulses of the held rows in the given order), which may change both consistently.
    template <class Solve> void solve_held(Solve &&solve)
    {
      exchange(rest_bodies_);
      solve(v_, rest_impulses_.data() + n_swept_rest_);
    }

    // The bodies of the problem come first. After sweep() a process knows only those that it has swept.
    const std::vector<BodyVelocity> &velocities() const { return v_; }

    // Recomputes the velocities of all bodies from the impulses, so that round-off does not accumulate.
    void refresh_velocities();

    // Natural map (natural_map.h) at the present velocities.
    double residual(ThreadTeam &team) const;

    std::size_t      n_blocks() const { return blocks_.size(); }
    std::size_t      n_batches() const;
    std::vector<int> order() const; // rows in the order of a sweep

  private:
    static constexpr int idle_every = 5;

    struct Part
    {
      std::vector<ContactBatch>       batches;
      std::vector<RollingBatch>       rolling;       // one per batch; empty: no couples
      std::vector<TermBatch>          terms;         // one per batch; empty: all zero
      std::vector<std::array<int, 4>> rows;          // -1 in an empty lane
      std::size_t                     n_awake   = 0; // number of batches before the idle ones
      int                             idle_body = 0; // body of the part's empty lanes
    };

    // Consecutive blocks or gaps between them.
    struct Range
    {
      int begin = 0, end = 0;
    };

    // Where the blocks of this process meet those of a neighbour: the gap and the bodies whose velocities pass it.
    struct Border
    {
      int              gap       = -1; // -1: there is none
      int              neighbour = 0;
      std::vector<int> bodies;
    };

    // A row and its bodies, apart because packing reads them often. An immovable body b is -1 - b.
    struct Ends
    {
      int row, i, j;
    };

    bool                           fits_a_batch(const ContactRow &row) const;
    bool                           cut(const std::vector<Ends> &rows, int n_blocks);
    Part                           make_part(const std::vector<Ends> &rows);
    void                           pack(const std::vector<Ends> &rows, Part &part, std::vector<int> &own);
    void                           fill_lane(Part &part, int lane, int row) const;
    NaturalMapSquares              residual_squares(const Part &part) const;
    void                           sweep_part(Part &part, double omega_sticking, double omega_slipping, bool with_idle);
    static void                    wake(Part &part);
    void                           sweep_rest(double omega_sticking, double omega_slipping);
    void                           follow_lattice();
    template <class Function> void for_each_part(Function &&function);

    Range        blocks_of(int process) const;
    Range        gaps_of(int process) const;
    static Range share_of(Range own, int rank, int n_threads, int sweep);
    void         divide();
    Border       border_at(int gap, int neighbour) const;
    void         send(const Border &border);
    void         receive(const Border &border);
    void         exchange(const SharedEntries &bodies);

    const ContactProblem &problem_;
    std::vector<Part>     blocks_, between_; // between_[b] lies between blocks b and b + 1
    std::vector<int>      rest_;             // rows taken one by one, then the held rows
    std::size_t           n_swept_rest_ = 0; // without the held rows
    std::vector<Impulse>  rest_impulses_;
    // Velocities of all bodies of the problem, followed for each part by its copies of the immovable bodies. The copies keep two
    // threads from writing to the same body.
    std::vector<BodyVelocity> v_;
    std::vector<int>          batch_of_;                                // last batch that used each body, while a part is made
    std::vector<char>         is_idle_;                                 // rows that count as open
    bool                      has_couples_ = false, has_terms_ = false; // of any row

    Processes &processes_;
    Border     lower_, upper_; // of this process
    // What each process sweeps: parts (blocks, then gaps), their rows and bodies, and bodies of rows taken one by one. Empty for
    // a single process.
    SharedEntries parts_, rows_, bodies_, rest_bodies_;
  };
} // namespace diptych::discrete
