// diptych: distributions of grain radii, and radii that follow one
// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <string>
#include <variant>
#include <vector>

namespace diptych::discrete
{
  // Number density constant between min and max.
  struct UniformByNumber
  {
    double min, max; // [length or mean diameters]
  };

  // Mass density, i.e. r^2 x number density of discs, constant in r between min and max: number density ~ 1/r^2.
  struct UniformByMass
  {
    double min, max; // [length or mean diameters]
  };

  // Grading curve of a sieve analysis. The share `passing` of the mass belongs to radii up to `radius`, linear between the
  // points. A flat piece holds no grains. The number density within a piece is slope / r^2.
  struct RadiusTable
  {
    std::vector<double> radius;  // ascending, above 0 [any length; see RadiusScale]
    std::vector<double> passing; // by mass, from 0 to 1, not decreasing
  };

  using RadiusDistribution = std::variant<UniformByNumber, UniformByMass, RadiusTable>;

  enum class RadiusScale
  {
    as_given,         // radii in the unit of the distribution
    mean_diameter_one // radii in mean diameters: UniformByMass and RadiusTable are rescaled until the radii average 1/2;
                      // UniformByNumber must have min + max = 1 by itself
  };

  // n >= 1 radii, ascending: the quantiles (k + 1/2)/n of the distribution by number. All seeds of a sample therefore have the
  // same radii at random places. Throws as validate().
  std::vector<double> radius_quantiles(const RadiusDistribution &distribution, int n, RadiusScale scale = RadiusScale::as_given);

  // Throws std::invalid_argument with parameter, value and range unless 0 < min <= max, or the table obeys the comments above.
  void validate(const RadiusDistribution &distribution);

  // CSV file with the columns `radius` and `passing`. `passing` is a fraction if its last value is 1, and per cent if it is 100.
  // Throws std::invalid_argument with file, line, column, value and range.
  RadiusTable read_radius_table(const std::string &path);
} // namespace diptych::discrete
