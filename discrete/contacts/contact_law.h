// diptych: unilateral contact with dry friction and rolling resistance, solved for one contact
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

  // Rolling resistance with all other contacts held, after the normal and tangential part of the same contact. `w` is the rolling
  // velocity that these leave: a tangential impulse changes the spins, and W_tm = (1 - a) k_j - a k_i is not 0. This order is
  // a Gauss-Seidel step within the contact. At a solution the other two parts do not change, so the residual is exactly 0 there.
  //   r_m' = r_m - omega w/W_mm clamped to +-mu_r (l/R) r_n', i.e. |couple| <= mu_r l r_n'.
  // Two discs have l = 2R, the harmonic mean of their radii; a disc on a plane has l = R = r. Equal discs thus have l = r, and a
  // disc stays on a slope whose tangent is below mu_r. A regular polygon of n sides that rolls over a plane lifts its centre by
  // R (1 - cos(pi/n)) per side and loses that energy, as a disc with mu_r = pi/(4n) does. Estrada, Azema, Radjai & Taboada (Phys.
  // Rev. E 84, 011306, 2011) compare discs with polygons so. Codes that bound the couple by mu R r_n (LAMMPS `rolling sds`, PFC)
  // have mu = 2 mu_r between discs and mu = mu_r at planes.
  template <class Number> struct RollingTerms
  {
    Number friction, arm, inverse_wmm;
  };

  template <class Number> DIPTYCH_INLINE Number rolling_velocity(const Number arm, const Number si, const Number sj)
  {
    return arm * si - (1 - arm) * sj;
  }

  template <class Number>
  DIPTYCH_INLINE Number
  rolling_resistance(const RollingTerms<Number> &c, const Number w, const Number r, const Number normal, const Number omega)
  {
    const Number bound = c.friction * normal;
    return smaller(bound, larger(-bound, r - omega * w * c.inverse_wmm));
  }

  // omega of a part of the impulse: `slipping` if the part is at its bound. The margin absorbs the rounding of mu r_n. The couple
  // has its own omega.
  struct Relaxation
  {
    double sticking, slipping;
  };
  inline constexpr Relaxation exact          = {1, 1};
  inline constexpr double     coulomb_margin = 0.9999;

  template <class Number>
  DIPTYCH_INLINE Number relaxation(const Number friction, const Number normal, const Number bounded, const Relaxation omega)
  {
    return size_of(bounded) > coulomb_margin * friction * normal ? Number{} + omega.slipping : Number{} + omega.sticking;
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
    double              dx = vi.x - vj.x, dy = vi.y - vj.y;
    if (c.image_body >= 0)
      {
        dx -= c.image.along * v[c.image_body].x;
        dy -= c.image.along * v[c.image_body].y;
      }
    if (c.image.upward != 0)
      {
        dx -= c.image.upward * v[c.image_body + 1].x;
        dy -= c.image.upward * v[c.image_body + 1].y;
      }
    return relative_velocity(c.nx, c.ny, dx, dy, vi.surface, vj.surface);
  }

  // Gives a row rolling resistance: its bound |r_m| / r_n and the arm of body i.
  inline void set_rolling(const double friction, const double arm, ContactRow &c)
  {
    const double wmm   = c.ki * arm * arm + c.kj * (1 - arm) * (1 - arm);
    c.rolling_friction = friction;
    c.rolling_arm      = arm;
    c.inverse_wmm      = wmm > 0 ? 1 / wmm : 0;
  }

  // u + C r: relative velocity and give of the springs.
  template <class Number>
  DIPTYCH_INLINE Parts<Number> with_give(const Parts<Number> &u, const Parts<Number> &compliance, const Parts<Number> &r)
  {
    return {u.normal + compliance.normal * r.normal, u.tangential + compliance.tangential * r.tangential};
  }

  inline RelativeVelocity velocity_with_give(const ContactRow &c, const std::vector<BodyVelocity> &v, const Impulse &r)
  {
    const RelativeVelocity u = relative_velocity(c, v);
    if (c.normal_compliance == 0)
      return u;
    return with_give(u, {c.normal_compliance, c.tangential_compliance}, {r.normal, r.tangential});
  }

  inline double rolling_velocity(const ContactRow &c, const std::vector<BodyVelocity> &v)
  {
    return rolling_velocity(c.rolling_arm, v[c.i].surface, v[c.j].surface);
  }

  // w + c_m + C r_m, with the rolling velocity w that is given.
  inline double rolling_with_give(const ContactRow &c, const double w, const Impulse &r)
  {
    return c.normal_compliance == 0 ? w : w + (c.rolling_term + c.tangential_compliance * r.rolling);
  }

  inline LawTerms<double> terms_of(const ContactRow &c)
  {
    return {c.normal_term, c.tangential_term, c.friction, c.inverse_wnn, c.inverse_wtt};
  }

  // Normal and tangential part of the next impulse, and below it the couple.
  inline Parts<double> signorini_coulomb(const ContactRow                &c,
                                         const std::vector<BodyVelocity> &v,
                                         const Impulse                   &r,
                                         const Relaxation                 omega)
  {
    return signorini_coulomb(terms_of(c), velocity_with_give(c, v, r), {r.normal, r.tangential},
                             relaxation(c.friction, r.normal, r.tangential, omega));
  }

  // `w` is the rolling velocity after the tangential part changed, `normal` the new normal part.
  inline double rolling_resistance(const ContactRow &c,
                                   const double      w,
                                   const Impulse    &r,
                                   const double      normal,
                                   const Relaxation  omega)
  {
    return rolling_resistance({c.rolling_friction, c.rolling_arm, c.inverse_wmm}, rolling_with_give(c, w, r), r.rolling, normal,
                              relaxation(c.rolling_friction, r.normal, r.rolling, omega));
  }

  // Prefetches the row some contacts ahead of acting[at]: no hardware prefetcher can foresee which rows act.
  DIPTYCH_INLINE void fetch_ahead(const std::vector<ContactRow> &rows, const std::vector<int> &acting, const std::size_t at)
  {
    constexpr std::size_t ahead = 12;
    const char           *row   = reinterpret_cast<const char *>(&rows[acting[std::min(at + ahead, acting.size() - 1)]]);
    __builtin_prefetch(row);
  }

  inline void apply_couple(const ContactRow &c, const double dr, BodyVelocity &vi, BodyVelocity &vj)
  {
    vi.surface += c.ki * c.rolling_arm * dr;
    vj.surface -= c.kj * (1 - c.rolling_arm) * dr;
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
    if (c.image_body >= 0)
      v[c.image_body].x -= c.image.along * v[c.image_body].inverse_mass * px;
    if (dr.rolling != 0)
      apply_couple(c, dr.rolling, vi, vj);
  }

  inline void update(const ContactRow &c, const Relaxation omega, std::vector<BodyVelocity> &v, Impulse &r)
  {
    const Parts<double> next = signorini_coulomb(c, v, r, omega);
    apply_impulse(c, {next.normal - r.normal, next.tangential - r.tangential}, v);
    if (c.rolling_friction != 0)
      {
        const double rolling = rolling_resistance(c, rolling_velocity(c, v), r, next.normal, omega);
        apply_couple(c, rolling - r.rolling, v[c.i], v[c.j]);
        r.rolling = rolling;
      }
    r.normal     = next.normal;
    r.tangential = next.tangential;
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

  // Sums of squares of the velocities by which contacts violate their laws, of the velocities q that acting contacts have without
  // impulses, and of the velocities that their own impulses cause.
  struct VelocitySquares
  {
    double violated = 0, free = 0, caused = 0;

    // r: impulse; p: its solution of the contact by itself; q: free velocity with the terms of the law.
    void add(const LawTerms<double> &c, const Parts<double> &r, const Parts<double> &p, const RelativeVelocity &q)
    {
      const auto squares = [](const double a, const double b) { return a * a + b * b; };
      if (!(r.normal > 0 || p.normal > 0))
        return;
      violated += squares((r.normal - p.normal) / c.inverse_wnn, (r.tangential - p.tangential) / c.inverse_wtt);
      free += squares(q.normal, q.tangential);
      caused += squares(r.normal / c.inverse_wnn, r.tangential / c.inverse_wtt);
    }

    // The second part is round-off: grains at rest may press on each other without any free velocity.
    double relative() const
    {
      constexpr double round_off = 1e-14;
      return violated <= round_off * round_off * caused ? 0 : relative_norm(violated, free);
    }
  };

  // Sums of |r - P(r)|^2 and |r|^2, where P solves each contact for itself.
  struct NaturalMapSquares
  {
    double difference = 0, norm = 0;

    void add(const ContactRow &c, const std::vector<BodyVelocity> &v, const Impulse &r)
    {
      const Parts<double> p = signorini_coulomb(c, v, r, exact);
      difference += (r.normal - p.normal) * (r.normal - p.normal) + (r.tangential - p.tangential) * (r.tangential - p.tangential);
      norm += r.normal * r.normal + r.tangential * r.tangential;
      if (c.rolling_friction == 0)
        return;
      const double turn   = p.tangential - r.tangential;
      const double w      = rolling_velocity(c.rolling_arm, v[c.i].surface - c.ki * turn, v[c.j].surface - c.kj * turn);
      const double change = r.rolling - rolling_resistance(c, w, r, p.normal, exact);
      difference += change * change;
      norm += r.rolling * r.rolling;
    }
  };
} // namespace diptych::discrete
