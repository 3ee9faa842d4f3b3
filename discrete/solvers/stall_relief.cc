// diptych: over-relaxed sweeps with extra sweeps over stalled contacts
// SPDX-License-Identifier: LGPL-2.1-or-later
#include "discrete/solvers/stall_relief.h"

#include <algorithm>

#include "discrete/solvers/stalled_contacts.h"

namespace diptych::discrete
{
  RelievedSweeps::RelievedSweeps(const ContactProblem &problem, const std::vector<Impulse> &impulses, Processes &processes)
      : problem_(problem),
        processes_(processes),
        batches_(std::make_unique<BatchedContacts>(problem, std::vector<int>{}, impulses, processes))
  {
    batches_->set_impulses(impulses);
  }

  // Sweeps the held contacts, then does two plain sweeps to smooth their surroundings. The held contacts come again at the end,
  // so that the residual shows the other contacts only.
  void RelievedSweeps::sweep(const double omega_sticking, const double omega_slipping, const int n, ThreadTeam &team)
  {
    const int  plain   = held_.empty() ? 0 : std::min(n, 2);
    const auto relieve = [&](std::vector<BodyVelocity> &v, Impulse *impulses) { sweep_alone(problem_, held_, v, impulses); };
    batches_->sweep(omega_sticking, omega_slipping, n - plain, team);
    if (held_.empty())
      return;
    batches_->solve_held(relieve);
    batches_->sweep(1, 1, plain, team);
    batches_->solve_held(relieve);
  }

  bool RelievedSweeps::relieve()
  {
    const std::vector<Impulse> impulses = batches_->impulses();
    std::vector<int>           stalled  = stalled_contacts(problem_, impulses, held_);
    if (stalled == held_)
      stalled.clear(); // a second time the same set does not help
    if (stalled != held_)
      {
        held_    = std::move(stalled);
        batches_ = std::make_unique<BatchedContacts>(problem_, held_, impulses, processes_);
        batches_->set_impulses(impulses);
      }
    return !held_.empty();
  }
} // namespace diptych::discrete
