// diptych: parameters of the constitutive laws
// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <array>
#include <set>
#include <string>
#include <typeindex>
#include <variant>
#include <vector>

#include "continuum/laws/decay_hardening.h"
#include "continuum/laws/kinds.h"
#include "continuum/laws/kinematic_hardening.h"
#include "continuum/laws/length_options.h"
#include "continuum/laws/parameters.h"
#include "continuum/laws/table_hardening.h"

namespace diptych::continuum
{
  // Hardenings whose kinds are their places. Functions receive the type of one as a null pointer.
  template <class... H> struct ListOf
  {
    using Form = std::variant<H...>;

    // The options of all, each once.
    template <class One> struct Brings : virtual One::Options
    {};
    struct Options : Brings<H>...
    {};

    template <class One> static constexpr HardeningKind kind()
    {
      unsigned int k = 0;
      (void)((std::is_same_v<One, H> || (++k, false)) || ...);
      return HardeningKind(k);
    }
    static constexpr auto names() { return std::array{std::pair{kind<H>(), static_cast<const char *>(H::name)}...}; }

    template <class Use> static void each(Use &&use) { (use(static_cast<H *>(nullptr)), ...); }
    template <class Use> static void with_type(const HardeningKind chosen, Use &&use)
    {
      ((chosen == kind<H>() ? use(static_cast<H *>(nullptr)) : void()), ...);
    }
  };
  template <class Pointer> using TypeOf = std::remove_pointer_t<Pointer>;

  // The hardenings that a scene can choose. A new one needs an entry here, its file and a line in CMakeLists.txt.
  using Hardenings    = ListOf<ExponentialHardening,
                            MobilisationHardening,
                            CriticalStateHardening,
                            KinematicHardening,
                            TableHardening,
                            ConstantHardening>;
  using HardeningForm = Hardenings::Form;

  template <class H> constexpr HardeningKind kind_of = Hardenings::kind<H>();

  constexpr auto choices(HardeningKind)
  {
    return Hardenings::names();
  }

  template <class Visitor> void visit_parameters(Hardenings::Options &o, Visitor &&visitor)
  {
    std::set<std::type_index> visited; // several hardenings may have the same options
    Hardenings::each([&](auto *hardening) {
      using Options = typename TypeOf<decltype(hardening)>::Options;
      if (visited.insert(typeid(Options)).second)
        visit_parameters(static_cast<Options &>(o), visitor);
    });
  }

  // "NAME: meaning; ..." of all hardenings.
  const char *hardening_meaning();

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

    std::vector<LawParameter> list; // set by the scene; after complete() (law_library.h) all of the library

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
  struct LawOptions : Hardenings::Options, CosseratOptions, GradientOptions
  {
    ElasticOptions elastic;
    HardeningKind  hardening = {};
    double         viscosity = 0; // [Units::stress x progress]; a positive value eases the onset of a band
    LibraryOptions library;
  };

  template <class Visitor> void visit_parameters(LawOptions &o, Visitor &&visitor)
  {
    visit_parameters(o.elastic, visitor);
    visitor("hardening", o.hardening, "-", hardening_meaning());
    visit_parameters(static_cast<Hardenings::Options &>(o), visitor);
    visitor(
      "viscosity", o.viscosity, "loading/pressure x strain (mode time: time)", {0., 1e12},
      "overstress per rate of plastic shear strain; the rate is per unit progress of the loading (strain, mode time: time); "
      "0: rate independent");
    visit_parameters(static_cast<LengthOptions &>(o), visitor);
    visit_parameters(static_cast<CosseratOptions &>(o), visitor);
    visit_parameters(static_cast<GradientOptions &>(o), visitor);
    visitor(
      "law_library", o.library.file, "-",
      "law = library: a shared library with a law of your own (diptych_law.h). Its parameters are the keys law.NAME of this "
      "section. A library is a program: use only those that you trust");
    visitor(LawParameters::prefix, o.library.parameters, "-", "law = library: parameters of the library");
  }

  // Whether the law starts from a solid fraction, given or mapped from the grains.
  bool follows_solid_fraction(HardeningKind hardening);

  // Converts the parameters to stresses and lengths; those of a library stay.
  LawOptions in_units(LawOptions options, const Units &units);

  // Keys of the list above that a law does not use with these options.
  std::vector<UnusedKey> unused_keys(LawKind law, const LawOptions &options);

  // Throws WrongKeys, which states key, value and range. Looks only at keys that the law uses. Also rejects contradictions: a
  // dilatancy angle must not exceed the friction angle, because plastic work could become negative; a residual value must not
  // exceed the peak value; friction and cohesion must not both be zero; hardening and law must suit each other.
  void validate(LawKind law, const LawOptions &options);
} // namespace diptych::continuum
