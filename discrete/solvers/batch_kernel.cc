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
                                              const TermBatch    *more,
                                              const Bodies       &bi,
                                              const Bodies       &bj,
                                              const Relaxation    omega)
    {
      const Four           zero{}, inverse_wnn = read(c.inverse_wnn);
      const LawTerms<Four> terms{read(c.normal_term), more ? read(more->tangential_term) : zero, read(c.friction), inverse_wnn,
                                 more ? read(more->inverse_wtt) : inverse_wnn * disc_wnn_over_wtt};
      const Parts<Four>    r = impulses_of(c);
      Parts<Four>          u = relative_velocity(read(c.nx), read(c.ny), bi.x - bj.x, bi.y - bj.y, bi.surface, bj.surface);
      if (more)
        u = with_give(u, {read(more->normal_compliance), read(more->tangential_compliance)}, r);
      return signorini_coulomb(terms, u, r, relaxation(terms.friction, r.normal, r.tangential, omega));
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

    // Rolling velocity after the tangential impulse changed, with the give of the springs.
    DIPTYCH_INLINE Four rolling_velocity_of(const RollingBatch &m, const TermBatch *more, const Bodies &bi, const Bodies &bj)
    {
      const Four w = rolling_velocity(read(m.arm), bi.surface, bj.surface);
      return more ? w + (read(more->rolling_term) + read(more->tangential_compliance) * read(m.rolling)) : w;
    }

    DIPTYCH_INLINE Four
    local_couple(const RollingBatch &m, const Four w, const Four old_normal, const Four normal, const Relaxation omega)
    {
      const Four               r = read(m.rolling);
      const RollingTerms<Four> terms{read(m.friction), read(m.arm), read(m.inverse_wmm)};
      return rolling_resistance(terms, w, r, normal, relaxation(terms.friction, old_normal, r, omega));
    }

    DIPTYCH_INLINE void apply_couple(const RollingBatch &m, const Four dr, Bodies &bi, Bodies &bj)
    {
      const Four arm = read(m.arm);
      bi.surface += 2 * bi.inverse_mass * arm * dr;
      bj.surface -= 2 * bj.inverse_mass * (1 - arm) * dr;
    }

    DIPTYCH_INLINE void update(ContactBatch &c, RollingBatch *m, const TermBatch *more, const Relaxation omega, BodyVelocity *v)
    {
      Bodies            bi = gather(v, c.i), bj = gather(v, c.j);
      const Four        old_normal = read(c.normal);
      const Parts<Four> r          = local_solution(c, more, bi, bj, omega);
      apply(c, {r.normal - old_normal, r.tangential - read(c.tangential)}, bi, bj);
      if (m)
        {
          const Four couple = local_couple(*m, rolling_velocity_of(*m, more, bi, bj), old_normal, r.normal, omega);
          apply_couple(*m, couple - read(m->rolling), bi, bj);
          write(m->rolling, couple);
        }
      scatter(bi, v, c.i);
      scatter(bj, v, c.j);
      write(c.normal, r.normal);
      write(c.tangential, r.tangential);
    }
  } // namespace

  DIPTYCH_FOR_EACH_MACHINE void sweep_batches(ContactBatch     *batches,
                                              RollingBatch     *rolling,
                                              const TermBatch  *terms,
                                              const std::size_t n,
                                              const double      sticking,
                                              const double      slipping,
                                              BodyVelocity     *v)
  {
    if (rolling)
      for (std::size_t b = 0; b < n; ++b)
        update(batches[b], rolling + b, terms ? terms + b : nullptr, {sticking, slipping}, v);
    else if (terms)
      for (std::size_t b = 0; b < n; ++b)
        update(batches[b], nullptr, terms + b, {sticking, slipping}, v);
    else
      for (std::size_t b = 0; b < n; ++b)
        update(batches[b], nullptr, nullptr, {sticking, slipping}, v);
  }

  DIPTYCH_FOR_EACH_MACHINE void add_impulses(const ContactBatch *batches,
                                             const RollingBatch *rolling,
                                             const std::size_t   n,
                                             BodyVelocity       *v)
  {
    for (std::size_t b = 0; b < n; ++b)
      {
        const ContactBatch &c  = batches[b];
        Bodies              bi = gather(v, c.i), bj = gather(v, c.j);
        apply(c, impulses_of(c), bi, bj);
        if (rolling)
          apply_couple(rolling[b], read(rolling[b].rolling), bi, bj);
        scatter(bi, v, c.i);
        scatter(bj, v, c.j);
      }
  }

  DIPTYCH_FOR_EACH_MACHINE void add_squares(const ContactBatch *batches,
                                            const RollingBatch *rolling,
                                            const TermBatch    *terms,
                                            const std::size_t   n,
                                            const BodyVelocity *v,
                                            double             *difference,
                                            double             *norm)
  {
    Four d{}, s{};
    for (std::size_t b = 0; b < n; ++b)
      {
        const ContactBatch &c    = batches[b];
        const TermBatch    *more = terms ? terms + b : nullptr;
        Bodies              bi = gather(v, c.i), bj = gather(v, c.j);
        const Parts<Four>   p  = local_solution(c, more, bi, bj, exact);
        const Four          rn = read(c.normal), rt = read(c.tangential);
        d += (rn - p.normal) * (rn - p.normal) + (rt - p.tangential) * (rt - p.tangential);
        s += rn * rn + rt * rt;
        if (!rolling)
          continue;
        apply(c, {Four{}, p.tangential - rt}, bi, bj); // only the spins count below
        const Four rm = read(rolling[b].rolling),
                   pm = local_couple(rolling[b], rolling_velocity_of(rolling[b], more, bi, bj), rn, p.normal, exact);
        d += (rm - pm) * (rm - pm);
        s += rm * rm;
      }
    for (int lane = 0; lane < lanes; ++lane)
      {
        *difference += d[lane];
        *norm += s[lane];
      }
  }
} // namespace diptych::discrete
