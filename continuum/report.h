// diptych: report of the continuum panel on its run
// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <optional>
#include <string>
#include <type_traits>

namespace diptych::continuum
{
  enum class Status
  {
    finished,
    stopped_by_user,
    not_converged
  };

  struct Report
  {
    Status                status       = Status::finished;
    double                progress     = 0;                   // loading variable reached
    double                axial_strain = 0, shear_strain = 0; // reached
    std::string           message;                            // empty when finished
    int                   n_cells = 0, n_unknowns = 0;
    int                   steps = 0, cut_backs = 0, newton_iterations = 0;
    int                   processes = 1;
    std::optional<double> localisation_progress; // at the first negative determinant of the acoustic tensor
    std::optional<double> localisation_angle;    // of the band that could form there [degrees from the horizontal]
    bool                  finished = false;      // the program says so when the panel has ended
  };

  // Calls visit(name, value, unit, meaning) for every entry of `continuum` in provenance.json. The only list of these entries.
  template <class AnyReport, class Visit, std::enable_if_t<std::is_same_v<std::remove_const_t<AnyReport>, Report>, int> = 0>
  void visit_facts(AnyReport &r, Visit &&visit)
  {
    visit("cells", r.n_cells, "-", "cells");
    visit("unknowns", r.n_unknowns, "-", "unknowns");
    visit("steps", r.steps, "-", "steps");
    visit("processes", r.processes, "-", "processes");
    visit("localisation_strain", r.localisation_progress, "strain or time",
          "progress at which localisation is first possible (singular acoustic tensor)");
    visit("localisation_angle_deg", r.localisation_angle, "degrees", "angle of the band that could form at that point");
    visit("finished", r.finished, "-", "ran to its end");
    visit("reached_progress", r.progress, "strain or time", "progress reached");
    visit("reached_axial_strain", r.axial_strain, "-", "axial strain reached");
    visit("reached_shear_strain", r.shear_strain, "-", "shear strain reached");
    visit("message", r.message, "-", "message");
  }
} // namespace diptych::continuum
