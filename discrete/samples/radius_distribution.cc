// diptych: distributions of grain radii, and radii that follow one
// SPDX-License-Identifier: LGPL-2.1-or-later
#include "discrete/samples/radius_distribution.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <stdexcept>

#include "discrete/files/csv_file.h"

namespace diptych::discrete
{
  namespace
  {
    void check_range(const double min, const double max)
    {
      if (!(min > 0 && std::isfinite(min)))
        throw std::invalid_argument("smallest radius " + exact_text(min) + " is out of range; allowed: more than 0");
      if (!(max >= min && std::isfinite(max)))
        throw std::invalid_argument("largest radius " + exact_text(max) + " is out of range; allowed: " + exact_text(min) +
                                    " (the smallest radius) or more");
    }

    // The first point that violates the rules of a grading curve; row -1 if there is none.
    struct Fault
    {
      int         row = -1;
      std::string column, allowed;
    };

    Fault fault_of_radii(const std::vector<double> &radius)
    {
      for (std::size_t k = 0; k < radius.size(); ++k)
        {
          if (!(radius[k] > 0 && std::isfinite(radius[k])))
            return {int(k), "radius", "more than 0"};
          if (k > 0 && radius[k] <= radius[k - 1])
            return {int(k), "radius", "more than " + exact_text(radius[k - 1]) + ", the radius before it"};
        }
      return {};
    }

    Fault fault_of_passing(const std::vector<double> &passing, const double whole)
    {
      if (passing.front() != 0)
        return {0, "passing", "0, at the smallest radius"};
      for (std::size_t k = 1; k < passing.size(); ++k)
        if (!(passing[k] >= passing[k - 1] && passing[k] <= whole))
          return {int(k), "passing", exact_text(passing[k - 1]) + " (the passing before it) to " + exact_text(whole)};
      return {};
    }

    void check_table(const RadiusTable &table)
    {
      if (table.radius.size() < 2 || table.radius.size() != table.passing.size())
        throw std::invalid_argument("a grading curve with " + std::to_string(table.radius.size()) + " radii and " +
                                    std::to_string(table.passing.size()) + " values of passing; allowed: 2 or more of each");
      Fault fault = fault_of_radii(table.radius);
      if (fault.row < 0)
        fault = fault_of_passing(table.passing, 1.);
      if (fault.row < 0 && table.passing.back() != 1)
        fault = {int(table.passing.size()) - 1, "passing", "1, at the largest radius"};
      if (fault.row >= 0)
        {
          const double value = (fault.column == "radius" ? table.radius : table.passing)[fault.row];
          throw std::invalid_argument("grading curve, point " + std::to_string(fault.row + 1) + ": " + fault.column + " " +
                                      exact_text(value) + " is out of range; allowed: " + fault.allowed);
        }
    }

    std::vector<double> quantiles(const UniformByNumber &d, const int n)
    {
      std::vector<double> radius(n);
      for (int k = 0; k < n; ++k)
        radius[k] = d.min + (d.max - d.min) * (k + 0.5) / n;
      return radius;
    }

    // The mass curve F is piecewise linear with the slope s = dF/dr. Within a piece from a to b the number of grains from a up to
    // r is s (1/a - 1/r), in total dF / (a b). Solved for r this is 1/r = 1/a - number / s.
    std::vector<double> quantiles(const RadiusTable &d, const int n)
    {
      const auto in_piece = [&](const std::size_t k) {
        return (d.passing[k + 1] - d.passing[k]) / (d.radius[k] * d.radius[k + 1]);
      };
      double total = 0;
      for (std::size_t k = 0; k + 1 < d.radius.size(); ++k)
        total += in_piece(k);

      std::vector<double> radius(n);
      std::size_t         piece = 0;
      double              below = 0; // number of grains in the previous pieces
      for (int k = 0; k < n; ++k)
        {
          const double wanted = total * (k + 0.5) / n;
          for (; piece + 2 < d.radius.size() && below + in_piece(piece) < wanted; ++piece)
            below += in_piece(piece);
          const double a = d.radius[piece], b = d.radius[piece + 1], slope = (d.passing[piece + 1] - d.passing[piece]) / (b - a);
          radius[k] = slope > 0 ? std::clamp(1 / (1 / a - (wanted - below) / slope), a, b) : a;
        }
      return radius;
    }

    std::vector<double> quantiles(const UniformByMass &d, const int n)
    {
      return d.min == d.max ? std::vector<double>(n, d.min) : quantiles(RadiusTable{{d.min, d.max}, {0., 1.}}, n);
    }
  } // namespace

  void validate(const RadiusDistribution &distribution)
  {
    if (const auto *by_number = std::get_if<UniformByNumber>(&distribution))
      check_range(by_number->min, by_number->max);
    else if (const auto *by_mass = std::get_if<UniformByMass>(&distribution))
      check_range(by_mass->min, by_mass->max);
    else
      check_table(std::get<RadiusTable>(distribution));
  }

  std::vector<double> radius_quantiles(const RadiusDistribution &distribution, const int n, const RadiusScale scale)
  {
    validate(distribution);
    if (n < 1)
      throw std::invalid_argument("number of radii " + std::to_string(n) + " is out of range; allowed: 1 or more");
    std::vector<double> radius = std::visit([&](const auto &d) { return quantiles(d, n); }, distribution);
    if (scale == RadiusScale::as_given)
      return radius;
    if (const auto *d = std::get_if<UniformByNumber>(&distribution))
      {
        if (std::abs(d->min + d->max - 1) > 1e-9)
          throw std::invalid_argument("smallest + largest radius is " + exact_text(d->min + d->max) +
                                      " mean diameters; allowed: 1, so that radii uniform by number have the mean diameter 1");
        return radius;
      }
    const double mean_diameter = 2 * std::accumulate(radius.begin(), radius.end(), 0.) / n;
    for (double &r : radius)
      r /= mean_diameter;
    return radius;
  }

  RadiusTable read_radius_table(const std::string &path)
  {
    const CsvTable csv = read_csv(path, {{"radius", "passing"}});
    RadiusTable    table;
    for (std::size_t k = 0; k < csv.rows.size(); ++k)
      {
        table.radius.push_back(csv.at(k, "radius"));
        table.passing.push_back(csv.at(k, "passing"));
      }
    if (csv.rows.size() < 2)
      throw std::invalid_argument(path + ", line " + std::to_string(csv.line[0]) +
                                  ": a grading curve of one point; allowed: 2 or more");
    const double whole = table.passing.back();
    if (whole != 1 && whole != 100)
      refuse_cell(csv, csv.rows.size() - 1, "passing", "at the largest radius 1 (fractions) or 100 (per cent)");
    for (const Fault &fault : {fault_of_radii(table.radius), fault_of_passing(table.passing, whole)})
      if (fault.row >= 0)
        refuse_cell(csv, std::size_t(fault.row), fault.column, fault.allowed);
    for (double &passing : table.passing)
      passing /= whole;
    return table;
  }
} // namespace diptych::discrete
