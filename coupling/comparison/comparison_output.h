// diptych: the comparison as files
// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <string>

#include <nlohmann/json_fwd.hpp>

#include "coupling/comparison/comparison.h"

namespace diptych::coupling
{
  // comparison.json: every number of the report, lengths in mean diameters where the name ends in _d, stresses in the scene's
  // unit, angles from the horizontal in degrees. `provenance` supplies cost and counts. comparison.csv: the same, one line a
  // number: axial_strain_from, axial_strain_to, panel, quantity, value and, where they are known, the ends of its 95 % interval.
  void write_comparison(const std::string &directory, const Scene &scene, const Comparison &c, const nlohmann::json &provenance);

  // comparison.h5: the arrays behind the report's pictures.
  void write_comparison_h5(const std::string &directory, const Scene &scene, const Comparison &c);

  // fields.vtu: the last stage, both panels on the continuum's mesh in its position of that stage: every field of CellFields,
  // tensors as 3x3 tensors (compression positive), vectors with three components, and the difference of the stresses. grid.vtu:
  // the same on the regular grid.
  void write_fields_vtu(const std::string &directory, const Comparison &c);
} // namespace diptych::coupling
