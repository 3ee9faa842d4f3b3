// diptych: report of the preparation and loading of a sample
// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <limits>
#include <string>
#include <type_traits>

#include "discrete/meaning.h"
#include "discrete/samples/sample_preparation.h"
#include "discrete/stepping/grain_stress_error.h"
#include "discrete/stepping/step_rule.h"

namespace diptych::discrete
{
  enum class Status
  {
    finished,
    stopped_by_user,
    not_converged
  };

  struct Report
  {
    Status            status       = Status::finished;
    double            progress     = 0;                   // reached value of the loading variable
    double            axial_strain = 0, shear_strain = 0; // reached
    std::string       message;                            // empty if finished
    PreparationReport preparation;
    double            step = 0;                                             // of the last stage
    std::string       step_bound;                                           // step = auto: the bound that gave the step
    double            tolerance = std::numeric_limits<double>::quiet_NaN(); // of the last stage
    ExpectedErrors    expected;                                             // due to step and tolerance; largest of all stages
    double            expected_dilation_error = 0;
    long              steps = 0, sweeps = 0, updates = 0; // of the loading; one update = one contact in one sweep
    double            preparation_cpu_s = 0, preparation_wall_s = 0, loading_cpu_s = 0, solver_cpu_s = 0;
    double            ns_per_update = 0, solver_share_of_cpu = 0; // of the loading
    double            initial_height = 0, platen_speed = 0;       // speed: strain rate x height

    // (Error of the grain stress) / residual, measured at one step per run against a more accurate solution of this step.
    double error_over_residual = std::numeric_limits<double>::quiet_NaN();
    double reference_residual  = error_over_residual; // residual of the more accurate solution
    double reference_error     = error_over_residual; // error measured against it
    double estimated_error     = error_over_residual; // estimate of the same error

    int snapshots_sampled = 0, snapshots_accurate = 0;
    int halved_steps = 0; // because the sweeps stalled

    // The program adds these when the panel has ended.
    bool        finished              = false;
    int         kinetic_energy_bursts = 0;
    std::string warnings; // one per line
  };

  // Calls visit(name, value, unit, meaning) for every entry of `discrete` in provenance.json. The only list of these entries.
  template <class AnyReport, class Visit, std::enable_if_t<std::is_same_v<std::remove_const_t<AnyReport>, Report>, int> = 0>
  void visit_facts(AnyReport &r, Visit &&visit)
  {
    visit("preparation_solid_fraction", r.preparation.solid_fraction, "-", "solid fraction as prepared");
    visit("preparation_friction", r.preparation.friction, "-", "friction of the preparation");
    visit("preparation_steps", r.preparation.steps, "-", "steps of the preparation");
    visit("preparation_residual", r.preparation.residual, "-", "residual at the end of the preparation");
    visit("preparation_unbalanced_force", r.preparation.unbalanced_force, "-", "unbalanced force after the preparation");
    visit("preparation_settling_steps", r.preparation.settling_steps, "-",
          "steps after the compaction, from rest, that removed the overlaps");
    visit("preparation_largest_overlap", r.preparation.largest_overlap, "mean diameters",
          "largest overlap of the sample when its loading began");
    visit("initial_height", r.initial_height, "length", "initial height");
    visit("platen_speed", r.platen_speed, "length/time", "platen speed");
    visit("step", r.step, "time", "step of the last stage");
    visit("step_bound", r.step_bound, "-", "bound that gave the step, if it was chosen automatically");
    visit("tolerance", r.tolerance, "-", "residual at which the steps of the last stage ended");
    visit("expected_strength_error", r.expected.strength, "-",
          "relative error of the strength expected for this step and strain rate");
    visit("expected_dilation_error", r.expected_dilation_error, "-",
          "relative error of the dilation expected: what the step adds, less what the tolerance takes");
    visit("halved_steps", r.halved_steps, "-", "steps halved because the sweeps stalled");
    visit("kinetic_energy_bursts", r.kinetic_energy_bursts, "-", "times the kinetic energy rose above twice M|V|²/4");
    visit("ns_per_update", r.ns_per_update, "ns", Meaning::of_clock("time of one contact update"));
    visit("solver_share_of_cpu", r.solver_share_of_cpu, "-", Meaning::of_clock("contact solver's share of the CPU time"));
    visit("residual_factor", r.error_over_residual, "-", "grain-stress error over residual");
    visit("residual_factor_reference_residual", r.reference_residual, "-",
          "residual of the more accurate solve used for that measurement");
    visit("residual_factor_error", r.reference_error, "-", "error of the grain stress, measured in that solve");
    visit("residual_factor_estimate", r.estimated_error, "-", "error of the grain stress, estimated in that solve");
    visit("snapshots_sampled", r.snapshots_sampled, "-", "snapshots whose grain stress was estimated");
    visit("snapshots_accurate", r.snapshots_accurate, "-", "snapshots that reached the demanded accuracy");
    visit("finished", r.finished, "-", "ran to its end");
    visit("reached_progress", r.progress, "strain or time", "progress reached");
    visit("reached_axial_strain", r.axial_strain, "-", "axial strain reached");
    visit("reached_shear_strain", r.shear_strain, "-", "shear strain reached");
    visit("message", r.message, "-", "message");
    visit("warnings", r.warnings, "-", "reasons to doubt the result, one per line");
  }

  void note(Report &report, const SampledAccuracy &accuracy);
  void note(Report &report, const ExpectedErrors &errors); // keeps the largest of all stages
  void note_costs(Report &report);                         // from CPU times and updates
} // namespace diptych::discrete
