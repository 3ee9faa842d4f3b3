// diptych: Mohr-Coulomb return mapping in principal space
// SPDX-License-Identifier: LGPL-2.1-or-later
#include "continuum/laws/principal_return.h"

#include <cmath>
#include <optional>

namespace diptych::continuum
{
  namespace
  {
    // Where several principal stresses coincide, the return uses their mean.
    enum class Branch
    {
      plane,      // sigma_1 > sigma_2 > sigma_3: plane of the outer two
      right_edge, // sigma_2 = sigma_3: planes (1, 3) and (1, 2)
      left_edge   // sigma_1 = sigma_2: planes (1, 3) and (2, 3)
    };

    struct Weights
    {
      Principal major, minor;
    };

    Weights weights(const Branch branch)
    {
      switch (branch)
        {
        case Branch::right_edge:
          return {{1, 0, 0}, {0, .5, .5}};
        case Branch::left_edge:
          return {{.5, .5, 0}, {0, 0, 1}};
        default:
          return {{1, 0, 0}, {0, 0, 1}};
        }
    }

    double dot(const Principal &a, const Principal &b)
    {
      return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
    }

    // Flow of plane (i, j): d eps_i = (1 + sin psi)/2, d eps_j = -(1 - sin psi)/2, times its multiplier. On an edge the two
    // multipliers with the sum lambda share one principal direction. The mean strain of the two coinciding stresses depends on
    // lambda only. With D = sin psi,
    //   right: eps_1 - eps_23 = (3 + D)/4 lambda, left: eps_12 - eps_3 = (3 - D)/4 lambda, volume: D lambda.
    // Hence t = (major - minor)/2 falls by G times that, and I1/3 falls by K D lambda. The mean of major and minor is I1/3 +
    // t/3 on the right edge and I1/3 - t/3 on the left one.
    ReturnPath path_of(const Branch branch, const ElasticModuli &moduli, const Principal &trial)
    {
      const Weights w     = weights(branch);
      const double  major = dot(w.major, trial), minor = dot(w.minor, trial), G = moduli.shear;
      ReturnPath    path;
      path.shear    = (major - minor) / 2;
      path.pressure = -(major + minor) / 2;
      if (branch == Branch::plane)
        {
          path.shear_loss                = G;
          path.pressure_gain_by_dilation = moduli.plane_bulk;
          return path;
        }
      const double side              = branch == Branch::right_edge ? 1 : -1;
      path.shear_loss                = 3 * G / 4;
      path.shear_loss_by_dilation    = side * G / 4;
      path.pressure_gain             = side * G / 4;
      path.pressure_gain_by_dilation = moduli.bulk + G / 12;
      return path;
    }

    // Derivatives by the trial stresses, through t0 = (major - minor)/2 and s0 = -(major + minor)/2.
    Principal gradient(const Weights &w, const double by_shear, const double by_pressure)
    {
      Principal g;
      for (unsigned int j = 0; j < 3; ++j)
        g[j] = by_shear / 2 * (w.major[j] - w.minor[j]) - by_pressure / 2 * (w.major[j] + w.minor[j]);
      return g;
    }

    PrincipalReturn assemble(const Branch branch, const ConeReturn &r)
    {
      const Weights   w = weights(branch);
      PrincipalReturn answer;
      for (unsigned int i = 0; i < 3; ++i)
        {
          const double sign  = w.major[i] > 0 ? 1 : -1;
          answer.stress[i]   = sign * r.shear - r.pressure;
          answer.jacobian[i] = gradient(w, sign * r.shear_by_shear - r.pressure_by_shear,
                                        sign * r.shear_by_pressure - r.pressure_by_pressure);
        }
      answer.multiplier = r.multiplier;
      answer.overstress = r.overstress;
      answer.verdict    = r.verdict;
      answer.regime     = r.regime == Regime::apex || branch == Branch::plane ? r.regime : Regime::edge;
      return answer;
    }

    struct Problem
    {
      const YieldCone     &cone;
      const ElasticModuli &moduli;
      const ConeStart     &start;
      const Principal     &trial;
      double               viscous_modulus;

      ConeReturn solve(const Branch branch) const
      {
        return return_to_cone(cone, start, path_of(branch, moduli, trial), viscous_modulus, moduli.shear);
      }
    };

    // sigma_2 stays between the others and follows the elastic volume strain, -D lambda.
    std::optional<PrincipalReturn> return_to_plane(const Problem &problem)
    {
      const ConeReturn r = problem.solve(Branch::plane);
      if (r.verdict == Verdict::failed || r.regime == Regime::apex)
        return {};
      PrincipalReturn answer = assemble(Branch::plane, r);
      const double    loss   = problem.moduli.lateral * (r.dilation.value + r.dilation.rate * r.multiplier);
      answer.stress[1]       = problem.trial[1] - problem.moduli.lateral * r.dilation.value * r.multiplier;
      answer.jacobian[1]     = gradient(weights(Branch::plane), -loss * r.multiplier_by_shear, -loss * r.multiplier_by_pressure);
      answer.jacobian[1][1] += 1;
      if (answer.stress[1] > answer.stress[0] || answer.stress[1] < answer.stress[2])
        return {};
      return answer;
    }

    // The difference of the two multipliers makes the trial stresses of the group equal: (difference)/(G (1 -+ sin psi)). Apart
    // from round-off the smaller multiplier must not be negative.
    std::optional<PrincipalReturn> return_to_edge(const Problem &problem, const Branch branch)
    {
      const ConeReturn r = problem.solve(branch);
      if (r.verdict == Verdict::failed)
        return {};
      const bool   right      = branch == Branch::right_edge;
      const double difference = right ? problem.trial[1] - problem.trial[2] : problem.trial[0] - problem.trial[1];
      if (difference > problem.moduli.shear * (1 + (right ? -r.dilation.value : r.dilation.value)) * r.multiplier * (1 + 1e-10))
        return {};
      return assemble(branch, r);
    }
  } // namespace

  PrincipalReturn return_in_principal_space(const YieldCone     &cone,
                                            const ElasticModuli &moduli,
                                            const ConeStart     &start,
                                            const Principal     &trial,
                                            const double         viscous_modulus)
  {
    const Problem problem{cone, moduli, start, trial, viscous_modulus};
    if (const auto answer = return_to_plane(problem))
      return *answer;
    for (const Branch edge : {Branch::right_edge, Branch::left_edge})
      if (const auto answer = return_to_edge(problem, edge))
        return *answer;
    PrincipalReturn failed;
    failed.verdict = Verdict::failed;
    return failed;
  }
} // namespace diptych::continuum
