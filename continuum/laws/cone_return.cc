// diptych: scalar return to a hardening cone, the kernel of all plastic laws
// SPDX-License-Identifier: LGPL-2.1-or-later
#include "continuum/laws/cone_return.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

namespace diptych::continuum
{
  namespace
  {
    struct PathPoint
    {
      double lambda;
      Cone   cone;
      double shear, shear_dot, pressure, pressure_dot;
      double yield, yield_dot; // F including its viscous part
    };

    class Path
    {
    public:
      Path(const YieldCone &cone, const ConeStart &start, const ReturnPath &path, const double viscous_modulus)
          : cone(cone),
            from(start),
            path(path),
            viscous_modulus(viscous_modulus)
      {}

      PathPoint at(const double lambda) const { return with(cone.over(from.hardening, lambda), lambda); }
      PathPoint start() const { return with(from.cone, 0); }

      // Beyond this multiplier t is not positive: the dilation lies between -1 and 1.
      double longest() const { return path.shear / (path.shear_loss - std::abs(path.shear_loss_by_dilation)); }

      // Whether the pressure may become negative before t does. Otherwise F is not positive where t = 0.
      bool may_reach_tip() const
      {
        const double least_gain = path.pressure_gain + path.pressure_gain_by_dilation * cone.least_dilation();
        return path.pressure + std::min(0., least_gain) * longest() < 0;
      }

    private:
      PathPoint with(const Cone &c, const double lambda) const
      {
        PathPoint    p;
        const double loss = path.shear_loss + path.shear_loss_by_dilation * c.dilation.value;
        const double gain = path.pressure_gain + path.pressure_gain_by_dilation * c.dilation.value;
        p.lambda          = lambda;
        p.cone            = c;
        p.shear           = path.shear - loss * lambda;
        p.shear_dot       = -loss - path.shear_loss_by_dilation * c.dilation.rate * lambda;
        p.pressure        = path.pressure + gain * lambda;
        p.pressure_dot    = gain + path.pressure_gain_by_dilation * c.dilation.rate * lambda;
        p.yield           = p.shear - p.pressure * c.slope.value - c.intercept.value - viscous_modulus * lambda;
        p.yield_dot       = p.shear_dot - p.pressure_dot * c.slope.value - p.pressure * c.slope.rate - c.intercept.rate -
                      viscous_modulus;
        return p;
      }

      const YieldCone  &cone;
      const ConeStart  &from;
      const ReturnPath &path;
      const double      viscous_modulus;
    };

    // A function along the path, F or t, with its derivative by lambda.
    struct Along
    {
      double PathPoint::*value, PathPoint::*rate;

      // Newton's step from `p`. With an earlier point `q`: the cubic through values and derivatives of the inverse function,
      // lambda by value, at both points. Its error is of fourth order.
      double root_near(const PathPoint &p, const PathPoint *q) const
      {
        const double newton = p.lambda - p.*value / p.*rate;
        if (!q)
          return newton;
        const double d = q->*value - p.*value, chord = (q->lambda - p.lambda) / d;
        const double square = (chord - 1 / p.*rate) / d, cube = ((1 / q->*rate - chord) / d - square) / d;
        return newton + p.*value * p.*value * (square - cube * q->*value);
      }
    };

    // Finds the root of a function that is positive at `start`, lambda = 0, and not positive at `high`. Takes the step of
    // root_near if it stays inside the bracket and the last one halved the residual. Otherwise it bisects, which a kink of the
    // table can require.
    std::optional<PathPoint> bracketed_root(const Path      &path,
                                            const PathPoint &start,
                                            const Along      f,
                                            double           high,
                                            const double     tolerance)
    {
      const double width = high;
      double       low = 0, last = std::numeric_limits<double>::infinity();
      PathPoint    p = start, before = start;
      for (unsigned int iteration = 0; iteration < 200; ++iteration)
        {
          const double value = p.*f.value;
          if (std::abs(value) <= tolerance || high - low <= 1e-16 * width)
            return p;
          (value > 0 ? low : high) = p.lambda;
          const double next        = f.root_near(p, std::isfinite(last) ? &before : nullptr);
          const bool   use_next    = next > low && next < high && std::abs(value) < last / 2;
          last                     = use_next ? std::abs(value) : std::numeric_limits<double>::infinity();
          before                   = p;
          p                        = path.at(use_next ? next : (low + high) / 2);
        }
      return {};
    }

    // The point where t = 0.
    std::optional<PathPoint> tip_point(const Path &points, const ReturnPath &path, const double tolerance)
    {
      if (path.shear_loss_by_dilation == 0)
        return points.at(points.longest());
      return bracketed_root(points, points.start(), {&PathPoint::shear, &PathPoint::shear_dot}, points.longest(), tolerance);
    }

    // From dF = 0 with dF/dt0 = 1 and dF/ds0 = -slope at a fixed lambda.
    ConeReturn flank(const PathPoint &p)
    {
      ConeReturn r;
      r.multiplier             = p.lambda;
      r.multiplier_by_shear    = -1 / p.yield_dot;
      r.multiplier_by_pressure = p.cone.slope.value / p.yield_dot;
      r.shear                  = p.shear;
      r.shear_by_shear         = 1 + p.shear_dot * r.multiplier_by_shear;
      r.shear_by_pressure      = p.shear_dot * r.multiplier_by_pressure;
      r.pressure               = p.pressure;
      r.pressure_by_shear      = p.pressure_dot * r.multiplier_by_shear;
      r.pressure_by_pressure   = 1 + p.pressure_dot * r.multiplier_by_pressure;
      return r;
    }

    // t = 0 for every trial stress near this one, so lambda depends on t0 only.
    ConeReturn tip(const PathPoint &p, const double viscous_modulus)
    {
      ConeReturn   r;
      const Cone  &c        = p.cone;
      const double strength = c.intercept.value + viscous_modulus * p.lambda;
      r.regime              = Regime::apex;
      r.multiplier          = p.lambda;
      r.multiplier_by_shear = -1 / p.shear_dot;
      r.pressure            = -strength / c.slope.value;
      r.pressure_by_shear   = (-(c.intercept.rate + viscous_modulus) / c.slope.value +
                             strength / (c.slope.value * c.slope.value) * c.slope.rate) *
                            r.multiplier_by_shear;
      return r;
    }
  } // namespace

  ConeReturn return_to_cone(const YieldCone  &cone,
                            const ConeStart  &from,
                            const ReturnPath &path,
                            const double      viscous_modulus,
                            const double      reference_modulus)
  {
    ConeReturn failed;
    failed.verdict = Verdict::failed;
    const Path      points(cone, from, path, viscous_modulus);
    const PathPoint start = points.start();
    // The scale is the trial stress. A nearly unloaded corner would meet an absolute tolerance at once.
    const double tolerance = 1e-13 * (path.shear + std::abs(path.pressure) + start.cone.intercept.value);
    if (!std::isfinite(tolerance) || !(start.yield > 0))
      return failed;

    ConeReturn               answer = failed;
    double                   high   = points.longest();
    std::optional<PathPoint> end;
    if (points.may_reach_tip())
      {
        end = tip_point(points, path, tolerance);
        if (!end)
          return failed;
        high = end->lambda;
      }
    if (end && end->yield > 0)
      answer = tip(*end, viscous_modulus);
    else
      {
        end = bracketed_root(points, start, {&PathPoint::yield, &PathPoint::yield_dot}, high, tolerance);
        if (!end || !(end->yield_dot < 0))
          return failed;
        answer = flank(*end);
        // If less than a tenth of the elastic slope remains, the point is close to snapping back. If so little remains only at
        // the start, it may already have snapped back.
        if (std::min(-end->yield_dot, -start.yield_dot) < 0.1 * reference_modulus)
          answer.verdict = Verdict::unreliable;
      }
    answer.dilation   = end->cone.dilation;
    answer.overstress = viscous_modulus * answer.multiplier;
    return answer;
  }
} // namespace diptych::continuum
