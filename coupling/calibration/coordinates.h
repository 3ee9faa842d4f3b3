// diptych: values of a scene's keys as points of the unit cube, in which they are searched for
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
    // others: values of keys that shares and drops refer to and that are not searched for. Throws std::invalid_argument where
    // one refers to a key that is neither, to one that belongs to other targets, or in a circle.
    Coordinates(std::vector<CalibrationParameter> parameters, std::map<std::string, double> others);

    std::size_t     size() const { return parameters.size(); }
    Eigen::VectorXd start() const;

    // Numbers of the coordinates: value, share or drop.
    std::vector<double> numbers(const Eigen::VectorXd &point) const;
    // Values of the keys themselves, in the order of the parameters.
    std::vector<double> values(const Eigen::VectorXd &point) const;
    // Of one target; of none (""): what all have in common.
    Settings settings(const Eigen::VectorXd &point, const std::string &target) const;

    const CalibrationParameter &parameter(std::size_t k) const { return parameters[k]; }

  private:
    // How one target sees the key.
    double value_of(const std::string         &key,
                    const std::string         &target,
                    const std::vector<double> &numbers,
                    std::size_t                depth = 0) const;

    std::vector<CalibrationParameter> parameters;
    std::map<std::string, double>     others;
  };
} // namespace diptych::coupling
