// diptych: four independent contacts at a time in vector registers
// SPDX-License-Identifier: LGPL-2.1-or-later
#include "discrete/solvers/batch_kernel.h"

#include "discrete/contacts/contact_law.h"
#include "discrete/contacts/four_lanes.h"

namespace diptych::discrete
{
  namespace
  {
    // Four body records as columns: x, y, surface speed and inverse mass of the four lanes.
    struct Bodies
    {
      Four x, y, surface, inverse_mass;
    };

    DIPTYCH_INLINE Bodies gather(const BodyVelocity *v, const int *index)
    {
      Bodies b{read(v + index[0]), read(v + index[1]), read(v + index[2]), read(v + index[3])};
      transpose(b.x, b.y, b.surface, b.inverse_mass);
      return b;
    }

    DIPTYCH_INLINE void scatter(Bodies b, BodyVelocity *v, const int *index)
    {
      transpose(b.x, b.y, b.surface, b.inverse_mass);
      write(v + index[0], b.x);
      write(v + index[1], b.y);
      write(v + index[2], b.surface);
      write(v + index[3], b.inverse_mass);
    }

    DIPTYCH_INLINE Parts<Four> impulses_of(const ContactBatch &c)
    {
      return {read(c.normal), read(c.tangential)};
    }

    DIPTYCH_INLINE Parts<Four> local_solution(const ContactBatch &c,
                                              const BatchExtras  *extras,
                                              const Bodies       &bi,
                                              const Bodies       &bj,
                                              const double        sticking,
                                              const double        slipping)
    {
      const Four           zero{}, inverse_wnn = read(c.inverse_wnn);
      const LawTerms<Four> terms{read(c.normal_term), extras ? read(extras->tangential_term) : zero, read(c.friction),
                                 inverse_wnn, extras ? read(extras->inverse_wtt) : inverse_wnn * disc_wnn_over_wtt};
      const Parts<Four>    r = impulses_of(c);
      Parts<Four>          u = relative_velocity(read(c.nx), read(c.ny), bi.x - bj.x, bi.y - bj.y, bi.surface, bj.surface);
      if (extras)
        u = {u.normal + read(extras->normal_compliance) * r.normal,
             u.tangential + read(extras->tangential_compliance) * r.tangential};
      return signorini_coulomb(terms, u, r, relaxation(terms.friction, r, zero + sticking, zero + slipping));
    }

    DIPTYCH_INLINE void apply(const ContactBatch &c, const Parts<Four> &dr, Bodies &bi, Bodies &bj)
    {
      const auto [px, py] = as_vector(read(c.nx), read(c.ny), dr);
      bi.x += bi.inverse_mass * px;
      bi.y += bi.inverse_mass * py;
      bi.surface -= 2 * bi.inverse_mass * dr.tangential;
      bj.x -= bj.inverse_mass * px;
      bj.y -= bj.inverse_mass * py;
      bj.surface -= 2 * bj.inverse_mass * dr.tangential;
    }

    DIPTYCH_INLINE void update(ContactBatch &c, const BatchExtras *extras, const double sticking, const double slipping, BodyVelocity *v)
    {
      Bodies            bi = gather(v, c.i), bj = gather(v, c.j);
      const Parts<Four> r = local_solution(c, extras, bi, bj, sticking, slipping);
      apply(c, {r.normal - read(c.normal), r.tangential - read(c.tangential)}, bi, bj);
      scatter(bi, v, c.i);
      scatter(bj, v, c.j);
      write(c.normal, r.normal);
      write(c.tangential, r.tangential);
    }
  } // namespace

  DIPTYCH_FOR_EACH_MACHINE void sweep_batches(ContactBatch                *batches,
                                              const BatchExtras *extras,
                                              const std::size_t            n,
                                              const double                 sticking,
                                              const double                 slipping,
                                              BodyVelocity                *v)
  {
    if (extras)
      for (std::size_t b = 0; b < n; ++b)
        update(batches[b], extras + b, sticking, slipping, v);
    else
      for (std::size_t b = 0; b < n; ++b)
        update(batches[b], nullptr, sticking, slipping, v);
  }

  DIPTYCH_FOR_EACH_MACHINE void add_impulses(const ContactBatch *batches, const std::size_t n, BodyVelocity *v)
  {
    for (std::size_t b = 0; b < n; ++b)
      {
        const ContactBatch &c  = batches[b];
        Bodies              bi = gather(v, c.i), bj = gather(v, c.j);
        apply(c, impulses_of(c), bi, bj);
        scatter(bi, v, c.i);
        scatter(bj, v, c.j);
      }
  }

  DIPTYCH_FOR_EACH_MACHINE void add_squares(const ContactBatch          *batches,
                                            const BatchExtras *extras,
                                            const std::size_t            n,
                                            const BodyVelocity          *v,
                                            double                      *difference,
                                            double                      *norm)
  {
    Four d{}, s{};
    for (std::size_t b = 0; b < n; ++b)
      {
        const ContactBatch &c  = batches[b];
        const Bodies        bi = gather(v, c.i), bj = gather(v, c.j);
        const Parts<Four>   p  = local_solution(c, extras ? extras + b : nullptr, bi, bj, 1., 1.);
        const Four          rn = read(c.normal), rt = read(c.tangential);
        d += (rn - p.normal) * (rn - p.normal) + (rt - p.tangential) * (rt - p.tangential);
        s += rn * rn + rt * rt;
      }
    for (int lane = 0; lane < lanes; ++lane)
      {
        *difference += d[lane];
        *norm += s[lane];
      }
  }
} // namespace diptych::discrete
