// diptych: over-relaxed sweeps, four independent contacts at a time
// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <vector>

#include "discrete/contact_problem.h"

namespace diptych::discrete
{
  // The contacts of a problem in batches of four that share no moving body, in the order of the rows; a batch ends early
  // where the next row would share one. Within a batch the order does not matter, so a sweep has the same bits as
  // sweep_psor() row by row, on every machine and instruction set.
  class BatchedContacts
  {
  public:
    explicit BatchedContacts(const ContactProblem &problem);

    void                 set_impulses(const std::vector<Impulse> &impulses);
    std::vector<Impulse> impulses() const;

    // `v` as from velocities(); one more body, which does not move, is appended and used by empty lanes.
    void sweep(double omega_sticking, double omega_slipping, std::vector<BodyVelocity> &v);

    std::size_t n_batches() const { return batches_.size(); }

  private:
    static constexpr int lanes = 4;

    struct alignas(32) Batch
    {
      double nx[lanes], ny[lanes], normal_term[lanes], tangential_term[lanes], friction[lanes], inverse_wnn[lanes],
        inverse_wtt[lanes], ki[lanes], kj[lanes], normal[lanes], tangential[lanes];
      int i[lanes], j[lanes], row[lanes]; // row: -1 in an empty lane
    };

    std::vector<Batch> batches_;
    std::size_t        n_rows_;
  };
} // namespace diptych::discrete
