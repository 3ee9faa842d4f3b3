// diptych: state of one homogeneous point after a step
// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <type_traits>

#include "continuum/choices.h"

namespace diptych::continuum
{
  // Reliability of a row, from the best to the worst.
  enum class PointVerdict
  {
    reliable,
    zz_outside, // sigma_zz, which the law ignores, is beyond the yield surface of Mohr-Coulomb
    unreliable  // softening is so fast that the answer may not be unique (Verdict)
  };
  constexpr auto choices(PointVerdict)
  {
    return std::array{std::pair{PointVerdict::reliable, "reliable"}, std::pair{PointVerdict::zz_outside, "zz_outside"},
                      std::pair{PointVerdict::unreliable, "unreliable"}};
  }

  // State after a step, positive in compression. Strains are finite as in a panel with updated geometry: the increments of the
  // law are logarithmic, the columns refer to the initial shape.
  struct MaterialPointRow
  {
    double       progress                  = 0; // of the path: strain, time or number of the row
    double       axial_strain              = 0; // 1 - h/h0 [-]
    double       lateral_strain            = 0; // 1 - w/w0 [-]
    double       volumetric_strain         = 0; // 1 - V/V0 [-]
    double       exx                       = 0; // sums of the increments, logarithmic [-]
    double       eyy                       = 0;
    double       exy                       = 0; // component of the tensor
    double       sxx                       = 0; // lateral stress [pressure]
    double       syy                       = 0; // axial
    double       sxy                       = 0;
    double       szz                       = 0; // out of the plane
    double       stress_ratio              = 0; // t/s in the plane
    double       mobilised_friction_angle  = 0; // asin(t/s) [degrees]
    double       dilatancy_angle           = 0; // asin(-d eps_v / d gamma) of the step's total strain [degrees]; first row: zero
    double       equivalent_plastic_strain = 0; // hardening variable [-]
    double       overstress_share          = 0; // viscous overstress / shear strength [-]
    double       dissipation               = 0; // plastic work per initial area since the start [pressure]
    PointVerdict verdict                   = PointVerdict::reliable;
  };

  // Calls visit(column name, value, unit, meaning) for every entry of a row, in the order of material_point.csv.
  template <class Row, class Visit, std::enable_if_t<std::is_same_v<std::remove_const_t<Row>, MaterialPointRow>, int> = 0>
  void visit_columns(Row &r, Visit &&visit)
  {
    visit("progress", r.progress, "strain or time", "loading variable of the path; of a table without it: the number of the row");
    visit("axial_strain", r.axial_strain, "-", "1 - h/h0");
    visit("lateral_strain", r.lateral_strain, "-", "1 - w/w0");
    visit("volumetric_strain", r.volumetric_strain, "-", "1 - V/V0");
    visit("exx", r.exx, "-", "lateral logarithmic strain");
    visit("eyy", r.eyy, "-", "axial logarithmic strain");
    visit("exy", r.exy, "-", "shear strain, component of the tensor");
    visit("sxx", r.sxx, "pressure", "lateral stress");
    visit("syy", r.syy, "pressure", "axial stress");
    visit("sxy", r.sxy, "pressure", "shear stress");
    visit("szz", r.szz, "pressure", "stress out of the plane");
    visit("stress_ratio", r.stress_ratio, "-", "t/s in the plane");
    visit("mobilised_friction_angle", r.mobilised_friction_angle, "degrees", "asin(t/s)");
    visit("dilatancy_angle", r.dilatancy_angle, "degrees", "asin(-d eps_v / d gamma) of the step's whole strain");
    visit("equivalent_plastic_strain", r.equivalent_plastic_strain, "-", "hardening variable");
    visit("overstress_share", r.overstress_share, "-", "viscous overstress / shear strength");
    visit("dissipation", r.dissipation, "pressure", "plastic work per initial area since the start");
    visit("verdict", r.verdict, "-",
          "quality of the law's answer: reliable; zz_outside: sigma_zz, which the law ignores, is beyond the yield surface; "
          "unreliable: softening is so fast that the answer may not be unique");
  }
} // namespace diptych::continuum
