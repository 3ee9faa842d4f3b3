// diptych: four independent contacts at a time in vector registers
// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

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

  // Further columns of a batch, for contacts that have a tangential term or are compliant.
  struct alignas(64) BatchExtras
  {
    double tangential_term[lanes], inverse_wtt[lanes], normal_compliance[lanes], tangential_compliance[lanes];
  };

  // The three functions take n batches, their extras (null: none has any) and the velocities of all bodies.

  // One over-relaxed pass. Contacts at their Coulomb bound (by their old impulse) take `slipping`.
  void sweep_batches(ContactBatch                    *batches,
                     const BatchExtras  *extras,
                     std::size_t                      n,
                     double                           sticking,
                     double                           slipping,
                     BodyVelocity                    *v);

  // v += M^-1 H r.
  void add_impulses(const ContactBatch *batches, std::size_t n, BodyVelocity *v);

  // Adds the squares of |r - P(r)| and of |r| to `difference` and `norm`.
  void add_squares(const ContactBatch              *batches,
                   const BatchExtras  *extras,
                   std::size_t                      n,
                   const BodyVelocity              *v,
                   double                          *difference,
                   double                          *norm);
} // namespace diptych::discrete
