// diptych: the numbers of a comparison that a user asks for first
// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <array>
#include <string>
#include <vector>

#include "coupling/comparison/checks.h"
#include "coupling/comparison/comparison.h"
#include "coupling/comparison/key_quantities.h"
#include "coupling/numbers/number_entry.h"
#include "coupling/statistics/interval.h"

namespace diptych::coupling
{
  // One quantity of both panels. Ends of intervals are NaN where one sample gives none. The difference is continuum - grains.
  struct KeyNumber
  {
    std::string key, quantity, unit;
    Interval    grains, continuum, difference;
    std::string verdict; // "different", "cannot tell", "no interval (one sample)", "diffuse" or "not in both panels"
  };

  // In the order of key_quantities, with the band of the last window; without a window there is none.
  std::vector<KeyNumber> key_numbers(const Comparison &c);

  constexpr const char *verdict_meaning =
    "different: the interval of the difference excludes 0; cannot tell: it contains 0; diffuse: a zone "
    "wider than a third of the sample has no inclination; else: why there is none";

  template <class Visitor> void list_numbers(const KeyNumber &k, Visitor &v)
  {
    v({"key", "-", "key of the quantity", Kind::setting}, k.key);
    v({"quantity", "-", "name of the quantity", Kind::setting}, k.quantity);
    v({"unit", "-", "unit of the numbers", Kind::setting}, k.unit);
    v({"grains", "as in unit", "value of the grains"}, k.grains);
    v({"continuum", "as in unit", "value of the continuum"}, k.continuum);
    v({"difference", "as in unit", "continuum minus grains"}, k.difference);
    v({"verdict", "-", verdict_meaning}, k.verdict);
  }

  inline std::array<NumberEntry, 12> summary_columns()
  {
    return {{{"quantity", "-", "name of the quantity"},
             {"unit", "-", "unit of the numbers"},
             {"grains", "as in unit", "value of the grains"},
             {"grains_low", "as in unit", "lower end of its 95 % interval; empty if there is none"},
             {"grains_high", "as in unit", "upper end"},
             {"continuum", "as in unit", "value of the continuum"},
             {"continuum_low", "as in unit", "lower end"},
             {"continuum_high", "as in unit", "upper end"},
             {"difference", "as in unit", "continuum minus grains"},
             {"difference_low", "as in unit", "lower end"},
             {"difference_high", "as in unit", "upper end"},
             {"verdict", "-", verdict_meaning}}};
  }

  // With the columns summary_columns(). The last row counts the checks; its verdict is count_of().
  std::string csv_of(const std::vector<KeyNumber> &numbers, const std::vector<Check> &checks);
  std::string text_of(const std::vector<KeyNumber> &numbers); // a table for a terminal, one line per quantity

  // A line with the mean sxx of both panels / pressure and what causes it; empty unless a pressure acts on the sides.
  std::string sxx_text_of(const Comparison &c, double pressure);

  // A line with the friction along the platens that the continuum took, and its fit to the grains of this run; empty unless
  // frictional.
  std::string platens_text_of(const PlatenFriction &grains, const continuum::Options &o);

  // Where the parameters of the continuum come from, for terminals and pages.
  std::string origin_of_law(const std::string &parameters_from);
} // namespace diptych::coupling
