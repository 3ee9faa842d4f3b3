// diptych: parameters of the constitutive laws
// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <array>
#include <string>
#include <variant>
#include <vector>

#include "continuum/laws/decay_hardening.h"
#include "continuum/laws/kinematic_hardening.h"
#include "continuum/laws/parameters.h"
#include "continuum/laws/table_hardening.h"

namespace diptych::continuum
{
  // All kinds of hardening. One that has keys of its own is also a base of LawOptions.
  using HardeningForm = std::variant<ExponentialHardening,
                                     MobilisationHardening,
                                     TableHardening,
                                     CriticalStateHardening,
                                     KinematicHardening,
                                     ConstantHardening>;

  template <class... H> constexpr auto names_of(const std::variant<H...> *)
  {
    return std::array{std::pair{H::kind, static_cast<const char *>(H::name)}...};
  }
  constexpr auto choices(HardeningKind)
  {
    return names_of(static_cast<const HardeningForm *>(nullptr));
  }

  // Calls `use` with Chosen<H> for the type H of a hardening.
  template <class H> struct Chosen
  {
    using Type = H;
  };
  template <class Use, class... H> void with_type(const HardeningKind kind, Use &&use, const std::variant<H...> *)
  {
    ((H::kind == kind ? use(Chosen<H>()) : void()), ...);
  }
  template <class Use> void with_type(const HardeningKind kind, Use &&use)
  {
    with_type(kind, use, static_cast<const HardeningForm *>(nullptr));
  }

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

  // Parameters of all laws, as a scene sets them; each law reads its own. Stresses and lengths in Units.
  struct LawOptions : KinematicOptions, TableOptions
  {
    ElasticOptions elastic;
    HardeningKind  hardening          = HardeningKind::exponential;
    double         viscosity          = 0;   // [Units::stress x progress]; a positive value eases the onset of a band
    double         internal_length    = 1;   // Cosserat and gradient laws [Units::length]
    double         couple_shear_ratio = 0.5; // Cosserat laws: skew modulus / shear modulus [-]
    double         nonlocal_weight    = 4;   // gradient laws: weight of the nonlocal hardening variable [-]
    LibraryOptions library;
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
    visit_parameters(static_cast<DecayOptions &>(o), visitor);
    visit_parameters(static_cast<CriticalStateOptions &>(o), visitor);
    visit_parameters(static_cast<KinematicOptions &>(o), visitor);
    visit_parameters(static_cast<TableOptions &>(o), visitor);
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
  bool follows_solid_fraction(HardeningKind hardening);

  // The same parameters as stresses and lengths; those of a library stay.
  LawOptions in_units(LawOptions options, const Units &units);

  // Keys of the list above that a law does not use with these options.
  std::vector<UnusedKey> unused_keys(LawKind law, const LawOptions &options);

  // Throws WrongKeys, which states key, value and range. Looks only at keys that the law uses. Also rejects contradictions: a
  // dilatancy angle must not exceed the friction angle, because plastic work could become negative; a residual value must not
  // exceed the peak value; friction and cohesion must not both be zero; hardening and law must suit each other.
  void validate(LawKind law, const LawOptions &options);
} // namespace diptych::continuum
