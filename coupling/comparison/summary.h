// diptych: counts, extremes and costs of a whole run
// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "coupling/comparison/key_quantities.h"
#include "coupling/comparison/platen_balance.h"
#include "coupling/probes/platen_slip.h"
#include "coupling/scene/scene.h"
#include "coupling/statistics/history_table.h"
#include "coupling/store/results.h"

namespace diptych::coupling
{
  struct PanelNumbers
  {
    PanelValues compared;
    Peak        peak; // of the running mean of t/s
    double      early_strength = NAN;
    double      mean_sxx = NAN, sides_sxx = NAN, platens_sxx = NAN; // [pressure]; NaN unless a pressure acts on the sides
  };
  PanelNumbers panel_numbers(const Scene &scene, const HistoryTable &history);

  struct DiscreteSummary
  {
    int              grains = 0, steps = 0;
    double           sweeps = 0, step_length = NAN; // [-], [time]
    double           max_penetration      = NAN;    // [mean diameters]
    double           mean_inertial_number = NAN;
    double           impact_share         = NAN; // of the dissipation from 0.3 % strain on
    double           energy_residual = NAN, momentum_residual = NAN, residual = NAN;
    double           solver_noise       = NAN; // residual x step [d sqrt(rho/P)] / mean inertial number
    double           grain_stress_error = NAN; // error / residual x residual; NaN if it was not measured
    PanelNumbers     numbers;
    double           spin_term_share             = NAN;
    double           kinetic_energy_ratio_median = NAN, kinetic_energy_ratio_largest = NAN;
    double           contacts = NAN, coordination_number = NAN, rattlers = NAN; // at the end
    PlatenBalance    balance;
    PlatenFriction   platens; // lengths in mean diameters; NaN along time
    discrete::Report facts;
  };

  struct ContinuumSummary
  {
    double                element_size      = NAN; // [mean diameters]
    double                newton_iterations = NAN, cut_backs = NAN;
    PanelNumbers          numbers;
    double                share_zz_not_intermediate = NAN, viscous_share = NAN, unstable_share = NAN;
    double                max_equivalent_plastic_strain = NAN;
    double                platen_unbalance = NAN; // sum of the vertical forces at the end, relative to their mean size
    std::string           law;
    std::optional<double> internal_length; // [mean diameters]; empty: the law has none, and the mesh sets the width of its band
    std::string           parameters_from;
    continuum::Report     facts;
  };

  // CPU seconds of phases; empty if the phase did not run.
  struct CostSummary
  {
    std::optional<double> preparation_cpu_s, discrete_cpu_s, continuum_cpu_s, comparison_cpu_s;
    double                peak_memory_mb = 0;
  };

  // `history`: the table of the rows; `last`: the last instant that is compared.
  DiscreteSummary  summary_of(const Scene              &scene,
                              const DiscreteResults    &results,
                              const discrete::Snapshot &last,
                              const HistoryTable       &history);
  ContinuumSummary summary_of(const Scene &scene, const ContinuumResults &results, const HistoryTable &history);
  CostSummary      summary_of(const std::vector<PhaseCost> &phases);
} // namespace diptych::coupling
