// diptych: one homogeneous point along a path of strains and stresses
// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <string>
#include <vector>

#include "continuum/laws/material_point_row.h"
#include "continuum/laws/options.h"
#include "continuum/laws/point_path.h"

namespace diptych::continuum
{
  enum class MaterialPointStatus
  {
    finished,
    law_failed,      // the law found no stress
    strain_not_found // no strain gave the prescribed stresses
  };

  struct MaterialPointReport
  {
    MaterialPointStatus           status = MaterialPointStatus::finished;
    std::string                   message; // how the path ended
    std::vector<MaterialPointRow> rows;    // the start, every finished row, and the place where the path stopped between two rows
    std::vector<std::string>      variables; // law.NAME of the state variables of a law from a library
  };

  // Plane strain. Prescribed strains hold to round-off. Newton's iteration on the law's tangent finds the other strains from the
  // prescribed stresses, to 1e-10 of the larger of pressure and prescribed stress. If it fails, the step between two rows is
  // halved up to ten times. A Cosserat law sees no rotation, a gradient law kbar = kappa. Throws like make_law() and
  // validate(path).
  [[nodiscard]] MaterialPointReport drive_material_point(LawKind           law,
                                                         const LawOptions &options,
                                                         const Units      &units,
                                                         const PointPath  &path);
} // namespace diptych::continuum
