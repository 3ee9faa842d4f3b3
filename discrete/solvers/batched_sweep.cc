// diptych: over-relaxed sweeps, four independent contacts at a time
// SPDX-License-Identifier: LGPL-2.1-or-later
#include "discrete/solvers/batched_sweep.h"

#include <algorithm>

// A sweep is compiled for 128- and 256-bit registers and chosen when the program starts. Without contraction and
// reassociation (see the build's flags) both give the same bits.
#if defined(__x86_64__) && defined(__GNUC__) && !defined(__clang__) && !defined(__SANITIZE_ADDRESS__)
#define DIPTYCH_FOR_EACH_REGISTER_WIDTH __attribute__((target_clones("avx2", "default")))
#else
#define DIPTYCH_FOR_EACH_REGISTER_WIDTH
#endif

namespace diptych::discrete
{
  namespace
  {
    typedef double    Four __attribute__((vector_size(32)));
    typedef long long Mask __attribute__((vector_size(32)));

    // Four body records as columns: x, y, surface, inverse mass of the four lanes.
    struct Bodies
    {
      Four x, y, surface, inverse_mass;
    };

#define DIPTYCH_INLINE inline __attribute__((always_inline))

    // Transposes a 4x4 block; its own inverse.
    DIPTYCH_INLINE void transpose(Four &a, Four &b, Four &c, Four &d)
    {
      const Four ab_low = __builtin_shuffle(a, b, Mask{0, 4, 2, 6}), ab_high = __builtin_shuffle(a, b, Mask{1, 5, 3, 7});
      const Four cd_low = __builtin_shuffle(c, d, Mask{0, 4, 2, 6}), cd_high = __builtin_shuffle(c, d, Mask{1, 5, 3, 7});
      a = __builtin_shuffle(ab_low, cd_low, Mask{0, 1, 4, 5});
      b = __builtin_shuffle(ab_high, cd_high, Mask{0, 1, 4, 5});
      c = __builtin_shuffle(ab_low, cd_low, Mask{2, 3, 6, 7});
      d = __builtin_shuffle(ab_high, cd_high, Mask{2, 3, 6, 7});
    }

    DIPTYCH_INLINE Four read(const void *p)
    {
      Four value;
      __builtin_memcpy(&value, p, sizeof value);
      return value;
    }

    DIPTYCH_INLINE void write(void *p, const Four &value)
    {
      __builtin_memcpy(p, &value, sizeof value);
    }

    DIPTYCH_INLINE Bodies gather(const BodyVelocity *v, const int *index)
    {
      Bodies b{read(v + index[0]), read(v + index[1]), read(v + index[2]), read(v + index[3])};
      transpose(b.x, b.y, b.surface, b.inverse_mass);
      return b;
    }

    DIPTYCH_INLINE void scatter(Bodies b, BodyVelocity *v, const int *index)
    {
      transpose(b.x, b.y, b.surface, b.inverse_mass);
      write(v + index[0], b.x), write(v + index[1], b.y), write(v + index[2], b.surface), write(v + index[3], b.inverse_mass);
    }

    // One batch: contact_law.h's local solution and update, line by line, on four contacts.
    template <class Batch> DIPTYCH_INLINE void update(Batch &c, const double sticking, const double slipping, BodyVelocity *v)
    {
      const Four zero{};
      Bodies     bi = gather(v, c.i), bj = gather(v, c.j);
      const Four nx = read(c.nx), ny = read(c.ny), mu = read(c.friction), rn = read(c.normal), rt = read(c.tangential);
      const Four dx = bi.x - bj.x, dy = bi.y - bj.y;
      const Four un = nx * dx + ny * dy, ut = nx * dy - ny * dx - bi.surface - bj.surface;

      const Four size_rt = rt < zero ? -rt : rt;
      const Four omega   = size_rt > 0.9999 * mu * rn ? zero + slipping : zero + sticking;

      const Four pushed     = rn - omega * (un + read(c.normal_term)) * read(c.inverse_wnn);
      const Four normal     = zero < pushed ? pushed : zero;
      const Four bound      = mu * normal;
      const Four stick      = rt - omega * (ut + read(c.tangential_term)) * read(c.inverse_wtt);
      const Four above      = -bound < stick ? stick : -bound;
      const Four tangential = above < bound ? above : bound;

      const Four dn = normal - rn, dt = tangential - rt;
      const Four px = nx * dn - ny * dt, py = ny * dn + nx * dt;
      bi.x += bi.inverse_mass * px, bi.y += bi.inverse_mass * py, bi.surface -= read(c.ki) * dt;
      bj.x -= bj.inverse_mass * px, bj.y -= bj.inverse_mass * py, bj.surface -= read(c.kj) * dt;
      scatter(bi, v, c.i);
      scatter(bj, v, c.j);
      write(c.normal, normal), write(c.tangential, tangential);
    }

    template <class Batch>
    DIPTYCH_FOR_EACH_REGISTER_WIDTH void sweep_batches(Batch            *batches,
                                                       const std::size_t n,
                                                       const double      sticking,
                                                       const double      slipping,
                                                       BodyVelocity     *v)
    {
      for (std::size_t b = 0; b < n; ++b)
        update(batches[b], sticking, slipping, v);
    }
  } // namespace

  BatchedContacts::BatchedContacts(const ContactProblem &problem)
      : n_rows_(problem.contacts.size())
  {
    const int        rest = int(problem.free_velocity.size()); // the body that empty lanes act upon
    std::vector<int> last_batch(rest, -1);                     // that touched a body
    int              filled = lanes;
    for (std::size_t k = 0; k < n_rows_; ++k)
      {
        const ContactRow &c      = problem.contacts[k];
        const auto        moves  = [&](const int body) { return problem.free_velocity[body].inverse_mass != 0; };
        const int         newest = int(batches_.size()) - 1;
        if (filled == lanes || (moves(c.i) && last_batch[c.i] == newest) || (moves(c.j) && last_batch[c.j] == newest))
          {
            batches_.push_back({});
            std::fill_n(batches_.back().i, lanes, rest), std::fill_n(batches_.back().j, lanes, rest);
            std::fill_n(batches_.back().row, lanes, -1);
            filled = 0;
          }
        Batch &batch     = batches_.back();
        batch.nx[filled] = c.nx, batch.ny[filled] = c.ny;
        batch.normal_term[filled] = c.normal_term, batch.tangential_term[filled] = c.tangential_term;
        batch.friction[filled]    = c.friction;
        batch.inverse_wnn[filled] = c.inverse_wnn, batch.inverse_wtt[filled] = c.inverse_wtt;
        batch.ki[filled] = c.ki, batch.kj[filled] = c.kj;
        batch.i[filled] = c.i, batch.j[filled] = c.j;
        batch.row[filled] = int(k);
        last_batch[c.i] = last_batch[c.j] = int(batches_.size()) - 1;
        ++filled;
      }
  }

  void BatchedContacts::set_impulses(const std::vector<Impulse> &impulses)
  {
    for (Batch &batch : batches_)
      for (int lane = 0; lane < lanes; ++lane)
        if (batch.row[lane] >= 0)
          {
            batch.normal[lane]     = impulses[batch.row[lane]].normal;
            batch.tangential[lane] = impulses[batch.row[lane]].tangential;
          }
  }

  std::vector<Impulse> BatchedContacts::impulses() const
  {
    std::vector<Impulse> result(n_rows_);
    for (const Batch &batch : batches_)
      for (int lane = 0; lane < lanes; ++lane)
        if (batch.row[lane] >= 0)
          result[batch.row[lane]] = {batch.normal[lane], batch.tangential[lane]};
    return result;
  }

  void BatchedContacts::sweep(const double omega_sticking, const double omega_slipping, std::vector<BodyVelocity> &v)
  {
    v.push_back({0, 0, 0, 0});
    sweep_batches(batches_.data(), batches_.size(), omega_sticking, omega_slipping, v.data());
    v.pop_back();
  }
} // namespace diptych::discrete
