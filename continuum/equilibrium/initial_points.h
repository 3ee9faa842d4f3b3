// diptych: material points before loading
// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <vector>

#include <Eigen/Core>

#include "continuum/elements/discretisation.h"
#include "continuum/laws/any_law.h"
#include "continuum/options.h"

namespace diptych::continuum
{
  // Sets the isotropic `pressure` and the hardening variable of the weak spot at every point of this process, cell by cell.
  void set_at_rest(const Discretisation       &mesh,
                   const Options              &options,
                   const Units                &units,
                   double                      pressure,
                   std::vector<MaterialState> &points);

  // Sets the state variables of a law from a library, at the initial stress of each point. Other laws have none.
  void start_variables(const Law &law, std::vector<MaterialState> &points);

  // Both take one entry per cell of `n_points` points: the stress, positive in compression, or the solid fraction of a
  // critical-state law.
  void set_stress(const std::vector<Eigen::Matrix2d> &of_cells, std::size_t n_points, std::vector<MaterialState> &points);
  void set_solid_fraction(const std::vector<double>  &of_cells,
                          std::size_t                 n_points,
                          const LawOptions           &law,
                          std::vector<MaterialState> &points);
} // namespace diptych::continuum
