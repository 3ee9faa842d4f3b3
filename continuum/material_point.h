// diptych: one homogeneous point driven along the biaxial path
// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <string>
#include <vector>

#include "continuum/laws/any_law.h"

namespace diptych::continuum
{
  // Constant lateral pressure, plane strain, the axial strain growing in equal steps from an isotropic stress.
  struct MaterialPointPath
  {
    double pressure     = 1;    // [pressure], positive
    double axial_strain = 0.1;  // at the end: shortening / initial height, in (0, 1)
    double step         = 1e-3; // of the axial strain; the last one is shorter where it does not divide the end
  };

  // State after a step. Strain and stress positive in compression. Strain is finite as in a panel with updated geometry: the
  // law's increments are logarithmic, the columns refer to the initial shape.
  struct MaterialPointRow
  {
    double  axial_strain              = 0; // 1 - h/h0 [-]
    double  lateral_strain            = 0; // 1 - w/w0 [-]
    double  volumetric_strain         = 0; // 1 - V/V0 [-]
    double  sxx                       = 0; // lateral stress [pressure]
    double  syy                       = 0; // axial
    double  szz                       = 0; // out of the plane
    double  stress_ratio              = 0; // t/s in the plane
    double  mobilised_friction_angle  = 0; // asin(t/s) [degrees]
    double  dilatancy_angle           = 0; // asin(-d eps_v / d gamma) of the step's whole strain [degrees]; first row: zero
    double  equivalent_plastic_strain = 0; // hardening variable [-]
    double  overstress_share          = 0; // viscous overstress / shear strength [-]
    double  dissipation               = 0; // plastic work per initial area since the start [pressure]
    Verdict verdict                   = Verdict::reliable;
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

  // Comma-separated, one line of names; whole or absent. Throws std::runtime_error naming the file.
  void write_csv(const MaterialPointReport &report, const std::string &file);
} // namespace diptych::continuum
