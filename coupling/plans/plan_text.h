// diptych: the report of a plan as text
// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <string>

#include "coupling/plans/plan.h"

namespace diptych::coupling
{
  std::string percent(double share);  // "1.2 %"
  std::string rounded(double number); // with three digits
  std::string to_four_digits(double number);
  double      rounded_to_two_digits(double number);

  // Findings, error budget and cost of every panel, for the terminal.
  std::string text_of(const Plan &plan);
} // namespace diptych::coupling
