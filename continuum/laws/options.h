// diptych: parameters of the constitutive laws
// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "continuum/choices.h"

namespace diptych::continuum
{
  enum class LawKind
  {
    cosserat_mohr_coulomb,
    cosserat_drucker_prager,
    mohr_coulomb,
    drucker_prager,
    linear_elastic
  };

  constexpr auto choices(LawKind)
  {
    return std::array{std::pair{LawKind::cosserat_mohr_coulomb, "cosserat_mohr_coulomb"},
                      std::pair{LawKind::cosserat_drucker_prager, "cosserat_drucker_prager"},
                      std::pair{LawKind::mohr_coulomb, "mohr_coulomb"}, std::pair{LawKind::drucker_prager, "drucker_prager"},
                      std::pair{LawKind::linear_elastic, "linear_elastic"}};
  }

  // What the rest of the program must know of a law.
  struct LawTraits
  {
    bool is_cosserat;    // has rotations and couple stress, thus an internal length
    bool is_plastic;     // has strength, hardening and viscosity
    bool stays_in_plane; // never looks at sigma_zz: exact only where that is the intermediate principal stress
  };
  constexpr LawTraits traits(const LawKind law)
  {
    switch (law)
      {
      case LawKind::cosserat_mohr_coulomb:
        return {true, true, true};
      case LawKind::cosserat_drucker_prager:
        return {true, true, false};
      case LawKind::linear_elastic:
        return {false, false, false};
      case LawKind::mohr_coulomb:
      case LawKind::drucker_prager:
        break;
      }
    return {false, true, false};
  }

  enum class HardeningKind
  {
    exponential,
    mobilisation, // exponential, but friction begins below and rises first
    table,
    critical_state, // strength and dilatancy from solid fraction and mobilisation (hardening.h)
    constant
  };

  constexpr auto choices(HardeningKind)
  {
    return std::array{std::pair{HardeningKind::exponential, "exponential"},
                      std::pair{HardeningKind::mobilisation, "mobilisation"}, std::pair{HardeningKind::table, "table"},
                      std::pair{HardeningKind::critical_state, "critical_state"}, std::pair{HardeningKind::constant, "constant"}};
  }

  // In what the parameters of a law count: stresses and moduli in the lateral pressure of the loading, lengths in the mean grain
  // diameter. One place turns them into stresses and lengths: in_units() below.
  struct Units
  {
    double stress = 1; // [pressure]
    double length = 1; // [length]
  };

  struct ElasticOptions
  {
    // A packing of rigid discs has no modulus of its own: E/P sets only how steep the curve rises before the peak.
    double youngs_modulus = 500; // [Units::stress]
    // 0.1-0.25 is measured on dense granular packings at small strain (fabric, not grain, elasticity); 0.2 puts the
    // plane-strain K0 at nu/(1-nu) = 0.25, clearly inside the elastic range of any sand-like friction angle.
    double poisson_ratio = 0.2; // [-]
  };

  template <class Visitor> void visit_parameters(ElasticOptions &o, Visitor &&visitor)
  {
    visitor("youngs_modulus", o.youngs_modulus, "loading/pressure", {1e-3, 1e12},
            "Young's modulus; steepness of the curve before the peak");
    visitor("poisson_ratio", o.poisson_ratio, "-", {0., 0.49}, "Poisson's ratio");
  }

  // Parameters of all laws; a law reads those it knows. Stresses and lengths in Units.
  struct LawOptions
  {
    ElasticOptions        elastic;
    HardeningKind         hardening                = HardeningKind::exponential;
    double                friction_angle_peak      = 20.5; // [degrees]
    double                friction_angle_residual  = 13.5; // [degrees]
    double                friction_angle_start     = 12;   // [degrees]; hardening = mobilisation
    double                dilatancy_angle_peak     = 12;   // [degrees]
    double                dilatancy_angle_residual = 0;    // [degrees]; a constant positive value inflates the band for ever
    double                cohesion                 = 0.01; // [Units::stress]; keeps free corners from losing all stiffness
    std::optional<double> cohesion_residual;               // [Units::stress]; none: = cohesion
    double                softening_strain    = 0.075;     // hardening variable of a decay by 1/e [-]
    double                mobilisation_strain = 0.005;     // hardening = mobilisation: of a rise by 1 - 1/e [-]
    std::vector<double>   table_strain;                    // hardening = table: values of the hardening variable [-]
    std::vector<double>   table_friction_angle;            // [degrees]
    std::vector<double>   table_dilatancy_angle;           // [degrees]
    std::vector<double>   table_cohesion;                  // [Units::stress]
    double                critical_stress_ratio   = 0.26;  // hardening = critical_state: t/s of steady flow [-]
    double                critical_solid_fraction = 0.82;  // of steady flow [-]
    double                strength_by_density     = 5.5;   // d(t/s) / d(solid fraction) of what can be mobilised [-]
    double                dilatancy_ratio         = 0.55;  // (t/s - that of steady flow) / sin(dilatancy angle) [-]
    double                stress_ratio_start      = 0.1;   // mobilised t/s of the prepared sample [-]
    std::optional<double> solid_fraction_start;            // of the prepared sample [-]; none: mapped from the grains
    double                viscosity          = 0;          // [Units::stress x progress]; above zero where onset needs easing
    double                internal_length    = 1;          // Cosserat laws [Units::length]
    double                couple_shear_ratio = 0.5;        // Cosserat laws: skew modulus / shear modulus [-]
  };

  template <class Visitor> void visit_parameters(LawOptions &o, Visitor &&visitor)
  {
    visit_parameters(o.elastic, visitor);
    visitor(
      "hardening", o.hardening, "-",
      "exponential: from the peak to the residual values with the factor exp(-strain / softening_strain); mobilisation: the "
      "same, but friction begins at friction_angle_start and lacks (peak - start) exp(-strain / mobilisation_strain); "
      "table: the four lists, linear between their points and constant beyond them; critical_state: both angles follow "
      "solid fraction and mobilisation; constant: the peak values");
    visitor("friction_angle_peak", o.friction_angle_peak, "degrees", {0., 60.},
            "friction angle before any plastic strain; hardening = mobilisation: what it would be there, were all mobilised");
    visitor("friction_angle_start", o.friction_angle_start, "degrees", {0., 60.},
            "hardening = mobilisation: friction angle before any plastic strain; at most the peak angle");
    visitor("mobilisation_strain", o.mobilisation_strain, "-", {1e-6, 1e6},
            "hardening = mobilisation, critical_state: equivalent plastic strain over which what friction lacks decays by 1/e");
    visitor("friction_angle_residual", o.friction_angle_residual, "degrees", {0., 60.},
            "friction angle after long shear; at most the peak angle");
    visitor("dilatancy_angle_peak", o.dilatancy_angle_peak, "degrees", {0., 60.},
            "dilatancy angle before any plastic strain; at most the friction angle");
    visitor("dilatancy_angle_residual", o.dilatancy_angle_residual, "degrees", {0., 60.},
            "dilatancy angle after long shear; above zero the band dilates for ever");
    visitor("cohesion", o.cohesion, "loading/pressure", {0., 1e12}, "cohesion before any plastic strain");
    visitor("cohesion_residual", o.cohesion_residual, "loading/pressure", {0., 1e12},
            "cohesion after long shear; auto: stays as it is");
    visitor("softening_strain", o.softening_strain, "-", {1e-6, 1e6},
            "equivalent plastic strain over which angles and cohesion decay by 1/e");
    visitor("critical_stress_ratio", o.critical_stress_ratio, "-", {0.01, 0.9}, "hardening = critical_state: t/s of steady flow");
    visitor("critical_solid_fraction", o.critical_solid_fraction, "-", {0.1, 1.},
            "hardening = critical_state: solid fraction of steady flow");
    visitor("strength_by_density", o.strength_by_density, "-", {1e-6, 1e3},
            "hardening = critical_state: t/s that can be mobilised, by solid fraction");
    visitor("dilatancy_ratio", o.dilatancy_ratio, "-", {0.05, 20.},
            "hardening = critical_state: what t/s has above that of steady flow, over the sine of the dilatancy angle");
    visitor("stress_ratio_start", o.stress_ratio_start, "-", {0., 0.9},
            "hardening = critical_state: t/s that the prepared sample has mobilised");
    visitor("solid_fraction_start", o.solid_fraction_start, "-", {0.1, 1.},
            "hardening = critical_state: solid fraction of the prepared sample; auto: of its grains, cell by cell");
    visitor("table_strain", o.table_strain, "-", {0., 1e6}, "hardening = table: equivalent plastic strains, ascending from 0");
    visitor("table_friction_angle", o.table_friction_angle, "degrees", {0., 60.}, "hardening = table: friction angles there");
    visitor("table_dilatancy_angle", o.table_dilatancy_angle, "degrees", {0., 60.},
            "hardening = table: dilatancy angles there, nowhere above friction");
    visitor("table_cohesion", o.table_cohesion, "loading/pressure", {0., 1e12}, "hardening = table: cohesion there");
    visitor(
      "viscosity", o.viscosity, "loading/pressure x strain (mode time: time)", {0., 1e12},
      "stress above the yield surface per plastic shear strain over the step's length along the loading; 0: rate independent");
    visitor("internal_length", o.internal_length, "mean diameters", {1e-6, 1e6},
            "Cosserat laws: couple modulus = 2 G length^2; sets the thickness of the band");
    visitor("couple_shear_ratio", o.couple_shear_ratio, "-", {1e-6, 1e6}, "Cosserat laws: skew modulus over shear modulus");
  }

  // The same parameters as stresses and lengths.
  LawOptions in_units(LawOptions options, const Units &units);

  // Keys of the list above that a law does not use as the options stand, each with the choice that says so ("law =
  // mohr_coulomb", "hardening = constant").
  struct UnusedKey
  {
    std::string key, because;
  };
  std::vector<UnusedKey> unused_keys(LawKind law, const LawOptions &options);

  // Both throw std::invalid_argument naming key, value and range. The keys that `hardening` does not use are not looked at.
  // Refused is also what contradicts itself: dilatancy above friction anywhere (the plastic work could become negative),
  // residual above peak, neither friction nor cohesion left.
  void validate(const ElasticOptions &options);
  void validate(const LawOptions &options);
} // namespace diptych::continuum
