// diptych: strain along the path of an element test, and whether the path turns back
// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <string>
#include <vector>

#include "coupling/scene/scene.h"

namespace diptych::coupling
{
  // Rows of loading/path; of a named path its start and end, whose progress is a strain. The strain of a table is the sum of the
  // largest changes of exx, eyy, 2 exy, volume or stress, as in discrete::times_of().
  struct PathShape
  {
    std::vector<double> progress, strain;
    bool                turns_back = false; // a control grows and falls
  };

  inline PathShape path_shape(const LoadingOptions &loading) // mode path
  {
    if (!loading.path.names_a_file())
      return {{0, loading.axial_strain}, {0, loading.axial_strain}, false};
    const discrete::CellPath path = cell_path(loading.path, {loading.pressure});
    PathShape                shape{path.progress, discrete::times_of(path, loading.pressure, 1), false};
    Eigen::Vector3d          way = Eigen::Vector3d::Zero(); // last change of each control
    for (std::size_t row = 1; row < path.values.size(); ++row)
      for (int k = 0; k < 3; ++k)
        if (const double step = path.values[row][k] - path.values[row - 1][k]; step != 0)
          {
            shape.turns_back = shape.turns_back || step * way[k] < 0;
            way[k]           = step;
          }
    return shape;
  }

  // Warning for a path that turns back under a law that cannot follow it; empty: no such path or law.
  inline std::string reversal_warning(const Scene &scene)
  {
    const continuum::HardeningKind hardening = scene.continuum.material.hardening;
    if (scene.loading.mode != discrete::LoadingMode::path || !continuum::traits(scene.continuum.law).is_plastic ||
        hardening == continuum::kind_of<continuum::KinematicHardening> || !path_shape(scene.loading).turns_back)
      return "";
    return "loading/path = " + scene.loading.path.text +
           " turns back, which continuum/hardening = " + continuum::name_of(hardening) +
           " cannot follow: the law stays elastic until the load has grown as large in the other direction. Take "
           "continuum/hardening = kinematic, or a path in one direction";
  }
} // namespace diptych::coupling
