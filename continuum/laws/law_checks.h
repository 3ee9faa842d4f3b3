// diptych: checks that every constitutive law must pass, one of the user too
// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "continuum/laws/any_law.h"

namespace diptych::continuum
{
  struct LawCheck
  {
    std::string name;
    double      deviation = 0, allowed = 0;     // the largest one
    std::string unit;                           // of the deviation
    std::string where;                          // of the largest deviation: path, step, strain increment, stress before
    int         n_judged = 0, n_not_judged = 0; // cases; not judged: a kink of the answer is too near
    std::string trouble;                        // another reason to fail; empty: none

    bool holds() const { return trouble.empty() && n_judged > 0 && deviation <= allowed; }
  };

  // Drives the law along random strain paths with reversals, from the isotropic stress units.stress, until the mean stress is
  // low. The same law gives the same answer. The checks:
  //   answers        every step of at most 1e-4 has an answer
  //   repeatability  a second call with the same input gives the same bits
  //   tangent        against central differences, relative to the stiffness at rest
  //   objectivity    turned stress, tensors and strain give the turned answer, relative to units.stress
  //   dissipation    plastic work is not negative where the end is in compression, relative to units.stress: contraction does
  //                  negative work in tension, which only cohesion can carry; and it has the sign of stress : plastic strain
  std::vector<LawCheck> check_law(const Law &law, const Units &units);

  // Sum of the outer two principal stresses, or of those in the plane, whichever is larger; tension positive.
  double largest_in_tension(const MaterialState &state);

  // Random directions in all six components, scaled to the given size. The generator is seeded.
  std::vector<Strain> random_strains(int n, double size);

  // Rotation by an angle. A tensor turns by the double angle, the curvature as a vector, and the relative rotation stays.
  // shear_factor: 1 for a stress, 2 for a strain.
  Stress turned(const Stress &a, double angle, double shear_factor);

  struct DifferenceRule
  {
    double step = 1e-6; // relative to the strain increment
    double kink = 1e30; // differences over step and step / 2 that differ by more are not judged
  };

  // Largest difference between tangent and central differences. Entry (i, k) is in units of sqrt(C_ii C_kk) with the stiffness C
  // at rest. Empty if it cannot be judged: a neighbouring state is in another regime, or beyond a kink.
  std::optional<double> tangent_error(const Law &law, const MaterialState &s0, const Strain &e, const DifferenceRule &rule = {});
} // namespace diptych::continuum
