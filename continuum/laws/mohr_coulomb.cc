// diptych: Mohr-Coulomb plasticity in the plane of deformation, softening, dilatancy that fades
// SPDX-License-Identifier: LGPL-2.1-or-later
#include "continuum/laws/mohr_coulomb.h"

#include <array>
#include <cmath>
#include <sstream>
#include <stdexcept>

namespace diptych::continuum
{
  using dealii::SymmetricTensor;

  namespace
  {
    constexpr double pi     = 3.14159265358979323846;
    constexpr double degree = pi / 180;

    // Radius of Mohr's circle, t = sqrt(D:D/2) of the two-dimensional deviator D.
    double radius(const SymmetricTensor<2, 2> &deviator)
    {
      return std::hypot((deviator[0][0] - deviator[1][1]) / 2, deviator[0][1]);
    }
  } // namespace

  void validate(const MohrCoulombOptions &o)
  {
    validate(o.elastic);
    const auto require = [](const bool holds, const auto &...text) {
      if (holds)
        return;
      std::ostringstream message;
      (message << ... << text);
      throw std::invalid_argument(message.str());
    };
    require(o.friction_angle_residual >= 0 && o.friction_angle_residual <= o.friction_angle_peak && o.friction_angle_peak < 90,
            "friction_angle_residual = ", o.friction_angle_residual, " and friction_angle_peak = ", o.friction_angle_peak,
            ": 0 <= residual <= peak < 90 degrees is needed");
    require(o.dilatancy_angle_residual >= 0 && o.dilatancy_angle_residual <= o.dilatancy_angle_peak,
            "dilatancy_angle_residual = ", o.dilatancy_angle_residual, " and dilatancy_angle_peak = ", o.dilatancy_angle_peak,
            ": 0 <= residual <= peak is needed");
    // Both angles decay alike, so that the two ends decide for all values between.
    require(o.dilatancy_angle_peak <= o.friction_angle_peak && o.dilatancy_angle_residual <= o.friction_angle_residual,
            "dilatancy angles ", o.dilatancy_angle_peak, " -> ", o.dilatancy_angle_residual,
            " must not exceed the friction angles ", o.friction_angle_peak, " -> ", o.friction_angle_residual,
            " (plastic work would be negative)");
    require(o.cohesion >= 0, "cohesion = ", o.cohesion, " must not be negative");
    require(o.cohesion == 0 || o.friction_angle_residual > 0, "friction_angle_residual = 0 with cohesion = ", o.cohesion,
            " has no apex to return to; give a small angle");
    require(o.softening_strain > 0, "softening_strain = ", o.softening_strain, " must be positive");
  }

  // Elastic predictor in the invariants of the plane; n = D/t has n:n = 2.
  struct MohrCoulomb::Trial
  {
    const MaterialState  &start;
    SymmetricTensor<2, 2> direction; // n
    double                s, t;      // pressure positive
  };

  struct MohrCoulomb::PlasticMultiplier
  {
    double value     = 0; // lambda, the increment of eps_1 - eps_3 plastic
    double slope     = 0; // -dF/dlambda
    bool   at_apex   = false;
    bool   converged = true;
  };

  MohrCoulomb::MohrCoulomb(const MohrCoulombOptions &options)
      : moduli(plane_moduli(options.elastic)),
        elastic(elastic_tangent(moduli)),
        friction_residual(options.friction_angle_residual * degree),
        friction_excess((options.friction_angle_peak - options.friction_angle_residual) * degree),
        dilatancy_residual(options.dilatancy_angle_residual * degree),
        dilatancy_excess((options.dilatancy_angle_peak - options.dilatancy_angle_residual) * degree),
        cohesion(options.cohesion),
        softening_strain(options.softening_strain)
  {
    validate(options);
  }

  // phi(kappa) = phi_r + (phi_p - phi_r) exp(-kappa/kappa_s), and psi alike.
  Angles MohrCoulomb::angles(const double equivalent_plastic_strain) const
  {
    const double decay = std::exp(-equivalent_plastic_strain / softening_strain);
    return {friction_residual + friction_excess * decay, -friction_excess * decay / softening_strain,
            dilatancy_residual + dilatancy_excess * decay, -dilatancy_excess * decay / softening_strain};
  }

  double MohrCoulomb::yield_function(const SymmetricTensor<2, 2> &stress, const double equivalent_plastic_strain) const
  {
    const double phi = angles(equivalent_plastic_strain).friction;
    return radius(deviator(stress)) + trace(stress) / 2 * std::sin(phi) - cohesion * std::cos(phi);
  }

  MaterialUpdate MohrCoulomb::update(const MaterialState &s0, const SymmetricTensor<2, 2> &d_strain) const
  {
    MaterialUpdate answer{s0, elastic};
    answer.state.stress += elastic * d_strain;
    answer.state.stress_zz += moduli.lateral * trace(d_strain);

    const auto   trial_deviator = deviator(answer.state.stress);
    const double t = radius(trial_deviator), s = -trace(answer.state.stress) / 2;
    if (!std::isfinite(t) || !std::isfinite(s))
      {
        answer.verdict = Verdict::failed;
        return answer;
      }
    const double kappa = s0.equivalent_plastic_strain;
    if (yield_function(answer.state.stress, kappa) <= 1e-12 * (t + std::abs(s) + cohesion))
      return answer;

    const Trial trial{s0, t > 0 ? trial_deviator / t : SymmetricTensor<2, 2>(), s, t};
    const auto  multiplier = solve_multiplier(trial);
    answer                 = multiplier.at_apex ? return_to_apex(trial) : return_to_flank(trial, multiplier);
    // Elastic everywhere but in the plane's plastic flow: d sigma_zz follows the elastic volume strain.
    answer.state.stress_zz += moduli.lateral / moduli.bulk * (trace(answer.state.stress) - trace(s0.stress)) / 2;
    if (!multiplier.converged)
      answer.verdict = Verdict::failed;
    return answer;
  }

  // Root of F(lambda) = t_tr - G lambda - (s_tr + bulk lambda sin psi) sin phi - c cos phi with phi, psi at kappa_0 + lambda,
  // between 0, where F > 0, and t_tr/G, where Mohr's circle has shrunk to a point: if F > 0 there too, the apex answers.
  MohrCoulomb::PlasticMultiplier MohrCoulomb::solve_multiplier(const Trial &trial) const
  {
    const double G = moduli.shear, bulk = moduli.bulk, kappa = trial.start.equivalent_plastic_strain;
    const auto   residual_and_slope = [&](const double lambda) {
      const Angles a       = angles(kappa + lambda);
      const double sin_phi = std::sin(a.friction), cos_phi = std::cos(a.friction);
      const double sin_psi = std::sin(a.dilatancy), cos_psi = std::cos(a.dilatancy);
      const double s     = trial.s + bulk * lambda * sin_psi;
      const double slope = G + bulk * (sin_psi + lambda * cos_psi * a.dilatancy_rate) * sin_phi +
                           (s * cos_phi - cohesion * sin_phi) * a.friction_rate;
      return std::array<double, 2>{trial.t - G * lambda - s * sin_phi - cohesion * cos_phi, slope};
    };

    PlasticMultiplier m;
    double            low = 0, high = trial.t / G;
    if (residual_and_slope(high)[0] > 0)
      {
        m.value   = high;
        m.at_apex = true;
        return m;
      }
    // The scale is the trial stress: an absolute tolerance would be met at once in a nearly unloaded corner.
    const double tolerance = 1e-13 * (trial.t + std::abs(trial.s) + cohesion);
    for (unsigned int iteration = 0; iteration < 60; ++iteration)
      {
        const auto [residual, slope] = residual_and_slope(m.value);
        m.slope                      = slope;
        if (std::abs(residual) <= tolerance)
          return m;
        (residual > 0 ? low : high) = m.value;
        const double newton         = m.value + residual / slope;
        m.value                     = (slope > 0 && newton > low && newton < high) ? newton : (low + high) / 2;
        if (high - low <= 1e-16 * trial.t / G)
          return m;
      }
    m.converged = false;
    return m;
  }

  // sigma = -s 1 + t n with t = t_tr - G lambda, s = s_tr + bulk lambda sin psi. With A = -dF/dlambda the consistency
  // condition gives d lambda = (G n + bulk sin phi 1) : d eps / A, and dn = (2 G dev(d eps) - G n (n : d eps)) / t_tr.
  MaterialUpdate MohrCoulomb::return_to_flank(const Trial &trial, const PlasticMultiplier &multiplier) const
  {
    const double G = moduli.shear, bulk = moduli.bulk, lambda = multiplier.value;
    const auto   one = dealii::unit_symmetric_tensor<2>();
    const auto  &n   = trial.direction;

    MaterialUpdate answer{trial.start, elastic, Regime::plastic};
    answer.state.equivalent_plastic_strain += lambda;
    const Angles a       = angles(answer.state.equivalent_plastic_strain);
    const double sin_psi = std::sin(a.dilatancy), t = trial.t - G * lambda;
    answer.state.stress = t * n - (trial.s + bulk * lambda * sin_psi) * one;

    const auto   d_lambda = (G * n + bulk * std::sin(a.friction) * one) / multiplier.slope;
    const double dilation = bulk * (sin_psi + lambda * std::cos(a.dilatancy) * a.dilatancy_rate);
    answer.tangent        = bulk * outer_product(one, one) - dilation * outer_product(one, d_lambda) + G * outer_product(n, n) -
                     G * outer_product(n, d_lambda) +
                     t / trial.t * (2 * G * dealii::deviator_tensor<2>() - G * outer_product(n, n));
    // Less than a tenth of the elastic slope left: the point is close to snapping back by itself.
    if (multiplier.slope < 0.1 * G)
      answer.verdict = Verdict::unreliable;
    return answer;
  }

  // t = 0, s = -c cot(phi). The deviatoric trial strain is plastic as a whole, d lambda = n : d eps; opening does not harden.
  MaterialUpdate MohrCoulomb::return_to_apex(const Trial &trial) const
  {
    const auto     one = dealii::unit_symmetric_tensor<2>();
    MaterialUpdate answer{trial.start, elastic, Regime::apex};
    answer.state.equivalent_plastic_strain += trial.t / moduli.shear;
    const Angles a       = angles(answer.state.equivalent_plastic_strain);
    const double sin_phi = std::sin(a.friction);
    if (cohesion == 0)
      {
        answer.state.stress = 0;
        answer.tangent      = 0;
        return answer;
      }
    answer.state.stress = cohesion * std::cos(a.friction) / sin_phi * one;
    answer.tangent      = -cohesion / (sin_phi * sin_phi) * a.friction_rate * outer_product(one, trial.direction);
    return answer;
  }
} // namespace diptych::continuum
