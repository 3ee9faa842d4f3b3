// diptych: scalar return to a hardening cone, the kernel of all plastic laws
// SPDX-License-Identifier: LGPL-2.1-or-later
#include "continuum/laws/cone_return.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace diptych::continuum
{
  namespace
  {
    struct PathPoint
    {
      Cone   cone;
      double shear, shear_dot, pressure, pressure_dot;
      double yield, yield_dot; // F including its viscous part
    };

    class Path
    {
    public:
      Path(const YieldCone &cone, const HardeningState &start, const ReturnPath &path, const double viscous_modulus)
          : cone(cone),
            start(start),
            path(path),
            viscous_modulus(viscous_modulus)
      {}

      PathPoint at(const double lambda) const
      {
        PathPoint    p;
        const Cone  &c = p.cone = cone.over(start, lambda);
        const double loss       = path.shear_loss + path.shear_loss_by_dilation * c.dilation;
        const double gain       = path.pressure_gain + path.pressure_gain_by_dilation * c.dilation;
        p.shear                 = path.shear - loss * lambda;
        p.shear_dot             = -loss - path.shear_loss_by_dilation * c.dilation_rate * lambda;
        p.pressure              = path.pressure + gain * lambda;
        p.pressure_dot          = gain + path.pressure_gain_by_dilation * c.dilation_rate * lambda;
        p.yield                 = p.shear - p.pressure * c.slope - c.intercept - viscous_modulus * lambda;
        p.yield_dot = p.shear_dot - p.pressure_dot * c.slope - p.pressure * c.slope_rate - c.intercept_rate - viscous_modulus;
        return p;
      }

    private:
      const YieldCone      &cone;
      const HardeningState &start;
      const ReturnPath     &path;
      const double          viscous_modulus;
    };

    struct Root
    {
      double lambda    = 0;
      bool   converged = false;
    };

    // Finds the root of a function {value, derivative}(lambda) that is positive at zero and not positive at `high`. Takes
    // Newton's step if it stays inside the bracket and the last one halved the residual. Otherwise it bisects, which a kink of
    // the table can require.
    template <class Function> Root bracketed_newton(const Function &function, double high, const double tolerance)
    {
      const double width = high;
      double       low = 0, lambda = 0, last = std::numeric_limits<double>::infinity();
      for (unsigned int iteration = 0; iteration < 200; ++iteration)
        {
          const auto [value, derivative] = function(lambda);
          if (std::abs(value) <= tolerance || high - low <= 1e-16 * width)
            return {lambda, true};
          (value > 0 ? low : high) = lambda;
          const double newton      = lambda - value / derivative;
          const bool   use_newton  = newton > low && newton < high && std::abs(value) < last / 2;
          last                     = use_newton ? std::abs(value) : std::numeric_limits<double>::infinity();
          lambda                   = use_newton ? newton : (low + high) / 2;
        }
      return {};
    }

    // Finds t(lambda) = 0. The dilation lies between -1 and 1, so the loss lies between its values there.
    Root tip_multiplier(const Path &points, const ReturnPath &path, const double tolerance)
    {
      if (path.shear_loss_by_dilation == 0)
        return {path.shear / path.shear_loss, true};
      const double high = path.shear / (path.shear_loss - std::abs(path.shear_loss_by_dilation));
      return bracketed_newton(
        [&](const double lambda) {
          const PathPoint p = points.at(lambda);
          return std::array<double, 2>{p.shear, p.shear_dot};
        },
        high, tolerance);
    }

    // From dF = 0 with dF/dt0 = 1 and dF/ds0 = -slope at a fixed lambda.
    ConeReturn flank(const PathPoint &p, const double lambda)
    {
      ConeReturn r;
      r.multiplier             = lambda;
      r.multiplier_by_shear    = -1 / p.yield_dot;
      r.multiplier_by_pressure = p.cone.slope / p.yield_dot;
      r.shear                  = p.shear;
      r.shear_by_shear         = 1 + p.shear_dot * r.multiplier_by_shear;
      r.shear_by_pressure      = p.shear_dot * r.multiplier_by_pressure;
      r.pressure               = p.pressure;
      r.pressure_by_shear      = p.pressure_dot * r.multiplier_by_shear;
      r.pressure_by_pressure   = 1 + p.pressure_dot * r.multiplier_by_pressure;
      return r;
    }

    // t = 0 for every trial stress near this one, so lambda depends on t0 only.
    ConeReturn tip(const PathPoint &p, const double lambda, const double viscous_modulus)
    {
      ConeReturn   r;
      const Cone  &c        = p.cone;
      const double strength = c.intercept + viscous_modulus * lambda;
      r.regime              = Regime::apex;
      r.multiplier          = lambda;
      r.multiplier_by_shear = -1 / p.shear_dot;
      r.pressure            = -strength / c.slope;
      r.pressure_by_shear   = (-(c.intercept_rate + viscous_modulus) / c.slope + strength / (c.slope * c.slope) * c.slope_rate) *
                            r.multiplier_by_shear;
      return r;
    }
  } // namespace

  ConeReturn return_to_cone(const YieldCone      &cone,
                            const HardeningState &start_state,
                            const ReturnPath     &path,
                            const double          viscous_modulus,
                            const double          reference_modulus)
  {
    ConeReturn failed;
    failed.verdict = Verdict::failed;
    const Path      points(cone, start_state, path, viscous_modulus);
    const PathPoint start = points.at(0);
    // The scale is the trial stress. A nearly unloaded corner would meet an absolute tolerance at once.
    const double tolerance = 1e-13 * (path.shear + std::abs(path.pressure) + start.cone.intercept);
    const Root   top       = tip_multiplier(points, path, tolerance);
    if (!std::isfinite(tolerance) || !(start.yield > 0) || !top.converged)
      return failed;

    const PathPoint end    = points.at(top.lambda);
    ConeReturn      answer = failed;
    if (end.yield > 0)
      answer = tip(end, top.lambda, viscous_modulus);
    else
      {
        const Root root = bracketed_newton(
          [&](const double lambda) {
            const PathPoint p = points.at(lambda);
            return std::array<double, 2>{p.yield, p.yield_dot};
          },
          top.lambda, tolerance);
        const PathPoint p = points.at(root.lambda);
        if (!root.converged || !(p.yield_dot < 0))
          return failed;
        answer = flank(p, root.lambda);
        // If less than a tenth of the elastic slope remains, the point is close to snapping back. If so little remains only at
        // the start, it may already have snapped back.
        if (std::min(-p.yield_dot, -start.yield_dot) < 0.1 * reference_modulus)
          answer.verdict = Verdict::unreliable;
      }
    answer.overstress = viscous_modulus * answer.multiplier;
    return answer;
  }
} // namespace diptych::continuum
