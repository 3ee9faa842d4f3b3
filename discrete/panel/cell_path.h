// diptych: path of a cell that is periodic in both directions, driven by strains and stresses
// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <array>
#include <vector>

#include <Eigen/Core>

namespace diptych::discrete
{
  // Values of three controls, row by row and linear in between; the first row is the start under an isotropic pressure. A control
  // is a linear form of the logarithmic strains (exx, eyy, 2 exy) since the start or of the stresses (sxx, syy, sxy), both
  // positive in compression. No control may follow from the others, whatever the response of the grains.
  struct CellPath
  {
    Eigen::Matrix3d              form      = Eigen::Matrix3d::Identity(); // one row per control
    std::array<bool, 3>          is_stress = {true, true, true};
    std::vector<Eigen::Vector3d> values;   // at least two rows; empty: no path
    std::vector<double>          progress; // of each row, ascending: the loading variable
  };

  // Throws std::invalid_argument if there are too few rows, or one does not lead on.
  void validate(const CellPath &path);

  // Time of each row, from 0 on. A row takes the time in which the strain rate reaches its largest change of exx, eyy, 2 exy or
  // volume. A change of a stress by the pressure counts as a strain of 0.01.
  std::vector<double> times_of(const CellPath &path, double pressure, double strain_rate);
} // namespace diptych::discrete
