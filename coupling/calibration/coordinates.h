// diptych: maps values of continuum keys to points of the unit cube, in which the search works
// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <map>
#include <string>
#include <vector>

#include <Eigen/Core>

#include "coupling/calibration/calibration.h"

namespace diptych::coupling
{
  class Coordinates
  {
  public:
    // others: values of fixed keys that shares and drops refer to. Throws std::invalid_argument if a parameter refers to an
    // unknown key, to one that belongs to other targets, or to itself in a circle.
    Coordinates(std::vector<CalibrationParameter> parameters, std::map<std::string, double> others);

    std::size_t     size() const { return parameters.size(); }
    Eigen::VectorXd start() const;

    // Numbers of the coordinates: value, share or drop.
    std::vector<double> numbers(const Eigen::VectorXd &point) const;
    // Values of the keys, in the order of the parameters.
    std::vector<double> values(const Eigen::VectorXd &point) const;
    // Settings of one target. An empty name gives those that all targets share.
    Settings settings(const Eigen::VectorXd &point, const std::string &target) const;

    const CalibrationParameter &parameter(std::size_t k) const { return parameters[k]; }

  private:
    // The value of the key for one target.
    double value_of(const std::string         &key,
                    const std::string         &target,
                    const std::vector<double> &numbers,
                    std::size_t                depth = 0) const;

    std::vector<CalibrationParameter> parameters;
    std::map<std::string, double>     others;
  };
} // namespace diptych::coupling
