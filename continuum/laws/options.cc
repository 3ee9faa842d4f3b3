// diptych: checks of the parameters of the constitutive laws
// SPDX-License-Identifier: LGPL-2.1-or-later
#include "continuum/laws/options.h"

#include <algorithm>

namespace diptych::continuum
{
  namespace
  {
    // The moving cone has no return in principal space. Only a strength that depends on the hardening variable alone can depend
    // on the nonlocal one.
    template <class H> constexpr bool accepts(const LawTraits &law)
    {
      constexpr bool moves           = std::is_same_v<H, KinematicHardening>,
                     follows_density = std::is_base_of_v<CriticalStateHardening, H>;
      return !(moves && law.has_edges()) && !(follows_density && law.is_gradient);
    }
  } // namespace

  const LawParameter *LawParameters::find(const std::string &name) const
  {
    const auto found = std::find_if(list.begin(), list.end(), [&](const LawParameter &one) { return one.name == name; });
    return found == list.end() ? nullptr : &*found;
  }

  void LawParameters::set(const std::string &name, const double value)
  {
    for (LawParameter &one : list)
      if (one.name == name)
        {
          one.value = value;
          return;
        }
    list.emplace_back();
    list.back().name  = name;
    list.back().value = value;
  }

  const char *hardening_meaning()
  {
    static const std::string text = [] {
      std::string all;
      Hardenings::each([&](auto *hardening) {
        using H = TypeOf<decltype(hardening)>;
        all += (all.empty() ? "" : "; ") + std::string(H::name) + ": " + H::meaning;
      });
      return all;
    }();
    return text.c_str();
  }

  bool follows_solid_fraction(const HardeningKind hardening)
  {
    bool follows = false;
    Hardenings::with_type(hardening, [&](auto *chosen) {
      using Chosen = TypeOf<decltype(chosen)>;
      follows      = std::is_base_of_v<CriticalStateHardening, Chosen>;
    });
    return follows;
  }

  LawOptions in_units(LawOptions o, const Units &units)
  {
    visit_parameters(o, EachNumber{[&](const char *, double &value, const std::string &unit, const auto &) {
                       const std::string stress = "loading/pressure"; // the unit of viscosity begins with it
                       if (unit.compare(0, stress.size(), stress) == 0)
                         value *= units.stress;
                       else if (unit == "mean diameters")
                         value *= units.length;
                     }});
    return o;
  }

  std::vector<UnusedKey> unused_keys(const LawKind law, const LawOptions &o)
  {
    const LawTraits       is  = traits(law);
    const bool            own = law == LawKind::library;
    std::set<std::string> used, of_hardenings;
    const auto            use = [&](const bool reads, const auto &keys) {
      if (reads)
        used.insert(std::begin(keys), std::end(keys));
    };
    use(!own, keys_of(o.elastic));
    use(own, std::array{"law_library"});
    use(true, std::array{LawParameters::prefix});
    use(is.is_plastic, std::array{"hardening", "viscosity"});
    use(is.has_length(), keys_of<LengthOptions>(o));
    use(is.is_cosserat, keys_of<CosseratOptions>(o));
    use(is.is_gradient, keys_of<GradientOptions>(o));
    Hardenings::with_type(o.hardening, [&](auto *chosen) { use(is.is_plastic, TypeOf<decltype(chosen)>::keys); });
    if (is.is_plastic)
      for (const std::string &key : keys_of<Hardenings::Options>(o))
        of_hardenings.insert(key);
    std::vector<UnusedKey> unused;
    const std::string      this_law = "law = " + name_of(law);
    for (const std::string &key : keys_of(o))
      if (used.count(key) == 0)
        unused.push_back({key, of_hardenings.count(key) > 0 ? "hardening = " + name_of(o.hardening) : this_law});
    for (const LawParameter &one : o.library.parameters.list)
      if (!own)
        unused.push_back({LawParameters::prefix + one.name, this_law});
    return unused;
  }

  void validate(const LawKind law, const LawOptions &o)
  {
    const LawTraits is = traits(law);
    check_ranges(o, unused_keys(law, o));
    if (is.is_plastic)
      Hardenings::with_type(o.hardening, [&](auto *chosen) {
        using H = TypeOf<decltype(chosen)>;
        require_keys(accepts<H>(is), {"law", "hardening"}, "law = ", name_of(law), " does not accept hardening = ", H::name,
                     ": take another hardening, drucker_prager or a law with rotations");
        H::check(o);
      });
  }
} // namespace diptych::continuum
