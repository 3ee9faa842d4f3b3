// diptych: unilateral contact with dry friction, the solution of one contact for itself
// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <algorithm>
#include <cmath>
#include <limits>

#include "discrete/contact_problem.h"

namespace diptych::discrete
{
  // W_nn / W_tt of two discs, or of a disc and a body that nothing moves: r^2/I = 2/m adds twice each inverse mass.
  inline constexpr double disc_wnn_over_wtt = 1. / 3;

  // u = H^T v of one contact.
  struct RelativeVelocity
  {
    double normal, tangential;
  };

  // `v` holds all bodies of the problem.
  inline RelativeVelocity relative_velocity(const ContactRow &c, const std::vector<BodyVelocity> &v)
  {
    const BodyVelocity &vi = v[c.i], &vj = v[c.j];
    const double        dx = vi.x - vj.x - (c.cell >= 0 ? c.image * v[c.cell].x : 0.), dy = vi.y - vj.y;
    return {c.nx * dx + c.ny * dy, c.nx * dy - c.ny * dx - vi.surface - vj.surface};
  }

  // Signorini-Coulomb with the other contacts held (Moreau 1988; Jean 1999); omega = 1 is the exact solution:
  //   r_n' = max(0, r_n - omega (u_n + c_n)/W_nn),
  //   r_t' = r_t - omega (u_t + c_t)/W_tt clamped to +-mu r_n'.
  inline Impulse local_solution(const ContactRow &c, const RelativeVelocity &u, const Impulse &r, const double omega)
  {
    const double normal = std::max(0., r.normal - omega * (u.normal + c.normal_term) * c.inverse_wnn);
    const double bound  = c.friction * normal;
    const double stick  = r.tangential - omega * (u.tangential + c.tangential_term) * c.inverse_wtt;
    return {normal, std::min(bound, std::max(-bound, stick))};
  }

  // Asks for the row some contacts ahead of acting[at], as far as velocities need it: after the sweeps rows are far from the
  // processor, and acting ones lie apart by no pattern that it would see by itself.
  inline __attribute__((always_inline)) void fetch_ahead(const std::vector<ContactRow> &rows,
                                                         const std::vector<int>        &acting,
                                                         const std::size_t              at)
  {
    constexpr std::size_t ahead = 12;
    const char           *row   = reinterpret_cast<const char *>(&rows[acting[std::min(at + ahead, acting.size() - 1)]]);
    __builtin_prefetch(row);
  }

  // Adds M^-1 H dr of one contact to the velocities of its bodies.
  inline void apply_impulse(const ContactRow &c, const Impulse &dr, std::vector<BodyVelocity> &v)
  {
    const double  px = c.nx * dr.normal - c.ny * dr.tangential, py = c.ny * dr.normal + c.nx * dr.tangential;
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

  // Gives one contact its local solution; impulse and velocities follow.
  inline void update(const ContactRow &c, const double omega, std::vector<BodyVelocity> &v, Impulse &r)
  {
    const Impulse next = local_solution(c, relative_velocity(c, v), r, omega);
    apply_impulse(c, {next.normal - r.normal, next.tangential - r.tangential}, v);
    r = next;
  }

  // A contact at its Coulomb bound. The margin absorbs the rounding of mu r_n.
  inline constexpr double coulomb_margin = 0.9999;

  inline bool is_slipping(const double friction, const Impulse &r)
  {
    return std::abs(r.tangential) > coulomb_margin * friction * r.normal;
  }

  // Norm of r - P(r) relative to that of r, from their squares: 0 where nothing acts and nothing should, infinity where only the
  // difference does not vanish.
  inline double relative_norm(const double difference_square, const double norm_square)
  {
    if (difference_square == 0)
      return 0;
    return norm_square > 0 ? std::sqrt(difference_square / norm_square) : std::numeric_limits<double>::infinity();
  }

  // |r - P(r)|^2 and |r|^2 of one contact for itself, summed.
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
