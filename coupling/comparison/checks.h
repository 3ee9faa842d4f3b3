// diptych: the limits within which the numbers of a run are reliable
// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <string>
#include <vector>

#include "coupling/comparison/comparison.h"
#include "coupling/numbers/number_entry.h"

namespace diptych::coupling
{
  struct Check
  {
    std::string key; // place of its number in comparison.json
    std::string name;
    double      value = 0, limit = 0; // kept: |value| is at most the limit
    std::string reason;               // what a value beyond the limit means, and where that was measured

    bool kept() const { return value <= limit && value >= -limit; }
  };

  template <class Visitor> void list_numbers(const Check &c, Visitor &v)
  {
    v({"key", "-", "place of the checked number among these numbers", Kind::setting}, c.key);
    v({"name", "-", "name of the checked number", Kind::setting}, c.name);
    v({"value", "-", "value; for the coarse mesh: estimated error of the mesh, relative", Kind::setting}, c.value);
    v({"limit", "-", "largest magnitude at which the results are reliable", Kind::setting}, c.limit);
    v({"kept", "-", "true if the magnitude of the value is at most the limit", Kind::setting}, c.kept());
    v({"reason", "-", "meaning of a value beyond the limit", Kind::setting}, c.reason);
  }

  // Limits that the end of the grains' run uses, too. Errors are relative; `auto` keeps to discrete/accuracy.
  constexpr double most_penetration = 0.02; // mean diameters
  inline double    most_strength_error(const discrete::AccuracyOptions &o)
  {
    return 1.5 * o.accuracy;
  }
  inline double most_dilation_error(const discrete::AccuracyOptions &o)
  {
    return 2 * discrete::dilation_share * o.accuracy;
  }

  // The only list of checks; terminal, summary.csv, comparison.json and page show it. A number that is unknown has no check.
  std::vector<Check> checks_of(const discrete::Options &grains, const ComparisonOptions &options, const Comparison &c);

  std::string count_of_checks(std::size_t broken, std::size_t all); // "2 of 12 checks fail", "all 12 checks hold"
  std::string count_of(const std::vector<Check> &checks);
  std::string text_of(const std::vector<Check> &checks); // the same and a line per broken check, for a terminal
} // namespace diptych::coupling
