// diptych: checks of the parameters of the constitutive laws
// SPDX-License-Identifier: LGPL-2.1-or-later
#include "continuum/laws/options.h"

#include <algorithm>
#include <map>

namespace diptych::continuum
{
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

  bool follows_solid_fraction(const HardeningKind hardening)
  {
    return hardening == HardeningKind::critical_state || hardening == HardeningKind::kinematic;
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
    const LawTraits                   is       = traits(law);
    const bool                        own      = law == LawKind::library;
    const std::map<std::string, bool> of_laws  = {{"law_library", own},
                                                  {"youngs_modulus", !own},
                                                  {"poisson_ratio", !own},
                                                  {"internal_length", is.has_length()},
                                                  {"couple_shear_ratio", is.is_cosserat},
                                                  {"nonlocal_weight", is.is_gradient},
                                                  {"hardening", is.is_plastic},
                                                  {"viscosity", is.is_plastic}};
    const std::string                 this_law = "law = " + name_of(law);
    std::vector<UnusedKey>            unused;
    std::set<std::string>             hardens;
    with_type(o.hardening, [&](const auto chosen) {
      const auto &keys = decltype(chosen)::Type::keys;
      hardens.insert(keys.begin(), keys.end());
    });
    for (const std::string &key : keys_of(o))
      if (const auto known = of_laws.find(key); known != of_laws.end())
        {
          if (!known->second)
            unused.push_back({key, this_law});
        }
      else if (key != LawParameters::prefix && !(is.is_plastic && hardens.count(key) > 0))
        unused.push_back({key, is.is_plastic ? "hardening = " + name_of(o.hardening) : this_law});
    for (const LawParameter &one : o.library.parameters.list)
      if (!own)
        unused.push_back({LawParameters::prefix + one.name, this_law});
    return unused;
  }

  void validate(const LawKind law, const LawOptions &o)
  {
    check_ranges(o, unused_keys(law, o));
    if (traits(law).is_plastic)
      with_type(o.hardening, [&](const auto chosen) { decltype(chosen)::Type::check(o, law); });
  }
} // namespace diptych::continuum
