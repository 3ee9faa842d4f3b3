// diptych: material points before any load
// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <vector>

#include <Eigen/Core>

#include "continuum/elements/discretisation.h"
#include "continuum/laws/law.h"
#include "continuum/options.h"

namespace diptych::continuum
{
  // Isotropic `pressure`, with the weak spot's hardening variable, at every point of this process's cells, cell by cell.
  void set_at_rest(const Discretisation       &mesh,
                   const Options              &options,
                   const Units                &units,
                   double                      pressure,
                   std::vector<MaterialState> &points);

  // One entry a cell, `n_points` points each: stress, positive in compression; solid fraction of a critical-state law.
  void set_stress(const std::vector<Eigen::Matrix2d> &of_cells, std::size_t n_points, std::vector<MaterialState> &points);
  void set_solid_fraction(const std::vector<double>  &of_cells,
                          std::size_t                 n_points,
                          const LawOptions           &law,
                          std::vector<MaterialState> &points);
} // namespace diptych::continuum
