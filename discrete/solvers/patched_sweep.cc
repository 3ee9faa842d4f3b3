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

  void PatchedSweeps::solve_patches()
  {
    batches_->solve_held([&](std::vector<BodyVelocity> &v, Impulse *impulses) {
      for (ExactPatch &patch : patches_)
        {
          patch.solve(v, impulses); // one without a solution keeps its impulses: the residual says so
          impulses += patch.rows().size();
        }
    });
  }

  // With patches: exact, then two plain sweeps to smooth what surrounds them, and exact again, for the residual to tell.
  void PatchedSweeps::sweep(const double omega_sticking, const double omega_slipping, const int n, ThreadTeam &team)
  {
    const int plain = patches_.empty() ? 0 : std::min(n, 2);
    batches_->sweep(omega_sticking, omega_slipping, n - plain, team);
    if (patches_.empty())
      return;
    solve_patches();
    batches_->sweep(1, 1, plain, team);
    solve_patches();
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
    std::vector<int> held;
    for (const ExactPatch &patch : patches_)
      held.insert(held.end(), patch.rows().begin(), patch.rows().end());
    const std::vector<std::vector<int>> sets = stalled_contacts(problem_, batches_->impulses(), held);
    if (!sets.empty() || !patches_.empty())
      hold(sets);
    return !sets.empty();
  }
} // namespace diptych::discrete
