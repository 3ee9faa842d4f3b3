// diptych: one homogeneous point driven along the biaxial path
// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <string>
#include <vector>

#include "continuum/laws/any_law.h"
#include "continuum/laws/material_point_row.h"

namespace diptych::continuum
{
  // Constant lateral pressure, plane strain, the axial strain growing in equal steps from an isotropic stress.
  struct MaterialPointPath
  {
    double pressure     = 1;    // [pressure], positive
    double axial_strain = 0.1;  // at the end: shortening / initial height, in (0, 1)
    double step         = 1e-3; // of the axial strain; the last one is shorter where it does not divide the end
  };

  enum class MaterialPointStatus
  {
    finished,
    law_failed,       // the law gave no stress
    lateral_not_found // no lateral strain was found that holds the pressure
  };

  struct MaterialPointReport
  {
    MaterialPointStatus           status       = MaterialPointStatus::finished;
    double                        axial_strain = 0; // reached
    std::string                   message;          // how it ended
    std::vector<MaterialPointRow> rows;             // the start, then each step that was finished
  };

  // Throws std::invalid_argument naming the value and its range.
  void validate(const MaterialPointPath &path);

  // The lateral strain of every step is found by Newton's iteration on the law's tangent, to 1e-10 of the pressure.
  // Throws as validate(path).
  [[nodiscard]] MaterialPointReport drive_material_point(const Law &law, const MaterialPointPath &path);
} // namespace diptych::continuum
