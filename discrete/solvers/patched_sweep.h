// diptych: over-relaxed sweeps, and exact patches where they stall
// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <memory>
#include <vector>

#include "discrete/solvers/batched_sweep.h"
#include "discrete/solvers/exact_patch.h"

namespace diptych::discrete
{
  // The batched sweeps of a problem. Contacts on which they stall are taken out of the sweeps and solved together and exactly,
  // again and again between some sweeps of the others.
  class PatchedSweeps
  {
  public:
    PatchedSweeps(const ContactProblem &problem, const std::vector<Impulse> &impulses); // the problem must outlive this

    void                 sweep(double omega_sticking, double omega_slipping, int n, ThreadTeam &team);
    void                 refresh_velocities() { batches_->refresh_velocities(); }
    double               residual(ThreadTeam &team) const { return batches_->residual(team); }
    std::vector<Impulse> impulses() const { return batches_->impulses(); }

    // To be called where the sweeps stall. False where that is not on a few contacts, or where the last patches found no solution
    // or took too many pivots: all contacts are swept then.
    bool patch_stalled();

    int n_patched() const; // contacts

  private:
    bool solve_patches();
    void hold(const std::vector<std::vector<int>> &sets);

    const ContactProblem            &problem_;
    std::unique_ptr<BatchedContacts> batches_;
    std::vector<ExactPatch>          patches_;
    bool                             given_up_ = false;
  };
} // namespace diptych::discrete
