// diptych: four independent contacts at a time in vector registers
// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <array>
#include <cstddef>

#include "discrete/contacts/contact_problem.h"

namespace diptych::discrete
{
  inline constexpr int lanes = 4;

  // Four contacts that share no moving body (256 bytes). ki, kj and W_tt follow from the inverse masses of discs: k = 2/m and
  // W_tt = 3 W_nn. Empty lanes act on a body that does not move.
  struct alignas(64) ContactBatch
  {
    double nx[lanes], ny[lanes], normal_term[lanes], friction[lanes], inverse_wnn[lanes], normal[lanes], tangential[lanes];
    int    i[lanes], j[lanes];
  };

  // Their couples, apart because few samples have them. Members as in ContactRow and Impulse.
  struct alignas(64) RollingBatch
  {
    double friction[lanes], arm[lanes], inverse_wmm[lanes], rolling[lanes];
  };

  // The three functions take n batches, their couples (null: none) and the velocities of all bodies. `terms` are the tangential
  // terms of the lanes (null: all zero).

  // One over-relaxed pass. Impulses at their bound (before the pass) take `slipping`.
  void sweep_batches(ContactBatch                    *batches,
                     RollingBatch                    *rolling,
                     const std::array<double, lanes> *terms,
                     std::size_t                      n,
                     double                           sticking,
                     double                           slipping,
                     BodyVelocity                    *v);

  // v += M^-1 H r.
  void add_impulses(const ContactBatch *batches, const RollingBatch *rolling, std::size_t n, BodyVelocity *v);

  // Adds the squares of |r - P(r)| and of |r| to `difference` and `norm`.
  void add_squares(const ContactBatch              *batches,
                   const RollingBatch              *rolling,
                   const std::array<double, lanes> *terms,
                   std::size_t                      n,
                   const BodyVelocity              *v,
                   double                          *difference,
                   double                          *norm);
} // namespace diptych::discrete
