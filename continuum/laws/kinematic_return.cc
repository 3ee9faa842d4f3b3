// diptych: return to a cone whose axis follows the flow, for loads that unload and reverse
// SPDX-License-Identifier: LGPL-2.1-or-later
#include "continuum/laws/kinematic_return.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace diptych::continuum
{
  namespace
  {
    using Vector = dealii::Tensor<1, 5>;

    constexpr double steepest_sine = CriticalStateHardening::largest_sine;

    // A value with its derivatives by the unknowns lambda and d = sin psi and by the trial's pressure.
    struct Value
    {
      double value = 0, by_lambda = 0, by_d = 0, by_pressure = 0;

      Value operator+(const Value &b) const
      {
        return {value + b.value, by_lambda + b.by_lambda, by_d + b.by_d, by_pressure + b.by_pressure};
      }
      Value operator*(const double b) const { return {value * b, by_lambda * b, by_d * b, by_pressure * b}; }
      Value operator-(const Value &b) const { return *this + b * -1; }
      Value operator*(const Value &b) const
      {
        return {value * b.value, by_lambda * b.value + value * b.by_lambda, by_d * b.value + value * b.by_d,
                by_pressure * b.value + value * b.by_pressure};
      }
    };

    // Everything at one pair of lambda and d. With w = exp(-lambda/g_r) and Q = q_trial - p w R_0:
    //   R = w R_0 + (1 - w)(eta_p - r_e) n,   q - p R = (|Q| - G lambda - p (1 - w)(eta_p - r_e)) n,   n = Q/|Q|.
    // On the flank p = p_trial + B d lambda. At the tip p r = -viscous part and q = p R.
    struct ReturnPoint
    {
      Value  decay, pressure, radius, reach, carried; // w, p, r, (1 - w)(eta_p - r_e), p w
      Vector direction, across;                       // n; R_0 - n.R_0 n, over |Q|
      double along = 0;                               // n.R_0
      Value  distance;                                // of q from the axis: |q - p R| with its sign
      Value  yield, flow;                             // F with its viscous part; sin psi - that of the flow rule
    };

    class ReturnPoints
    {
    public:
      ReturnPoints(const KinematicHardening &hardening, const KinematicTrial &trial)
          : hardening(hardening),
            trial(trial),
            start_radius(hardening.radius(trial.equivalent_plastic_strain))
      {}

      ReturnPoint at(const double lambda, const double d, const bool at_tip) const
      {
        const KinematicHardening &h = hardening;
        ReturnPoint               p;
        const double              w = std::exp(-lambda / h.mobilisation_strain);
        p.decay                     = {w, -w / h.mobilisation_strain};
        p.radius                    = Value{h.elastic} + p.decay * (start_radius - h.elastic);
        const Value l{lambda, 1};
        const Value viscous = l * trial.viscous_modulus;
        if (at_tip)
          {
            const double r = p.radius.value;
            p.pressure     = viscous * Value{-1 / r, p.radius.by_lambda / (r * r)};
          }
        else
          p.pressure = Value{trial.pressure, 0, 0, 1} + l * Value{d, 0, 1} * trial.pressure_modulus;
        const Value possible = Value{h.possible + h.by_density * trial.densification} - l * Value{d, 0, 1} * h.by_density;
        p.reach              = possible.value > h.elastic ? (Value{1} - p.decay) * (possible - Value{h.elastic}) : Value{};
        p.carried            = p.pressure * p.decay;
        const Vector Q       = trial.q - p.carried.value * trial.back;
        const double size    = Q.norm();
        p.direction          = size > 0 ? Q / size : Vector();
        p.along              = p.direction * trial.back;
        p.across             = size > 0 ? (trial.back - p.along * p.direction) / size : Vector();
        const double turn    = p.across * trial.back;                                         // d(n.R_0) = across.dQ
        const Value  radial  = Value{size + p.along * p.carried.value} - p.carried * p.along, // |Q| to first order
          along              = Value{p.along + turn * p.carried.value} - p.carried * turn;
        p.distance           = radial - l * trial.shear_modulus - p.pressure * p.reach;
        p.yield              = p.distance - p.pressure * p.radius - viscous;
        if (at_tip)
          p.yield = p.distance;
        p.flow = Value{d, 0, 1} - (possible - Value{h.stress_ratio}) * (1 / h.dilatancy_ratio) + possible - p.decay * along -
                 p.reach - p.radius;
        return p;
      }

      // Finds d for a given lambda. The flow condition rises with d unless the step is very long.
      ReturnPoint flowing(const double lambda, const bool at_tip, double &d) const
      {
        double low = -steepest_sine, high = steepest_sine;
        for (unsigned int iteration = 0; iteration < 100; ++iteration)
          {
            d                   = std::clamp(d, low, high);
            const ReturnPoint p = at(lambda, d, at_tip);
            const double      f = p.flow.value;
            if (std::abs(f) < 1e-14 || high - low < 1e-15)
              return p;
            (f > 0 ? high : low) = d;
            const double newton  = d - f / p.flow.by_d;
            d                    = newton >= low && newton <= high ? newton
                                   : newton > steepest_sine        ? steepest_sine
                                   : newton < -steepest_sine       ? -steepest_sine
                                                                   : (low + high) / 2;
          }
        return at(lambda, d, at_tip);
      }

    private:
      const KinematicHardening &hardening;
      const KinematicTrial     &trial;
      const double              start_radius;
    };

    // Total derivative of F by lambda: d follows the flow condition unless it is cut off.
    double slope(const ReturnPoint &p, const double d)
    {
      const bool is_cut = std::abs(d) >= steepest_sine;
      return p.yield.by_lambda - (is_cut ? 0 : p.yield.by_d * p.flow.by_lambda / p.flow.by_d);
    }

    struct Solution
    {
      double      lambda = 0, d = 0, start_slope = 0;
      ReturnPoint point;
      bool        converged = false;
    };

    // Newton's iteration from lambda = 0 inside a bracket, whose upper end is open at first.
    Solution solve(const ReturnPoints &points, const bool at_tip, const double tolerance)
    {
      Solution s;
      double   low = 0, high = std::numeric_limits<double>::infinity();
      for (unsigned int iteration = 0; iteration < 200; ++iteration)
        {
          s.point            = points.flowing(s.lambda, at_tip, s.d);
          const double value = s.point.yield.value, rate = slope(s.point, s.d);
          if (iteration == 0)
            s.start_slope = rate;
          if (std::abs(value) <= tolerance || (std::isfinite(high) && high - low <= 1e-16 * high))
            {
              s.converged = true;
              return s;
            }
          (value > 0 ? low : high) = s.lambda;
          const double newton      = s.lambda - value / rate;
          if (newton > low && newton < high)
            s.lambda = newton;
          else
            s.lambda = std::isinf(high) ? 2 * low + 1e-6 : (low + high) / 2;
          if (!(s.lambda < 1e3))
            return s;
        }
      return s;
    }

    // Implicit function theorem. The gradients of lambda and d by q and p, then those of p, n and q = q_trial - G lambda n.
    void differentiate(const Solution &s, const KinematicTrial &trial, KinematicReturn &end)
    {
      const ReturnPoint &p        = s.point;
      const bool         is_cut   = std::abs(s.d) >= steepest_sine;
      const Value        flow     = is_cut ? Value{0, 0, 1} : p.flow;
      const Vector       flow_q   = is_cut ? Vector() : -p.decay.value * p.across;
      const double       det      = p.yield.by_lambda * flow.by_d - p.yield.by_d * flow.by_lambda;
      const Vector       lambda_q = -(flow.by_d * p.direction - p.yield.by_d * flow_q) / det;
      const Vector       d_q      = -(p.yield.by_lambda * flow_q - flow.by_lambda * p.direction) / det;
      const double       lambda_p = -(flow.by_d * p.yield.by_pressure - p.yield.by_d * flow.by_pressure) / det;
      const double       d_p      = -(p.yield.by_lambda * flow.by_pressure - flow.by_lambda * p.yield.by_pressure) / det;
      const auto         by_q     = [&](const Value &v) { return v.by_lambda * lambda_q + v.by_d * d_q; };
      const auto         by_p     = [&](const Value &v) { return v.by_lambda * lambda_p + v.by_d * d_p + v.by_pressure; };

      end.pressure_by_q        = by_q(p.pressure);
      end.pressure_by_pressure = by_p(p.pressure);
      const double size = (trial.q - p.carried.value * trial.back).norm(), loss = trial.shear_modulus;
      for (unsigned int i = 0; i < 5; ++i)
        end.q_by_q[i][i] = 1 - loss * s.lambda / size;
      end.q_by_q += loss * s.lambda / size * outer_product(p.direction, p.direction) +
                    loss * s.lambda * outer_product(p.across, by_q(p.carried)) - loss * outer_product(p.direction, lambda_q);
      end.q_by_pressure = loss * s.lambda * by_p(p.carried) * p.across - loss * lambda_p * p.direction;
    }

    // Pure tension beyond the tip, without any shear.
    KinematicReturn at_the_tip(const KinematicTrial &trial)
    {
      KinematicReturn end;
      end.back    = trial.back;
      end.regime  = Regime::apex;
      end.verdict = Verdict::reliable;
      return end;
    }
  } // namespace

  KinematicReturn return_to_moving_cone(const KinematicHardening &hardening, const KinematicTrial &trial)
  {
    KinematicReturn    end;
    const double       tolerance = 1e-13 * (trial.q.norm() + std::abs(trial.pressure));
    const ReturnPoints points(hardening, trial);
    if (!std::isfinite(tolerance))
      return end;
    if (trial.q.norm() <= 1e-12 * -trial.pressure && trial.viscous_modulus == 0)
      return at_the_tip(trial);
    Solution s = solve(points, false, tolerance);
    if (!s.converged || s.point.distance.value < 0)
      {
        s          = solve(points, true, tolerance);
        end.regime = Regime::apex;
      }
    if (!s.converged || !(slope(s.point, s.d) < 0))
      return end;
    const bool is_steep = -std::max(slope(s.point, s.d), s.start_slope) < 0.1 * trial.shear_modulus;
    end.verdict         = end.regime == Regime::plastic && is_steep ? Verdict::unreliable : Verdict::reliable;
    end.multiplier      = s.lambda;
    end.dilation        = s.d;
    end.q               = trial.q - trial.shear_modulus * s.lambda * s.point.direction;
    end.pressure        = s.point.pressure.value;
    end.back            = s.point.decay.value * trial.back + s.point.reach.value * s.point.direction;
    differentiate(s, trial, end);
    return end;
  }
} // namespace diptych::continuum
