// diptych: numbers among the parameters of a visit: their ranges and units
// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <array>
#include <optional>
#include <set>
#include <string>
#include <type_traits>
#include <vector>

#include "continuum/require.h"

namespace diptych::continuum
{
  // Units of a law's parameters. Stresses and moduli are multiples of the lateral pressure of the loading, lengths of the mean
  // grain diameter. in_units() in options.h converts them.
  struct Units
  {
    double stress = 1; // [pressure]
    double length = 1; // [length]
  };

  // A visitor of visit_parameters() that calls `visit` with key, number, unit and range of every number, also of those in lists.
  template <class Visit> struct EachNumber
  {
    Visit visit;

    template <class Value>
    void operator()(const char *key, Value &value, const char *unit, const std::array<double, 2> &range, const char *) const
    {
      if constexpr (std::is_same_v<Value, std::vector<double>>)
        for (double &one : value)
          visit(key, one, unit, range);
      else if constexpr (std::is_same_v<Value, std::optional<double>>)
        {
          if (value)
            visit(key, *value, unit, range);
        }
      else
        visit(key, value, unit, range);
    }
    template <class Value> void operator()(const char *, Value &, const char *, const char *) const {}
  };
  template <class Visit> EachNumber(Visit) -> EachNumber<Visit>;

  // A visitor that lists the keys.
  struct KeyNames
  {
    std::vector<std::string> &names;

    template <class Value>
    void operator()(const char *key, Value &, const char *, const std::array<double, 2> &, const char *) const
    {
      names.push_back(key);
    }
    template <class Value> void operator()(const char *key, Value &, const char *, const char *) const { names.push_back(key); }
  };
  template <class Options> std::vector<std::string> keys_of(Options options)
  {
    std::vector<std::string> names;
    visit_parameters(options, KeyNames{names});
    return names;
  }

  // A key that is not used. `because` is the choice responsible, such as "law = mohr_coulomb" or "hardening = constant".
  struct UnusedKey
  {
    std::string key, because;
  };

  // Calls visit(key, number, unit, range) for every number of the keys that are not unused.
  template <class Options, class Visit>
  void each_used_number(Options options, const std::vector<UnusedKey> &unused, const Visit &visit)
  {
    std::set<std::string> unread;
    for (const UnusedKey &one : unused)
      unread.insert(one.key);
    visit_parameters(options, EachNumber{[&](const std::string &key, const double value, const char *unit, const auto &range) {
                       if (unread.count(key) == 0)
                         visit(key, value, unit, range);
                     }});
  }

  // Throws WrongKeys if a number is outside the range of its key, unless that is unused.
  template <class Options> void check_ranges(const Options &options, const std::vector<UnusedKey> &unused)
  {
    each_used_number(options, unused, [](const std::string &key, const double value, const char *, const auto &range) {
      require_keys(value >= range[0] && value <= range[1], {key}, key, " = ", value, " must lie in [", range[0], ", ", range[1],
                   "]"); // false for NaN
    });
  }
} // namespace diptych::continuum
