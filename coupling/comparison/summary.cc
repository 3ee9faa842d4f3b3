// diptych: counts, extremes and costs of a whole run
// SPDX-License-Identifier: LGPL-2.1-or-later
#include "coupling/comparison/summary.h"

#include <algorithm>
#include <cmath>

namespace diptych::coupling
{
  namespace
  {
    double largest(const std::vector<double> &values)
    {
      double result = 0;
      for (const double value : values)
        result = std::max(result, std::abs(value));
      return result;
    }

    double sum_of(const std::vector<double> &values)
    {
      double sum = 0;
      for (const double value : values)
        sum += value;
      return sum;
    }

    // The initial stress is isotropic, so it is meaningless there which principal stress is the intermediate one.
    std::vector<double> loaded(const HistoryTable &history, const std::string &name)
    {
      const std::vector<double> &values = column(history, name);
      return {values.begin() + (column(history, "progress").front() == 0 ? 1 : 0), values.end()};
    }

    // Over the range of the later strength. NaN along time and without dissipation.
    double impact_share(const discrete::LoadingMode mode, const HistoryTable &h)
    {
      const std::vector<double> &progress = column(h, "progress");
      if (mode == discrete::LoadingMode::time || !is_beyond(progress.back(), early_strain))
        return NAN;
      const auto   first   = std::upper_bound(progress.begin(), progress.end(), early_strain) - progress.begin();
      const auto   growth  = [&](const char *name) { return column(h, name).back() - column(h, name)[std::size_t(first)]; };
      const double impacts = growth("impact_dissipation"),
                   sum     = impacts + growth("friction_dissipation") + growth("rolling_dissipation");
      return sum > 0 ? impacts / sum : NAN;
    }

    double platen_unbalance(const HistoryTable &history)
    {
      const double lower = column(history, "lower_fy").back(), upper = column(history, "upper_fy").back();
      const double size = (std::abs(lower) + std::abs(upper)) / 2;
      return size > 0 ? std::abs(lower + upper) / size : NAN;
    }
  } // namespace

  PanelNumbers panel_numbers(const Scene &scene, const HistoryTable &h)
  {
    const QuantityBasis basis = basis_of(scene);
    PanelNumbers        numbers;
    numbers.compared       = panel_values(basis, h);
    numbers.peak           = peak_of_running_mean(h, "stress_ratio", basis.averaging_width);
    numbers.early_strength = early_strength(basis, h);
    const double end       = column(h, "progress").back();
    if (std::isnan(basis.side_pressure) || !is_beyond(end, early_strain))
      return numbers;
    const auto mean     = [&](const char *name) { return mean_over_progress(h, name, early_strain, end); };
    numbers.mean_sxx    = mean("sxx");
    numbers.platens_sxx = mean("platen_sxx");
    numbers.sides_sxx   = h.count("side_sxx") ? mean("side_sxx") : numbers.mean_sxx - numbers.platens_sxx; // equilibrium
    return numbers;
  }

  DiscreteSummary summary_of(const Scene              &scene,
                             const DiscreteResults    &results,
                             const discrete::Snapshot &last,
                             const HistoryTable       &h)
  {
    DiscreteSummary s;
    s.grains                       = int(last.position.size());
    s.steps                        = int(results.rows.size());
    s.sweeps                       = sum_of(column(h, "sweeps"));
    s.step_length                  = last.step;
    s.max_penetration              = largest(column(h, "max_penetration"));
    s.mean_inertial_number         = sum_of(column(h, "inertial_number")) / double(results.rows.size());
    s.energy_residual              = largest(column(h, "energy_residual"));
    s.impact_share                 = impact_share(scene.loading.mode, h);
    s.momentum_residual            = largest(column(h, "momentum_residual"));
    s.residual                     = largest(column(h, "residual"));
    s.numbers                      = panel_numbers(scene, h);
    s.spin_term_share              = largest(column(h, "spin_term_share"));
    s.kinetic_energy_ratio_median  = median(column(h, "kinetic_energy_ratio"));
    s.kinetic_energy_ratio_largest = largest(column(h, "kinetic_energy_ratio"));
    s.contacts                     = column(h, "contacts").back();
    s.coordination_number          = 2 * s.contacts / double(last.position.size());
    s.rattlers                     = column(h, "rattlers").back();
    s.balance                      = platen_balance(h);
    s.facts                        = results.facts;

    const double unit_of_time = scene.sample.mean_diameter * std::sqrt(scene.sample.density / scene.loading.pressure);
    if (s.mean_inertial_number != 0)
      s.solver_noise = s.residual * s.step_length / unit_of_time / s.mean_inertial_number;
    s.grain_stress_error = s.facts.error_over_residual * s.residual;
    return s;
  }

  ContinuumSummary summary_of(const Scene &scene, const ContinuumResults &results, const HistoryTable &h)
  {
    ContinuumSummary s;
    s.element_size                  = scene.continuum.element_size;
    s.newton_iterations             = column(h, "newton_iterations").back();
    s.cut_backs                     = column(h, "cut_backs").back();
    s.numbers                       = panel_numbers(scene, h);
    s.share_zz_not_intermediate     = largest(loaded(h, "share_zz_not_intermediate"));
    s.unstable_share                = largest(column(h, "unstable_share"));
    s.viscous_share                 = largest(column(h, "viscous_share"));
    s.max_equivalent_plastic_strain = column(h, "max_equivalent_plastic_strain").back();
    s.platen_unbalance              = platen_unbalance(h);
    s.law                           = discrete::name_of(scene.continuum.law);
    if (continuum::traits(scene.continuum.law).has_length())
      s.internal_length = scene.continuum.material.internal_length;
    s.parameters_from = scene.comparison.parameters_from;
    s.facts           = results.facts;
    return s;
  }

  CostSummary summary_of(const std::vector<PhaseCost> &phases)
  {
    CostSummary cost;
    for (const PhaseCost &phase : phases)
      {
        for (auto &[name, seconds] : {std::pair{"preparation", &cost.preparation_cpu_s},
                                      {"discrete", &cost.discrete_cpu_s},
                                      {"continuum", &cost.continuum_cpu_s},
                                      {"comparison", &cost.comparison_cpu_s}})
          if (phase.name == name)
            *seconds = phase.cpu_s;
        cost.peak_memory_mb = std::max(cost.peak_memory_mb, phase.peak_memory_mb);
      }
    return cost;
  }
} // namespace diptych::coupling
