// diptych: values of a point and of the loading for output, positive in compression
// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <cmath>

#include "continuum/equilibrium/boundary_value_problem.h"

namespace diptych::continuum
{
  // Row: component of the force; column: normal of the face. A Cosserat stress has a skew part.
  inline Eigen::Matrix3d compression_positive(const MaterialState &point, const bool is_cosserat)
  {
    const auto     &s    = point.stress;
    const double    skew = is_cosserat ? s[relative_rotation] : 0;
    Eigen::Matrix3d m;
    m << s[xx], s[xy] - skew, 0, s[xy] + skew, s[yy], 0, 0, 0, point.stress_zz;
    return -m;
  }

  inline bool zz_is_not_intermediate(const MaterialState &point)
  {
    const double mean = (point.stress[xx] + point.stress[yy]) / 2;
    return std::abs(point.stress_zz - mean) >
           shear_radius(point.stress) * (1 + 1e-9) + 1e-6 * std::abs(mean); // equal stresses differ by round-off
  }

  // Progress of the loading in all its measures. Collective.
  struct Progress
  {
    double progress = 0, axial_strain = 0, shear_strain = 0, time = 0;
  };
  Progress progress_of(const BoundaryValueProblem &problem, const Loading &loading);

  template <class Target> void set_progress(const BoundaryValueProblem &problem, const Loading &loading, Target &target)
  {
    const Progress now      = progress_of(problem, loading);
    target.progress         = now.progress;
    target.axial_strain     = now.axial_strain;
    target.shear_strain     = now.shear_strain;
    target.time             = now.time;
    target.loading_variable = loading.loading_variable;
  }
} // namespace diptych::continuum
