// diptych: the comparison as files
// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <string>

#include <nlohmann/json_fwd.hpp>

#include "coupling/comparison.h"

namespace diptych::coupling
{
  // comparison.json and comparison.csv: every number of the report, lengths in mean diameters where the name ends in _d,
  // stresses in the scene's unit, angles from the horizontal in degrees. `provenance` supplies cost and counts.
  void write_comparison_json(const std::string    &directory,
                             const Scene          &scene,
                             const Comparison     &c,
                             const nlohmann::json &provenance);

  // One line a number: axial_strain_from, axial_strain_to, panel, quantity, value.
  void write_comparison_csv(const std::string &directory, const Comparison &c);

  // comparison.h5: the arrays behind the report's pictures.
  void write_comparison_h5(const std::string &directory, const Scene &scene, const Comparison &c);

  // fields.vtu: the last stage, both panels on the continuum's mesh in its position of that stage: stresses as 3x3 tensors
  // (compression positive), their difference, shear strain increments over the stage, grain count, solid fraction, and the
  // relative standard error of the grains' mean pressure.
  void write_fields_vtu(const std::string &directory, const Comparison &c);
} // namespace diptych::coupling
