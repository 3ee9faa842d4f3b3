// diptych: a few contacts solved together and exactly, where sweeps from one to the next find no end
// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <vector>

#include "discrete/contact_problem.h"
#include "discrete/solvers/complementarity.h"

namespace diptych::discrete
{
  // Signorini and Coulomb on n contacts, all others held, as a linear complementarity problem of 3 n pairs (Pfeiffer & Glocker
  // 1996):
  //   r_n >= 0 _|_ u_n + c_n >= 0,   mu r_n + r_t >= 0 _|_ s+ >= 0,   mu r_n - r_t >= 0 _|_ s- >= 0,   s+ - s- = u_t + c_t.
  // Pivots reach solutions which no sweep can stay at, because sliding contacts make them unstable for every order and omega.
  class ExactPatch
  {
  public:
    ExactPatch(const ContactProblem &problem, std::vector<int> rows); // the problem must outlive this

    const std::vector<int> &rows() const { return rows_; }

    // Replaces `impulses` (one a row) by a solution for the velocities `v`, which contain them and follow the change. False, with
    // nothing changed, where the pivots find none.
    [[nodiscard]] bool solve(std::vector<BodyVelocity> &v, Impulse *impulses);

    double work() const; // multiplications in all pivots so far

  private:
    void add_impulses(const Impulse *impulses, double factor, std::vector<BodyVelocity> &v) const;

    const ContactProblem &problem_;
    std::vector<int>      rows_;
    double                mobility_; // mean W_nn, by which A is divided [1/mass]
    LinearComplementarity pairs_;
  };

  // The contacts on which nine tenths of |r - P(r)|^2 lie, with all others of their grains that end on one of these grains or on
  // a body which stands, and those in `held`; sorted into sets that share no moving body. None where they would be more than 250:
  // then the sweeps do not stall on a few contacts.
  std::vector<std::vector<int>> stalled_contacts(const ContactProblem       &problem,
                                                 const std::vector<Impulse> &impulses,
                                                 const std::vector<int>     &held);
} // namespace diptych::discrete
