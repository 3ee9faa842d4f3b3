// diptych: what acts on the free lateral boundary of the grain sample
// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <string>

#include "discrete/state.h"

namespace diptych::discrete
{
  struct LateralOptions
  {
    std::string lateral     = "end_grains";
    double      band_height = 3;
    int         end_grains  = 5;
  };

  template <class Visitor> void visit_parameters(LateralOptions &o, Visitor &&visitor)
  {
    visitor("lateral", o.lateral, "-", {"end_grains", "none"},
            "containing action on the free sides: the end grains of horizontal bands carry the pressure, or nothing does");
    visitor("band_height", o.band_height, "mean diameters", {0.5, 100.},
            "height w of a band; 1 to 5 are equivalent, from 8 on five grains are a poor barrier");
    visitor("end_grains", o.end_grains, "-", {1, 100}, "grains at each end of a band that share the force w P");
  }

  // Moreau's containing action (1997, section 3): the height between the platens walls[0] and walls[1] is divided into
  // equal bands (band_height rounded so that they fit); in each, the `end_grains` outermost grains on the left carry, in
  // proportion to their masses, horizontal forces that total (height of the band) x pressure, those on the right the
  // opposite. A band with fewer than twice as many grains splits them between its sides; grains belong to the band of
  // their centre, those beyond a platen's overhang included. Adds to `force` (one entry per grain) [pressure x length].
  // `band_height` is in mean diameters.
  void add_lateral_forces(const State                  &state,
                          const LateralOptions         &options,
                          double                        pressure,
                          double                        mean_diameter,
                          std::vector<Eigen::Vector2d> &force);
} // namespace diptych::discrete
