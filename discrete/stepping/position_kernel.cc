// diptych: parts overlapping discs, four independent pairs at a time
// SPDX-License-Identifier: LGPL-2.1-or-later
#include "discrete/stepping/position_kernel.h"

#include "discrete/contacts/four_lanes.h"

namespace diptych::discrete
{
  namespace
  {
    // Four discs as columns.
    struct Discs
    {
      Four x, y, radius, inverse_mass;
    };

    DIPTYCH_INLINE Discs gather(const Disc *discs, const int *index)
    {
      Discs d{read(discs + index[0]), read(discs + index[1]), read(discs + index[2]), read(discs + index[3])};
      transpose(d.x, d.y, d.radius, d.inverse_mass);
      return d;
    }

    DIPTYCH_INLINE void scatter(Discs d, Disc *discs, const int *index)
    {
      transpose(d.x, d.y, d.radius, d.inverse_mass);
      write(discs + index[0], d.x), write(discs + index[1], d.y);
      write(discs + index[2], d.radius), write(discs + index[3], d.inverse_mass);
    }

    DIPTYCH_INLINE Four square_root(const Four &a)
    {
      return Four{std::sqrt(a[0]), std::sqrt(a[1]), std::sqrt(a[2]), std::sqrt(a[3])};
    }

    // make_contact() and the shares of position_projection.cc on four pairs of grains.
    DIPTYCH_INLINE void part(const FourPairs &pairs, Disc *discs, Four &worst)
    {
      const Four zero{}, one = zero + 1;
      Discs      a = gather(discs, pairs.i), b = gather(discs, pairs.j);
      const Four dx = a.x - b.x, dy = a.y - b.y, distance = square_root(dx * dx + dy * dy);
      const Four gap = distance - a.radius - b.radius, sum = a.inverse_mass + b.inverse_mass;
      const auto closed  = gap<zero, mobile = sum != zero, apart = distance> zero;
      const Four divisor = apart ? distance : one, mobility = mobile ? sum : one;
      const Four nx = apart ? dx / divisor : one, ny = apart ? dy / divisor : zero;
      const auto moved  = closed & mobile;
      const Four step_a = gap * a.inverse_mass / mobility, step_b = gap * b.inverse_mass / mobility;
      a.x   = moved ? a.x - step_a * nx : a.x;
      a.y   = moved ? a.y - step_a * ny : a.y;
      b.x   = moved ? b.x + step_b * nx : b.x;
      b.y   = moved ? b.y + step_b * ny : b.y;
      worst = moved & (worst < -gap) ? -gap : worst;
      scatter(a, discs, pairs.i);
      scatter(b, discs, pairs.j);
    }
  } // namespace

  DIPTYCH_FOR_EACH_MACHINE double part_discs(const FourPairs *pairs, const std::size_t n, Disc *discs, const double worst)
  {
    Four largest = Four{} + worst;
    for (std::size_t k = 0; k < n; ++k)
      part(pairs[k], discs, largest);
    double result = worst;
    for (int lane = 0; lane < pairs_at_once; ++lane)
      result = largest[lane] > result ? largest[lane] : result;
    return result;
  }
} // namespace diptych::discrete
