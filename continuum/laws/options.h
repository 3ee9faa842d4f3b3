// diptych: parameters of the constitutive laws
// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <optional>
#include <string>
#include <vector>

namespace diptych::continuum
{
  struct ElasticOptions
  {
    // A packing of rigid discs has no modulus of its own: E/P sets only how steep the curve rises before the peak.
    double youngs_modulus = 500; // [pressure]; in units of the lateral pressure where the scene has P = 1
    // 0.1-0.25 is measured on dense granular packings at small strain (fabric, not grain, elasticity); 0.2 puts the
    // plane-strain K0 at nu/(1-nu) = 0.25, clearly inside the elastic range of any sand-like friction angle.
    double poisson_ratio = 0.2; // [-]
  };

  template <class Visitor> void visit_parameters(ElasticOptions &o, Visitor &&visitor)
  {
    visitor("youngs_modulus", o.youngs_modulus, "P", {1e-3, 1e12}, "Young's modulus; steepness of the curve before the peak");
    visitor("poisson_ratio", o.poisson_ratio, "-", {0., 0.49}, "Poisson's ratio");
  }

  // Parameters of all laws; a law reads those it knows. Pressures in the unit of the stress, lengths in that of the mesh.
  struct LawOptions
  {
    ElasticOptions        elastic;
    std::string           hardening                = "exponential";
    double                friction_angle_peak      = 20.5; // [degrees]
    double                friction_angle_residual  = 13.5; // [degrees]
    double                dilatancy_angle_peak     = 12;   // [degrees]
    double                dilatancy_angle_residual = 0;    // [degrees]; a constant positive value inflates the band for ever
    double                cohesion                 = 0.01; // [pressure]; keeps free corners from losing all stiffness
    std::optional<double> cohesion_residual;               // [pressure]; none: = cohesion
    double                softening_strain = 0.075;        // hardening variable of a decay by 1/e [-]
    std::vector<double>   table_strain;                    // hardening = table: values of the hardening variable [-]
    std::vector<double>   table_friction_angle;            // [degrees]
    std::vector<double>   table_dilatancy_angle;           // [degrees]
    std::vector<double>   table_cohesion;                  // [pressure]
    double                viscosity          = 0;          // [pressure x unit axial strain]; above zero where onset needs easing
    double                internal_length    = 1;          // Cosserat laws [length]
    double                couple_shear_ratio = 0.5;        // Cosserat laws: skew modulus / shear modulus [-]
  };

  template <class Visitor> void visit_parameters(LawOptions &o, Visitor &&visitor)
  {
    visit_parameters(o.elastic, visitor);
    visitor("hardening", o.hardening, "-", {"exponential", "table", "constant"},
            "exponential: from the peak to the residual values with the factor exp(-strain / softening_strain); table: the four "
            "lists, linear between their points and constant beyond them; constant: the peak values");
    visitor("friction_angle_peak", o.friction_angle_peak, "degrees", {0., 60.}, "friction angle before any plastic strain");
    visitor("friction_angle_residual", o.friction_angle_residual, "degrees", {0., 60.},
            "friction angle after long shear; at most the peak angle");
    visitor("dilatancy_angle_peak", o.dilatancy_angle_peak, "degrees", {0., 60.},
            "dilatancy angle before any plastic strain; at most the friction angle");
    visitor("dilatancy_angle_residual", o.dilatancy_angle_residual, "degrees", {0., 60.},
            "dilatancy angle after long shear; above zero the band dilates for ever");
    visitor("cohesion", o.cohesion, "P", {0., 1e12}, "cohesion before any plastic strain");
    visitor("cohesion_residual", o.cohesion_residual, "P", {0., 1e12}, "cohesion after long shear; auto: stays as it is");
    visitor("softening_strain", o.softening_strain, "-", {1e-6, 1e6},
            "equivalent plastic strain over which angles and cohesion decay by 1/e");
    visitor("table_strain", o.table_strain, "-", {0., 1e6}, "hardening = table: equivalent plastic strains, ascending from 0");
    visitor("table_friction_angle", o.table_friction_angle, "degrees", {0., 60.}, "hardening = table: friction angles there");
    visitor("table_dilatancy_angle", o.table_dilatancy_angle, "degrees", {0., 60.},
            "hardening = table: dilatancy angles there, nowhere above friction");
    visitor("table_cohesion", o.table_cohesion, "P", {0., 1e12}, "hardening = table: cohesion there");
    visitor("viscosity", o.viscosity, "P x unit axial strain", {0., 1e12},
            "stress above the yield surface per plastic shear strain over the axial strain of the step; 0: rate independent");
    visitor("internal_length", o.internal_length, "length", {1e-12, 1e12},
            "Cosserat laws: couple modulus = 2 G length^2; sets the thickness of the band");
    visitor("couple_shear_ratio", o.couple_shear_ratio, "-", {1e-6, 1e6}, "Cosserat laws: skew modulus over shear modulus");
  }

  // Both throw std::invalid_argument naming key, value and range. The keys that `hardening` does not use are not looked at.
  // Refused is also what contradicts itself: dilatancy above friction anywhere (the plastic work could become negative),
  // residual above peak, neither friction nor cohesion left.
  void validate(const ElasticOptions &options);
  void validate(const LawOptions &options);
} // namespace diptych::continuum
