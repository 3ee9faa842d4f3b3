// diptych: unilateral contact with dry friction, solved for one contact
// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <algorithm>
#include <cmath>
#include <limits>

#include "discrete/contacts/contact_problem.h"
#include "discrete/contacts/inlining.h"

namespace diptych::discrete
{
  // W_nn / W_tt of two discs, or of a disc and a body that nothing moves: r^2/I = 2/m adds twice each inverse mass.
  inline constexpr double disc_wnn_over_wtt = 1. / 3;

  // Normal and tangential part. The law is written once, for one contact (Number: double) and for four contacts in vector
  // registers. In registers a comparison selects lane by lane.
  template <class Number> struct Parts
  {
    Number normal, tangential;
  };
  using RelativeVelocity = Parts<double>; // u = H^T v of one contact

  template <class Number> struct LawTerms
  {
    Number normal_term, tangential_term, friction, inverse_wnn, inverse_wtt;
  };

  template <class Number> DIPTYCH_INLINE Number larger(const Number a, const Number b)
  {
    return a < b ? b : a;
  }

  template <class Number> DIPTYCH_INLINE Number smaller(const Number a, const Number b)
  {
    return b < a ? b : a;
  }

  template <class Number> DIPTYCH_INLINE Number size_of(const Number a)
  {
    return a < Number{} ? -a : a;
  }

  // Signorini-Coulomb with all other contacts held (Moreau 1988; Jean 1999). omega = 1 is the exact solution:
  //   r_n' = max(0, r_n - omega (u_n + c_n)/W_nn),
  //   r_t' = r_t - omega (u_t + c_t)/W_tt clamped to +-mu r_n'.
  template <class Number>
  DIPTYCH_INLINE Parts<Number> signorini_coulomb(const LawTerms<Number> &c,
                                                 const Parts<Number>    &u,
                                                 const Parts<Number>    &r,
                                                 const Number            omega)
  {
    const Number normal = larger(Number{}, r.normal - omega * (u.normal + c.normal_term) * c.inverse_wnn);
    const Number bound  = c.friction * normal;
    const Number stick  = r.tangential - omega * (u.tangential + c.tangential_term) * c.inverse_wtt;
    return {normal, smaller(bound, larger(-bound, stick))};
  }

  // A contact at its Coulomb bound takes omega `slipping`. The margin absorbs the rounding of mu r_n.
  inline constexpr double coulomb_margin = 0.9999;

  template <class Number>
  DIPTYCH_INLINE Number relaxation(const Number friction, const Parts<Number> &r, const Number sticking, const Number slipping)
  {
    return size_of(r.tangential) > coulomb_margin * friction * r.normal ? slipping : sticking;
  }

  // Relative velocity u from the velocity difference of the bodies and their surface speeds. Below it: x and y of an impulse.
  template <class Number>
  DIPTYCH_INLINE Parts<Number> relative_velocity(const Number nx,
                                                 const Number ny,
                                                 const Number dx,
                                                 const Number dy,
                                                 const Number si,
                                                 const Number sj)
  {
    return {nx * dx + ny * dy, nx * dy - ny * dx - si - sj};
  }

  template <class Number> DIPTYCH_INLINE Parts<Number> as_vector(const Number nx, const Number ny, const Parts<Number> &r)
  {
    return {nx * r.normal - ny * r.tangential, ny * r.normal + nx * r.tangential};
  }

  // `v` holds all bodies of the problem.
  inline RelativeVelocity relative_velocity(const ContactRow &c, const std::vector<BodyVelocity> &v)
  {
    const BodyVelocity &vi = v[c.i], &vj = v[c.j];
    const double        dx = vi.x - vj.x - (c.cell >= 0 ? c.image * v[c.cell].x : 0.), dy = vi.y - vj.y;
    return relative_velocity(c.nx, c.ny, dx, dy, vi.surface, vj.surface);
  }

  inline Impulse local_solution(const ContactRow &c, const RelativeVelocity &u, const Impulse &r, const double omega)
  {
    const LawTerms<double> terms{c.normal_term, c.tangential_term, c.friction, c.inverse_wnn, c.inverse_wtt};
    const Parts<double>    give{u.normal + c.normal_compliance * r.normal, u.tangential + c.tangential_compliance * r.tangential};
    const Parts<double>    solution = signorini_coulomb(terms, give, {r.normal, r.tangential}, omega);
    return {solution.normal, solution.tangential};
  }

  // Prefetches the row some contacts ahead of acting[at]: no hardware prefetcher can foresee which rows act.
  DIPTYCH_INLINE void fetch_ahead(const std::vector<ContactRow> &rows, const std::vector<int> &acting, const std::size_t at)
  {
    constexpr std::size_t ahead = 12;
    const char           *row   = reinterpret_cast<const char *>(&rows[acting[std::min(at + ahead, acting.size() - 1)]]);
    __builtin_prefetch(row);
  }

  // Adds M^-1 H dr of one contact to the velocities of its bodies.
  inline void apply_impulse(const ContactRow &c, const Impulse &dr, std::vector<BodyVelocity> &v)
  {
    const auto [px, py] = as_vector(c.nx, c.ny, Parts<double>{dr.normal, dr.tangential});
    BodyVelocity &vi = v[c.i], &vj = v[c.j];
    vi.x += vi.inverse_mass * px;
    vi.y += vi.inverse_mass * py;
    vi.surface -= c.ki * dr.tangential;
    vj.x -= c.jx * px;
    vj.y -= c.jy * py;
    vj.surface -= c.kj * dr.tangential;
    if (c.cell >= 0)
      v[c.cell].x -= c.image * v[c.cell].inverse_mass * px;
  }

  inline void update(const ContactRow &c, const double omega, std::vector<BodyVelocity> &v, Impulse &r)
  {
    const Impulse next = local_solution(c, relative_velocity(c, v), r, omega);
    apply_impulse(c, {next.normal - r.normal, next.tangential - r.tangential}, v);
    r = next;
  }

  inline bool is_slipping(const double friction, const Impulse &r)
  {
    return std::abs(r.tangential) > coulomb_margin * friction * r.normal;
  }

  inline double relative_norm(const double difference_square, const double norm_square)
  {
    if (difference_square == 0)
      return 0;
    return norm_square > 0 ? std::sqrt(difference_square / norm_square) : std::numeric_limits<double>::infinity();
  }

  // Sums of |r - P(r)|^2 and |r|^2, where P solves each contact for itself.
  struct NaturalMapSquares
  {
    double difference = 0, norm = 0;

    void add(const ContactRow &c, const std::vector<BodyVelocity> &v, const Impulse &r)
    {
      const Impulse p = local_solution(c, relative_velocity(c, v), r, 1.);
      difference += (r.normal - p.normal) * (r.normal - p.normal) + (r.tangential - p.tangential) * (r.tangential - p.tangential);
      norm += r.normal * r.normal + r.tangential * r.tangential;
    }
  };
} // namespace diptych::discrete
