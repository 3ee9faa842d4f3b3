// diptych: over-relaxed sweeps, and exact patches where they stall
// SPDX-License-Identifier: LGPL-2.1-or-later
#include "discrete/solvers/patched_sweep.h"

#include <algorithm>

namespace diptych::discrete
{
  namespace
  {
    std::vector<int> joined(const std::vector<std::vector<int>> &sets)
    {
      std::vector<int> all;
      for (const std::vector<int> &set : sets)
        all.insert(all.end(), set.begin(), set.end());
      return all;
    }
  } // namespace

  PatchedSweeps::PatchedSweeps(const ContactProblem &problem, const std::vector<Impulse> &impulses)
      : problem_(problem),
        batches_(std::make_unique<BatchedContacts>(problem))
  {
    batches_->set_impulses(impulses);
  }

  // False where a patch has no solution, or where all together have cost as much as many sweeps.
  bool PatchedSweeps::solve_patches()
  {
    constexpr double sweeps = 10000, multiplications_of_an_update = 30;
    bool             solved = true;
    double           work   = 0;
    batches_->solve_held([&](std::vector<BodyVelocity> &v, Impulse *impulses) {
      for (ExactPatch &patch : patches_)
        {
          solved = patch.solve(v, impulses) && solved;
          work += patch.work();
          impulses += patch.rows().size();
        }
    });
    return solved && work < sweeps * multiplications_of_an_update * double(problem_.contacts.size());
  }

  // With patches: exact, then two plain sweeps to smooth what surrounds them, and exact again, for the residual to tell.
  void PatchedSweeps::sweep(const double omega_sticking, const double omega_slipping, const int n, ThreadTeam &team)
  {
    const int plain = patches_.empty() ? 0 : std::min(n, 2);
    batches_->sweep(omega_sticking, omega_slipping, n - plain, team);
    if (patches_.empty())
      return;
    given_up_ = !solve_patches();
    batches_->sweep(1, 1, plain, team);
    given_up_ = !solve_patches() || given_up_;
    if (given_up_)
      hold({});
  }

  int PatchedSweeps::n_patched() const
  {
    std::size_t n = 0;
    for (const ExactPatch &patch : patches_)
      n += patch.rows().size();
    return int(n);
  }

  void PatchedSweeps::hold(const std::vector<std::vector<int>> &sets)
  {
    const std::vector<Impulse> impulses = batches_->impulses();
    batches_                            = std::make_unique<BatchedContacts>(problem_, joined(sets));
    batches_->set_impulses(impulses);
    patches_.clear();
    for (const std::vector<int> &set : sets)
      patches_.emplace_back(problem_, set);
  }

  bool PatchedSweeps::patch_stalled()
  {
    if (given_up_)
      {
        given_up_ = false; // the next time may be another place
        return false;
      }
    std::vector<int> held;
    for (const ExactPatch &patch : patches_)
      held.insert(held.end(), patch.rows().begin(), patch.rows().end());
    const std::vector<std::vector<int>> sets = stalled_contacts(problem_, batches_->impulses(), held);
    if (!sets.empty() || !patches_.empty())
      hold(sets);
    return !sets.empty();
  }
} // namespace diptych::discrete
