// diptych: over-relaxed sweeps with extra sweeps over stalled contacts
// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <memory>
#include <vector>

#include "discrete/solvers/batched_sweep.h"

namespace diptych::discrete
{
  // The batched sweeps of a problem. If a few contacts slow down the convergence, the solver regularly iterates these contacts
  // alone until they have almost converged. Between these iterations it sweeps over the other contacts.
  class RelievedSweeps
  {
  public:
    // The problem must outlive this.
    RelievedSweeps(const ContactProblem &problem, const std::vector<Impulse> &impulses, Processes &processes);

    void                             sweep(double omega_sticking, double omega_slipping, int n, ThreadTeam &team);
    void                             refresh_velocities() { batches_->refresh_velocities(); }
    double                           residual(ThreadTeam &team) const { return batches_->residual(team); }
    std::vector<Impulse>             impulses() const { return batches_->impulses(); }
    const std::vector<BodyVelocity> &velocities() const { return batches_->velocities(); }

    // To be called if the residual stagnates. Returns false if no few contacts are the cause; then all are swept alike.
    bool relieve();

    int n_relieved() const { return int(held_.size()); } // contacts that are iterated alone at present

  private:
    const ContactProblem            &problem_;
    Processes                       &processes_;
    std::unique_ptr<BatchedContacts> batches_;
    std::vector<int>                 held_; // rows
  };
} // namespace diptych::discrete
