// diptych: parameters of the constitutive laws
// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <array>
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
    gradient_mohr_coulomb,
    gradient_drucker_prager,
    mohr_coulomb,
    drucker_prager,
    linear_elastic,
    library // of the user
  };

  constexpr auto choices(LawKind)
  {
    return std::array{std::pair{LawKind::cosserat_mohr_coulomb, "cosserat_mohr_coulomb"},
                      std::pair{LawKind::cosserat_drucker_prager, "cosserat_drucker_prager"},
                      std::pair{LawKind::gradient_mohr_coulomb, "gradient_mohr_coulomb"},
                      std::pair{LawKind::gradient_drucker_prager, "gradient_drucker_prager"},
                      std::pair{LawKind::mohr_coulomb, "mohr_coulomb"},
                      std::pair{LawKind::drucker_prager, "drucker_prager"},
                      std::pair{LawKind::linear_elastic, "linear_elastic"},
                      std::pair{LawKind::library, "library"}};
  }

  // Properties of a law that the rest of the program needs. Those of a library follow from its description (is_cosserat() in
  // continuum/options.h).
  struct LawTraits
  {
    bool is_cosserat;    // has rotations, couple stress and hence an internal length
    bool is_gradient;    // has a nonlocal hardening variable and hence an internal length
    bool is_plastic;     // has strength, hardening and viscosity
    bool stays_in_plane; // ignores sigma_zz: exact only if that is the intermediate principal stress

    constexpr bool has_length() const { return is_cosserat || is_gradient; }
  };
  constexpr LawTraits traits(const LawKind law)
  {
    switch (law)
      {
      case LawKind::cosserat_mohr_coulomb:
        return {true, false, true, true};
      case LawKind::cosserat_drucker_prager:
        return {true, false, true, false};
      case LawKind::gradient_mohr_coulomb:
        return {false, true, true, true};
      case LawKind::gradient_drucker_prager:
        return {false, true, true, false};
      case LawKind::linear_elastic:
      case LawKind::library:
        return {false, false, false, false};
      case LawKind::mohr_coulomb:
      case LawKind::drucker_prager:
        break;
      }
    return {false, false, true, false};
  }

  // The law of a point in a uniform deformation without rotation, where a nonlocal hardening variable equals the local one.
  constexpr LawKind uniform_law(const LawKind law)
  {
    return law == LawKind::gradient_mohr_coulomb     ? LawKind::cosserat_mohr_coulomb
           : law == LawKind::gradient_drucker_prager ? LawKind::drucker_prager
                                                     : law;
  }

  enum class HardeningKind
  {
    exponential,
    mobilisation, // exponential, but friction starts lower and rises first
    table,
    critical_state, // strength and dilatancy follow solid fraction and mobilisation (hardening.h)
    kinematic,      // critical_state whose mobilised stress ratio has a direction (kinematic_return.h)
    constant
  };

  constexpr auto choices(HardeningKind)
  {
    return std::array{std::pair{HardeningKind::exponential, "exponential"},
                      std::pair{HardeningKind::mobilisation, "mobilisation"},
                      std::pair{HardeningKind::table, "table"},
                      std::pair{HardeningKind::critical_state, "critical_state"},
                      std::pair{HardeningKind::kinematic, "kinematic"},
                      std::pair{HardeningKind::constant, "constant"}};
  }

  // Units of a law's parameters. Stresses and moduli are multiples of the lateral pressure of the loading, lengths of the mean
  // grain diameter. in_units() below converts them.
  struct Units
  {
    double stress = 1; // [pressure]
    double length = 1; // [length]
  };

  struct ElasticOptions
  {
    // A packing of rigid discs has no modulus of its own: E/P sets only how steep the curve rises before the peak.
    double youngs_modulus = 500; // [Units::stress]
    // Dense granular packings have 0.1-0.25 at small strain, which reflects the fabric, not the grains. With 0.2 the
    // plane-strain K0 = nu/(1-nu) is 0.25, well inside the elastic range of any sand-like friction angle.
    double poisson_ratio = 0.2; // [-]
  };

  template <class Visitor> void visit_parameters(ElasticOptions &o, Visitor &&visitor)
  {
    visitor("youngs_modulus", o.youngs_modulus, "loading/pressure", {1e-3, 1e12},
            "Young's modulus; steepness of the curve before the peak");
    visitor("poisson_ratio", o.poisson_ratio, "-", {0., 0.49}, "Poisson's ratio");
  }

  // law = library: the user's law (diptych_law.h) and its parameters, which a scene sets as keys law.NAME.
  struct LibraryFile
  {
    std::string path;
  };

  struct LawParameter
  {
    std::string           name;
    double                value = 0; // in `unit`
    std::string           unit  = "-", meaning;
    std::array<double, 2> range = {-1e300, 1e300};
  };

  struct LawParameters
  {
    static constexpr const char *prefix = "law."; // of the keys, and of the state variables in results

    std::vector<LawParameter> list; // those that the scene sets; all of the library after complete() (law_library.h)

    const LawParameter *find(const std::string &name) const;
    void                set(const std::string &name, double value);
  };

  struct LibraryOptions
  {
    LibraryFile   file;
    LawParameters parameters;
    bool          is_cosserat = false; // known after complete()
  };

  // Parameters of all laws; each law reads its own. Stresses and lengths in Units.
  struct LawOptions
  {
    ElasticOptions        elastic;
    HardeningKind         hardening                = HardeningKind::exponential;
    double                friction_angle_peak      = 20.5; // [degrees]
    double                friction_angle_residual  = 13.5; // [degrees]
    double                friction_angle_start     = 12;   // [degrees]; hardening = mobilisation
    double                dilatancy_angle_peak     = 12;   // [degrees]
    double                dilatancy_angle_residual = 0;    // [degrees]; if constant and positive, the band dilates without end
    double                cohesion                 = 0.01; // [Units::stress]; without it free corners can lose all stiffness
    std::optional<double> cohesion_residual;               // [Units::stress]; empty: = cohesion
    double                softening_strain    = 0.075;     // hardening variable over which strength decays by 1/e [-]
    double                mobilisation_strain = 0.005;     // mobilisation: the same for the initial deficit of friction [-]
    std::vector<double>   table_strain;                    // hardening = table: values of the hardening variable [-]
    std::vector<double>   table_friction_angle;            // [degrees]
    std::vector<double>   table_dilatancy_angle;           // [degrees]
    std::vector<double>   table_cohesion;                  // [Units::stress]
    double                critical_stress_ratio   = 0.26;  // hardening = critical_state: t/s of steady flow [-]
    double                critical_solid_fraction = 0.82;  // solid fraction of steady flow [-]
    double                strength_by_density     = 5.5;   // d(t/s that can be mobilised) / d(solid fraction) [-]
    double                dilatancy_ratio         = 0.55;  // (t/s - t/s of steady flow) / sin(dilatancy angle) [-]
    double                stress_ratio_start      = 0.1;   // mobilised t/s of the prepared sample [-]
    double                elastic_stress_ratio    = 0.05;  // kinematic: half the elastic range of t/s after long shear [-]
    std::optional<double> solid_fraction_start;            // of the prepared sample [-]; empty: mapped from the grains
    double                viscosity          = 0;   // [Units::stress x progress]; a positive value eases the onset of a band
    double                internal_length    = 1;   // Cosserat and gradient laws [Units::length]
    double                couple_shear_ratio = 0.5; // Cosserat laws: skew modulus / shear modulus [-]
    LibraryOptions        library;
    double                nonlocal_weight = 4; // gradient laws: weight of the nonlocal hardening variable [-]
  };

  template <class Visitor> void visit_parameters(LawOptions &o, Visitor &&visitor)
  {
    visit_parameters(o.elastic, visitor);
    visitor(
      "hardening", o.hardening, "-",
      "exponential: decay from peak to residual values with exp(-strain / softening_strain); mobilisation: the "
      "same, but friction starts at friction_angle_start and is lower by (peak - start) exp(-strain / mobilisation_strain); "
      "table: the four lists, linear between their points and constant beyond them; critical_state: both angles follow "
      "solid fraction and mobilisation; kinematic: critical_state that unloads and reverses; constant: the peak values");
    visitor("friction_angle_peak", o.friction_angle_peak, "degrees", {0., 60.},
            "friction angle before any plastic strain; hardening = mobilisation: the value it would have if fully mobilised");
    visitor("friction_angle_start", o.friction_angle_start, "degrees", {0., 60.},
            "hardening = mobilisation: friction angle before any plastic strain; at most the peak angle");
    visitor("mobilisation_strain", o.mobilisation_strain, "-", {1e-6, 1e6},
            "hardening = mobilisation, critical_state, kinematic: equivalent plastic strain over which the deficit of friction "
            "decays by 1/e");
    visitor("friction_angle_residual", o.friction_angle_residual, "degrees", {0., 60.},
            "friction angle after long shear; at most the peak angle");
    visitor("dilatancy_angle_peak", o.dilatancy_angle_peak, "degrees", {0., 60.},
            "dilatancy angle before any plastic strain; at most the friction angle");
    visitor("dilatancy_angle_residual", o.dilatancy_angle_residual, "degrees", {0., 60.},
            "dilatancy angle after long shear; if above zero, the band dilates without end");
    visitor("cohesion", o.cohesion, "loading/pressure", {0., 1e12}, "cohesion before any plastic strain");
    visitor("cohesion_residual", o.cohesion_residual, "loading/pressure", {0., 1e12},
            "cohesion after long shear; auto: equal to cohesion");
    visitor("softening_strain", o.softening_strain, "-", {1e-6, 1e6},
            "equivalent plastic strain over which angles and cohesion decay by 1/e");
    visitor("critical_stress_ratio", o.critical_stress_ratio, "-", {0.01, 0.9},
            "hardening = critical_state, kinematic: t/s of steady flow");
    visitor("critical_solid_fraction", o.critical_solid_fraction, "-", {0.1, 1.},
            "hardening = critical_state, kinematic: solid fraction of steady flow");
    visitor("strength_by_density", o.strength_by_density, "-", {1e-6, 1e3},
            "hardening = critical_state, kinematic: d(t/s that can be mobilised) / d(solid fraction)");
    visitor("dilatancy_ratio", o.dilatancy_ratio, "-", {0.05, 20.},
            "hardening = critical_state, kinematic: (t/s - t/s of steady flow) / sine of the dilatancy angle");
    visitor("stress_ratio_start", o.stress_ratio_start, "-", {0., 0.9},
            "hardening = critical_state, kinematic: mobilised t/s of the prepared sample");
    visitor("elastic_stress_ratio", o.elastic_stress_ratio, "-", {0.001, 0.9},
            "hardening = kinematic: half the elastic range of t/s after long shear");
    visitor(
      "solid_fraction_start", o.solid_fraction_start, "-", {0.1, 1.},
      "hardening = critical_state, kinematic: solid fraction of the prepared sample; auto: mapped from its grains, cell by cell");
    visitor("table_strain", o.table_strain, "-", {0., 1e6}, "hardening = table: equivalent plastic strains, ascending from 0");
    visitor("table_friction_angle", o.table_friction_angle, "degrees", {0., 60.},
            "hardening = table: friction angles at table_strain");
    visitor("table_dilatancy_angle", o.table_dilatancy_angle, "degrees", {0., 60.},
            "hardening = table: dilatancy angles at table_strain, never above friction");
    visitor("table_cohesion", o.table_cohesion, "loading/pressure", {0., 1e12}, "hardening = table: cohesion at table_strain");
    visitor(
      "viscosity", o.viscosity, "loading/pressure x strain (mode time: time)", {0., 1e12},
      "overstress per rate of plastic shear strain; the rate is per unit progress of the loading (strain, mode time: time); "
      "0: rate independent");
    visitor("internal_length", o.internal_length, "mean diameters", {1e-6, 1e6},
            "Cosserat laws: couple modulus = 2 G length^2; gradient laws: the hardening variable is averaged over this length; "
            "sets the thickness of the band");
    visitor("couple_shear_ratio", o.couple_shear_ratio, "-", {1e-6, 1e6}, "Cosserat laws: skew modulus / shear modulus");
    visitor(
      "nonlocal_weight", o.nonlocal_weight, "-", {1., 10.},
      "gradient laws: weight m of the averaged hardening variable, the local one has 1 - m; with 1 the mesh sets the band's "
      "thickness");
    visitor(
      "law_library", o.library.file, "-",
      "law = library: a shared library with a law of your own (diptych_law.h). Its parameters are the keys law.NAME of this "
      "section. A library is a program: use only those that you trust");
    visitor(LawParameters::prefix, o.library.parameters, "-", "law = library: parameters of the library");
  }

  // Whether the law starts from a solid fraction, given or mapped from the grains.
  constexpr bool follows_solid_fraction(const HardeningKind hardening)
  {
    return hardening == HardeningKind::critical_state || hardening == HardeningKind::kinematic;
  }

  // The same parameters as stresses and lengths.
  LawOptions in_units(LawOptions options, const Units &units);

  // Keys of the list above that a law does not use with these options. `because` is the choice responsible, such as "law =
  // mohr_coulomb" or "hardening = constant".
  struct UnusedKey
  {
    std::string key, because;
  };
  std::vector<UnusedKey> unused_keys(LawKind law, const LawOptions &options);

  // Both throw std::invalid_argument, which states key, value and range. They do not check keys that `hardening` does not use.
  // They also reject contradictions. A dilatancy angle must not exceed the friction angle, because plastic work could become
  // negative. A residual value must not exceed the peak value. Friction and cohesion must not both be zero.
  void validate(const ElasticOptions &options);
  void validate(const LawOptions &options);
  // The same for a plastic law with its hardening: kinematic has no return in principal space, which mohr_coulomb needs.
  void validate(LawKind law, const LawOptions &options);
} // namespace diptych::continuum
