// diptych: how friction, dilatancy and cohesion change with plastic strain
// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <vector>

#include "continuum/laws/options.h"

namespace diptych::continuum
{
  // Strength at one value of the hardening variable; a `_rate` is the derivative by it.
  struct Strength
  {
    double friction = 0, friction_rate = 0;   // phi [radians]
    double dilatancy = 0, dilatancy_rate = 0; // psi [radians]
    double cohesion = 0, cohesion_rate = 0;   // c [pressure]
  };

  class Hardening
  {
  public:
    // Throws std::invalid_argument as validate(options) does.
    explicit Hardening(const LawOptions &options, const Units &units = {});

    // At the hardening variable `equivalent_plastic_strain` >= 0. At a point of the table the rate is that of the interval
    // which begins there.
    Strength at(double equivalent_plastic_strain) const;

  private:
    struct Point
    {
      double strain = 0, friction = 0, dilatancy = 0, cohesion = 0;
    };
    Strength decayed(double equivalent_plastic_strain) const;
    Strength interpolated(double equivalent_plastic_strain) const;

    Point              peak, residual; // strain: none
    double             softening_strain = 0;
    double             unmobilised = 0, mobilisation_strain = 1; // what friction lacks at the start [radians]; by 1/e
    std::vector<Point> table;                                    // empty: exponential or mobilisation; one point: constant
  };
} // namespace diptych::continuum
