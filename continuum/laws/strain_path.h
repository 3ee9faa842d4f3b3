// diptych: one homogeneous point along prescribed strains
// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <cstddef>
#include <vector>

#include <Eigen/Core>

#include "continuum/laws/options.h"
#include "continuum/laws/verdict.h"

namespace diptych::continuum
{
  // Plane strain; strain and stress are positive in compression. Strains are total. The law receives their increments
  // unchanged, so logarithmic strains describe a finite deformation. Cosserat laws see no relative rotation and no curvature.
  struct StrainPath
  {
    Eigen::Matrix2d              stress    = Eigen::Matrix2d::Zero(); // at the start, symmetric [pressure]
    double                       stress_zz = 0;                       // at the start [pressure]
    std::vector<Eigen::Matrix2d> strain;                              // symmetric; the first is that of the start
    std::vector<double>          time; // one per strain, only used for viscosity; empty: rate independent
  };

  struct StrainPathRow
  {
    Eigen::Matrix2d stress                    = Eigen::Matrix2d::Zero(); // [pressure]
    double          stress_zz                 = 0;                       // [pressure]
    double          equivalent_plastic_strain = 0;                       // hardening variable [-]
    double          dissipation               = 0;                       // plastic work per initial area [pressure]
    Verdict         verdict                   = Verdict::reliable;

    std::vector<double> variables; // of a law from a library
  };

  // Returns the start, then one row per strain. The list is shorter than the path if the law failed. Throws
  // std::invalid_argument under the same conditions as make_law(). It also rejects an entry of the path that is not finite or
  // not symmetric, and a wrong number of times.
  std::vector<StrainPathRow> drive_strain_path(LawKind           law,
                                               const LawOptions &options,
                                               const Units      &units,
                                               const StrainPath &path);
} // namespace diptych::continuum
