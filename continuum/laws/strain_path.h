// diptych: one homogeneous point driven along prescribed strains
// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <cstddef>
#include <vector>

#include <Eigen/Core>

#include "continuum/laws/options.h"
#include "continuum/laws/verdict.h"

namespace diptych::continuum
{
  // Strain and stress positive in compression, plane strain. Strains are total, and their increments are handed to the law as
  // they are: logarithmic ones make a finite deformation. Cosserat laws: no relative rotation, no curvature.
  struct StrainPath
  {
    Eigen::Matrix2d              stress    = Eigen::Matrix2d::Zero(); // at the start, symmetric [pressure]
    double                       stress_zz = 0;                       // at the start [pressure]
    std::vector<Eigen::Matrix2d> strain;                              // symmetric, the first one is that of the start
    std::vector<double>          time;                                // as many, for viscosity alone; empty: rate independent
  };

  struct StrainPathRow
  {
    Eigen::Matrix2d stress                    = Eigen::Matrix2d::Zero(); // [pressure]
    double          stress_zz                 = 0;                       // [pressure]
    double          equivalent_plastic_strain = 0;                       // hardening variable [-]
    double          dissipation               = 0;                       // plastic work per initial area [pressure]
    Verdict         verdict                   = Verdict::reliable;
  };

  // The start, then one row a strain; shorter than the path where the law failed.
  // Throws std::invalid_argument as make_law() does, and naming the entry of the path that is not finite or not symmetric, or
  // the number of times where it is wrong.
  std::vector<StrainPathRow> drive_strain_path(LawKind           law,
                                               const LawOptions &options,
                                               const Units      &units,
                                               const StrainPath &path);
} // namespace diptych::continuum
