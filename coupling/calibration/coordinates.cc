// diptych: maps values of continuum keys to points of the unit cube, in which the search works
// SPDX-License-Identifier: LGPL-2.1-or-later
#include "coupling/calibration/coordinates.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "coupling/scene/keys.h"

namespace diptych::coupling
{
  namespace
  {
    const std::string section = "continuum";

    double scale(const CalibrationParameter &p, const double number)
    {
      return p.coordinate == Coordinate::logarithm ? std::log(number) : number;
    }

    // An empty name means: common to all targets.
    bool is_of(const CalibrationParameter &p, const std::string &target)
    {
      return target.empty() ? p.targets.empty() : p.belongs_to(target);
    }
  } // namespace

  Coordinates::Coordinates(std::vector<CalibrationParameter> given, std::map<std::string, double> given_others)
      : parameters(std::move(given)),
        others(std::move(given_others))
  {
    std::vector<double> numbers;
    for (const CalibrationParameter &p : parameters)
      numbers.push_back(p.start);
    for (const CalibrationParameter &p : parameters)
      for (const std::string &target : p.targets.empty() ? std::vector<std::string>{""} : p.targets)
        {
          const auto is_referred = [&](const CalibrationParameter &other) { return other.key == p.other; };
          const auto is_seen     = [&](const CalibrationParameter &other) { return is_referred(other) && is_of(other, target); };
          if (std::any_of(parameters.begin(), parameters.end(), is_referred) &&
              std::none_of(parameters.begin(), parameters.end(), is_seen))
            throw std::invalid_argument(p.key + " refers to " + p.other + ", which belongs to other targets");
          value_of(p.key, target, numbers);
        }
  }

  Eigen::VectorXd Coordinates::start() const
  {
    Eigen::VectorXd point = Eigen::VectorXd::Zero(Eigen::Index(size()));
    for (std::size_t k = 0; k < size(); ++k)
      {
        const CalibrationParameter &p   = parameters[k];
        const double                low = scale(p, p.low);
        point[Eigen::Index(k)]          = (scale(p, p.start) - low) / (scale(p, p.high) - low);
      }
    return point;
  }

  std::vector<double> Coordinates::numbers(const Eigen::VectorXd &point) const
  {
    std::vector<double> result;
    for (std::size_t k = 0; k < size(); ++k)
      {
        const CalibrationParameter &p    = parameters[k];
        const double                low  = scale(p, p.low);
        const double                here = low + point[Eigen::Index(k)] * (scale(p, p.high) - low);
        result.push_back(p.coordinate == Coordinate::logarithm ? std::exp(here) : here);
      }
    return result;
  }

  double Coordinates::value_of(const std::string         &key,
                               const std::string         &target,
                               const std::vector<double> &numbers,
                               const std::size_t          depth) const
  {
    if (depth > size())
      throw std::invalid_argument(key + " refers to itself in a circle");
    for (std::size_t k = 0; k < size(); ++k)
      if (parameters[k].key == key && is_of(parameters[k], target))
        {
          const CalibrationParameter &p = parameters[k];
          switch (p.coordinate)
            {
            case Coordinate::share_of:
              return numbers[k] * value_of(p.other, target, numbers, depth + 1);
            case Coordinate::drop_from:
              return (1 - numbers[k]) * value_of(p.other, target, numbers, depth + 1);
            default:
              return numbers[k];
            }
        }
    const auto found = others.find(key);
    if (found == others.end())
      throw std::invalid_argument(key + " is needed by a share or drop, but has no value");
    return found->second;
  }

  std::vector<double> Coordinates::values(const Eigen::VectorXd &point) const
  {
    const std::vector<double> here = numbers(point);
    std::vector<double>       result;
    for (const CalibrationParameter &p : parameters)
      result.push_back(value_of(p.key, p.targets.empty() ? "" : p.targets.front(), here));
    return result;
  }

  Settings Coordinates::settings(const Eigen::VectorXd &point, const std::string &target) const
  {
    const std::vector<double> here = values(point);
    Settings                  result;
    for (std::size_t k = 0; k < size(); ++k)
      if (is_of(parameters[k], target))
        result.push_back({section, parameters[k].key, text_of(here[k]), "a point of the calibration", ""});
    return result;
  }
} // namespace diptych::coupling
