// diptych: settings of the continuum that a plan varies
// SPDX-License-Identifier: LGPL-2.1-or-later
#include "coupling/plans/continuum_knobs.h"

#include <algorithm>

#include "coupling/plans/plan_question.h"

namespace diptych::coupling
{
  Settings of_element_size(const double size)
  {
    return {planned("continuum", "element_size", size)};
  }

  Settings of_load_step(const double size)
  {
    return {planned("continuum", "max_step", size), planned("continuum", "initial_step", std::min(size, 0.001))};
  }

  void append(Settings &to, const Settings &more)
  {
    to.insert(to.end(), more.begin(), more.end());
  }

  const char *without_length(const continuum::LawKind law)
  {
    return law == continuum::LawKind::cosserat_mohr_coulomb ? "mohr_coulomb" : "drucker_prager";
  }

  std::optional<std::string> with_length(const continuum::LawKind law)
  {
    if (law == continuum::LawKind::mohr_coulomb)
      return "cosserat_mohr_coulomb";
    if (law == continuum::LawKind::drucker_prager)
      return "cosserat_drucker_prager";
    return std::nullopt;
  }
} // namespace diptych::coupling
