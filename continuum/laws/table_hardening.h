// diptych: hardening = table: strength from lists
// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <array>
#include <vector>

#include "continuum/laws/strength.h"

namespace diptych::continuum
{
  struct TableOptions
  {
    std::vector<double> table_strain;          // values of the hardening variable [-]
    std::vector<double> table_friction_angle;  // [degrees]
    std::vector<double> table_dilatancy_angle; // [degrees]
    std::vector<double> table_cohesion;        // [Units::stress]

    // Without a move: LawOptions shares its bases, and a second move of one would empty the lists.
    TableOptions()                                = default;
    TableOptions(const TableOptions &)            = default;
    TableOptions &operator=(const TableOptions &) = default;
  };

  template <class Visitor> void visit_parameters(TableOptions &o, Visitor &&visitor)
  {
    visitor("table_strain", o.table_strain, "-", {0., 1e6}, "hardening = table: equivalent plastic strains, ascending from 0");
    visitor("table_friction_angle", o.table_friction_angle, "degrees", {0., 60.},
            "hardening = table: friction angles at table_strain");
    visitor("table_dilatancy_angle", o.table_dilatancy_angle, "degrees", {0., 60.},
            "hardening = table: dilatancy angles at table_strain, never above friction");
    visitor("table_cohesion", o.table_cohesion, "loading/pressure", {0., 1e12}, "hardening = table: cohesion at table_strain");
  }

  // Linear between the points and constant beyond them. At a point the rate is that of the following interval. Members as in
  // ConstantHardening. A local law needs no parts: the whole table counts as falling.
  struct TableHardening
  {
    using Options                         = TableOptions;
    static constexpr const char name[]    = "table";
    static constexpr const char meaning[] = "the four lists, linear between their points and constant beyond them";
    static constexpr std::array keys      = {"table_strain", "table_friction_angle", "table_dilatancy_angle", "table_cohesion"};

    static void check(const TableOptions &o);
    TableHardening(const TableOptions &o, bool is_nonlocal);

    Strength falling(double kappa) const;
    Strength rising(double kappa) const;

    std::vector<double>        strain;
    std::vector<StrengthPoint> falls, rises; // at `strain`; rises: from 0, empty for a local law
  };
} // namespace diptych::continuum
