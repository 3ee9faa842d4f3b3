// diptych: path of a cell that is periodic in both directions, driven by strains and stresses
// SPDX-License-Identifier: LGPL-2.1-or-later
#include "discrete/panel/cell_path.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace diptych::discrete
{
  namespace
  {
    constexpr double strain_of_pressure = 0.01; // a stress that changes by the pressure takes as long as this strain

    // Largest change of a control between two rows, as a strain.
    double strain_between(const CellPath &path, const std::size_t row, const double pressure)
    {
      double largest = 0;
      for (int k = 0; k < 3; ++k)
        {
          const double change = std::abs(path.values[row][k] - path.values[row - 1][k]);
          const double unit   = path.is_stress[k] ? pressure / strain_of_pressure : path.form.row(k).maxCoeff();
          largest             = std::max(largest, change / unit);
        }
      return largest;
    }
  } // namespace

  void validate(const CellPath &path)
  {
    if (path.values.size() < 2 || path.progress.size() != path.values.size())
      throw std::invalid_argument("the path of a cell needs at least two rows, each with its progress");
    for (std::size_t row = 1; row < path.values.size(); ++row)
      if (!(path.progress[row] > path.progress[row - 1]) || !(strain_between(path, row, 1) > 0))
        throw std::invalid_argument("row " + std::to_string(row) + " (counted from 0) of the path of the cell changes nothing");
  }

  std::vector<double> times_of(const CellPath &path, const double pressure, const double strain_rate)
  {
    std::vector<double> times(path.values.size(), 0.);
    for (std::size_t row = 1; row < times.size(); ++row)
      times[row] = times[row - 1] + strain_between(path, row, pressure) / strain_rate;
    return times;
  }
} // namespace diptych::discrete
