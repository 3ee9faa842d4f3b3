// diptych: whether a path of strains and stresses suits a law
// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <string>
#include <vector>

#include "coupling/scene/scene.h"

namespace diptych::coupling
{
  // Warning if the rows of a path turn back, whereas the law cannot follow; else empty.
  inline std::string reversal_warning(const continuum::Options &o, const std::vector<Eigen::Vector3d> &rows)
  {
    const continuum::HardeningKind hardening = o.material.hardening;
    if (!continuum::traits(o.law).is_plastic || hardening == continuum::kind_of<continuum::KinematicHardening>)
      return "";
    Eigen::Vector3d way = Eigen::Vector3d::Zero(); // last change of each control
    for (std::size_t row = 1; row < rows.size(); ++row)
      for (int k = 0; k < 3; ++k)
        if (const double step = rows[row][k] - rows[row - 1][k]; step * way[k] < 0)
          return "the path turns back, which continuum/hardening = " + continuum::name_of(hardening) +
                 " cannot follow: the law stays elastic until the load has grown as large in the other direction. Take "
                 "continuum/hardening = kinematic, or a path in one direction";
        else if (step != 0)
          way[k] = step;
    return "";
  }
} // namespace diptych::coupling
