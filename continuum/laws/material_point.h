// diptych: one homogeneous point along the biaxial path
// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <string>
#include <vector>

#include "continuum/laws/any_law.h"
#include "continuum/laws/material_point_row.h"

namespace diptych::continuum
{
  // Plane strain at constant lateral pressure. The axial strain grows in equal steps from an isotropic stress.
  struct MaterialPointPath
  {
    double pressure     = 1;    // [pressure], positive
    double axial_strain = 0.1;  // final shortening / initial height, in (0, 1)
    double step         = 1e-3; // increment of the axial strain; the last step may be shorter
  };

  enum class MaterialPointStatus
  {
    finished,
    law_failed,       // the law found no stress
    lateral_not_found // no lateral strain gave the prescribed pressure
  };

  struct MaterialPointReport
  {
    MaterialPointStatus           status       = MaterialPointStatus::finished;
    double                        axial_strain = 0; // axial strain reached
    std::string                   message;          // how the path ended
    std::vector<MaterialPointRow> rows;             // the start, then every finished step
    std::vector<std::string>      variables;        // law.NAME of the state variables of a law from a library
  };

  void validate(const MaterialPointPath &path);

  // Newton's iteration on the law's tangent finds the lateral strain of every step, to 1e-10 of the pressure. Throws under the
  // same conditions as validate(path).
  [[nodiscard]] MaterialPointReport drive_material_point(const Law &law, const MaterialPointPath &path);
} // namespace diptych::continuum
