// diptych: over-relaxed sweeps, four independent contacts at a time, on one thread or several
// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <array>
#include <vector>

#include "discrete/contacts/contact_law.h"
#include "discrete/solvers/batch_kernel.h"
#include "discrete/solvers/thread_team.h"

namespace diptych::discrete
{
  // The contacts of a problem cut, in the order of its sweeps, into blocks of about equal size that share no grain, and the
  // contacts between neighbouring blocks. A sweep takes all blocks, then all contacts between blocks, then the rows that do
  // not fit a batch (walls under a force, the edge of a free cell). Contacts that are open in the guess, a third of the rows
  // where grains are sheared, have batches of their own, which are swept every `idle_every` sweeps and at the last of a call
  // until one of the four acts. Blocks depend on nothing but the problem, so every number of threads gives the same bits; and
  // within a batch the order does not matter, so every instruction set does.
  class BatchedContacts
  {
  public:
    // The problem must outlive this. One too small or too tangled to be cut is one block. Rows in `held` are not swept. `guess`:
    // impulses by which contacts are thought to be open; none, or none that acts: all are thought to act.
    explicit BatchedContacts(const ContactProblem       &problem,
                             const std::vector<int>     &held  = {},
                             const std::vector<Impulse> &guess = {});

    void                 set_impulses(const std::vector<Impulse> &impulses); // one per row; velocities are taken from them
    std::vector<Impulse> impulses() const;

    // `n` sweeps. Contacts at their Coulomb bound (judged on their old impulse) take omega_slipping.
    void sweep(double omega_sticking, double omega_slipping, int n, ThreadTeam &team);

    // Calls solve(velocities, impulses of the held rows in the order given), which may change both, in step with each other.
    template <class Solve> void solve_held(Solve &&solve) { solve(v_, rest_impulses_.data() + n_swept_rest_); }

    const std::vector<BodyVelocity> &velocities() const { return v_; } // of the problem's bodies first

    // Velocities taken afresh from the impulses, so that round-off does not pile up.
    void refresh_velocities();

    // Natural map of contact_problem.h, for the present velocities.
    double residual(ThreadTeam &team) const;

    std::size_t      n_blocks() const { return blocks_.size(); }
    std::size_t      n_batches() const;
    std::vector<int> order() const; // rows in the order in which a sweep takes them

  private:
    static constexpr int idle_every = 5;

    // What one thread sweeps at a time.
    struct Part
    {
      std::vector<ContactBatch>          batches;
      std::vector<std::array<double, 4>> tangential_term; // one a batch; none: zero throughout
      std::vector<std::array<int, 4>>    rows;            // -1 in an empty lane
      std::size_t                        n_awake   = 0;   // batches before those that are idle
      int                                idle_body = 0;   // of the part's empty lanes
    };

    bool                           fits_a_batch(const ContactRow &row) const;
    bool                           cut(const std::vector<int> &rows, int n_blocks);
    Part                           make_part(const std::vector<int> &rows);
    void                           pack(const std::vector<int> &rows, Part &part, std::vector<int> &own);
    void                           fill_lane(Part &part, int lane, int row) const;
    NaturalMapSquares              residual_squares(const Part &part) const;
    void                           sweep_part(Part &part, double omega_sticking, double omega_slipping, bool with_idle);
    static void                    wake(Part &part);
    void                           sweep_rest(double omega_sticking, double omega_slipping);
    template <class Function> void for_each_part(Function &&function);

    const ContactProblem &problem_;
    std::vector<Part>     blocks_, between_; // between_[b] lies between blocks b and b + 1
    std::vector<int>      rest_;             // rows taken one by one, then those held
    std::size_t           n_swept_rest_ = 0; // without those held
    std::vector<Impulse>  rest_impulses_;
    // Velocities of all bodies of the problem, then for each part its own copies of the bodies that do not move, so that no
    // two threads write to one.
    std::vector<BodyVelocity> v_;
    std::vector<int>          batch_of_; // last batch that took each body, while a part is made
    std::vector<char>         is_idle_;  // rows thought open
  };
} // namespace diptych::discrete
