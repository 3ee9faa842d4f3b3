// diptych: the one list of the numbers of a comparison
// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <string>
#include <vector>

#include "coupling/comparison/comparison.h"
#include "coupling/comparison/stage_numbers.h"
#include "coupling/numbers/number_entry.h"

namespace diptych::coupling
{
  // Of the coarse run: the continuum alone.
  struct CoarseWindow
  {
    double            from = 0, to = 0;
    std::vector<Band> bands;
  };
  template <class Visitor> void list_numbers(const CoarseWindow &w, Visitor &v)
  {
    v({"from", "as walk says", "progress at the beginning", Kind::setting}, w.from);
    v({"to", "as walk says", "progress at the end", Kind::setting}, w.to);
    v.list("bands", "shear bands, the strongest first", w.bands);
  }

  template <class Visitor> void list_numbers(const CoarseRun &c, Visitor &v)
  {
    std::vector<CoarseWindow> windows;
    for (const Increment &window : c.windows)
      windows.push_back({window.from, window.to, window.continuum.band.bands});
    v({"element_size_d", "mean diameters", "element size"}, c.element_size);
    v({"peak_stress_ratio", "-", "peak stress ratio t/s, of the running mean"}, c.peak.value);
    v.list("windows", "windows of the loading", windows);
  }

  template <class Visitor> void list_numbers(const PointStress &p, Visitor &v)
  {
    v({"name", "-", "of the point", Kind::setting}, p.name);
    v({"s", "pressure", "mean stress s"}, p.s);
    v({"t_over_s", "-", "stress ratio t/s"}, p.t_over_s);
  }

  namespace numbers
  {
    template <class Visitor> void list_row(const char *key, const char *meaning, const ResolutionRow &r, Visitor &v)
    {
      v({key, "mean diameters", meaning, Kind::setting}, r.width);
      v.list("points", "stress at points", r.points);
      v({"scatter_s", "-", "scatter of s over the sample, relative to its mean"}, r.scatter_s);
      v({"scatter_t", "-", "scatter of t over the sample, relative to its mean"}, r.scatter_t);
    }

    template <class Row> std::vector<Row> rows_as(const std::vector<ResolutionRow> &rows)
    {
      std::vector<Row> result;
      for (const ResolutionRow &row : rows)
        result.push_back(Row{row});
      return result;
    }
  } // namespace numbers

  struct KernelRow : ResolutionRow
  {};
  template <class Visitor> void list_numbers(const KernelRow &r, Visitor &v)
  {
    numbers::list_row("width_d", "standard deviation of the kernel", r, v);
  }
  struct CellRow : ResolutionRow
  {};
  template <class Visitor> void list_numbers(const CellRow &r, Visitor &v)
  {
    numbers::list_row("size_d", "size of the cells", r, v);
  }

  template <class Visitor> void list_numbers(const ResolutionStudy &s, Visitor &v)
  {
    v.list("kernel", "stress smoothed by a kernel", numbers::rows_as<KernelRow>(s.kernel));
    v.list("cells", "stress of square cells", numbers::rows_as<CellRow>(s.cells));
    v({"plateau_d", "mean diameters", "widths between which the values at points do not depend on it"}, s.plateau);
    v({"verdict", "-", "what the study says"}, s.verdict);
  }

  template <class Visitor> void list_numbers(const TheoryLines &t, Visitor &v)
  {
    v({"coulomb_deg", "degrees", "45° + φ/2"}, t.coulomb_deg);
    v({"roscoe_deg", "degrees", "45° + ψ/2"}, t.roscoe_deg);
    v({"arthur_deg", "degrees", "45° + (φ + ψ)/4"}, t.arthur_deg);
  }

  template <class Visitor> void list_numbers(const DiscreteSummary &s, Visitor &v)
  {
    v({"grains", "-", "grains"}, s.grains);
    v({"steps", "-", "steps"}, s.steps);
    v({"sweeps", "-", "solver sweeps in all"}, s.sweeps);
    v({"step_length", "time", "step length"}, s.step_length);
    v({"max_penetration_d", "mean diameters", "largest penetration"}, s.max_penetration);
    v({"mean_inertial_number", "-", "mean inertial number"}, s.mean_inertial_number);
    v({"energy_residual", "-", "energy residual, relative"}, s.energy_residual);
    v({"momentum_residual", "-", "momentum residual"}, s.momentum_residual);
    v({"residual", "-", "largest contact residual (natural map, relative)"}, s.residual);
    v({"solver_noise", "-", "residual × step / inertial number"}, s.solver_noise);
    v({"grain_stress_error", "-", "error of single grains' stress"}, s.grain_stress_error);
    v({"peak_stress_ratio", "-", "peak stress ratio t/s, of the running mean"}, s.peak.value);
    v({"strain_at_peak", "as walk says", "progress at the peak"}, s.peak.progress);
    v({"early_strength", "-", "T/S up to 0.3 % of strain, means of t over means of s"}, s.strength.early);
    v({"strength", "-", "T/S from there to the end"}, s.strength.later);
    v({"final_volumetric_strain", "-", "volumetric strain at the end"}, s.final_volumetric_strain);
    v({"spin_term_share", "-", "largest spin term over mean stress"}, s.spin_term_share);
    v({"kinetic_energy_ratio_median", "-", "kinetic energy over M|V|²/4, median"}, s.kinetic_energy_ratio_median);
    v({"kinetic_energy_ratio_largest", "-", "kinetic energy over M|V|²/4, largest"}, s.kinetic_energy_ratio_largest);
    v({"contacts", "-", "contacts at the end"}, s.contacts);
    v({"coordination_number", "-", "coordination number"}, s.coordination_number);
    v({"rattlers", "-", "grains without contact force"}, s.rattlers);
    v({"platen_difference_share_below_1_percent", "-", "share of steps with platen forces equal within 1 %"},
      s.balance.share_below_1_percent);
    v({"platen_difference_mean", "-", "mean difference of the platen forces"}, s.balance.mean);
    v({"platen_difference_largest", "-", "largest difference of the platen forces"}, s.balance.largest);
    list_numbers(s.facts, v);
  }

  template <class Visitor> void list_numbers(const ContinuumSummary &s, Visitor &v)
  {
    v({"element_size_d", "mean diameters", "element size"}, s.element_size);
    v({"newton_iterations", "-", "Newton iterations"}, s.newton_iterations);
    v({"cut_backs", "-", "load steps cut back"}, s.cut_backs);
    v({"peak_stress_ratio", "-", "peak stress ratio t/s, of the running mean"}, s.peak.value);
    v({"strain_at_peak", "as walk says", "progress at the peak"}, s.peak.progress);
    v({"early_strength", "-", "T/S up to 0.3 % of strain, means of t over means of s"}, s.strength.early);
    v({"strength", "-", "T/S from there to the end"}, s.strength.later);
    v({"final_volumetric_strain", "-", "volumetric strain at the end"}, s.final_volumetric_strain);
    v({"share_zz_not_intermediate", "-", "points where σ_zz is not intermediate"}, s.share_zz_not_intermediate);
    v({"viscous_share", "-", "largest share of the strength that viscosity carries"}, s.viscous_share);
    v({"unstable_share", "-", "largest share of the area that weakens in a step while its plastic flow contracts"},
      s.unstable_share);
    v({"max_equivalent_plastic_strain", "-", "largest equivalent plastic strain"}, s.max_equivalent_plastic_strain);
    v({"platen_unbalance", "-", "platen forces out of balance, at the end"}, s.platen_unbalance);
    v({"law", "-", "constitutive law", Kind::setting}, s.law);
    v({"internal_length_d", "mean diameters", "internal length of the law"}, s.internal_length);
    v({"parameters_from", "-", "where the parameters come from", Kind::setting}, s.parameters_from);
    list_numbers(s.facts, v);
  }

  template <class Visitor> void list_numbers(const CostSummary &c, Visitor &v)
  {
    v({"preparation_cpu_s", "s", "preparation of the grains", Kind::clock}, c.preparation_cpu_s);
    v({"discrete_cpu_s", "s", "grains, loading", Kind::clock}, c.discrete_cpu_s);
    v({"continuum_cpu_s", "s", "continuum", Kind::clock}, c.continuum_cpu_s);
    v({"comparison_cpu_s", "s", "homogenisation and comparison", Kind::clock}, c.comparison_cpu_s);
    v({"peak_memory_mb", "MB", "peak memory", Kind::clock}, c.peak_memory_mb);
  }

  // comparison.json as a whole.
  struct ComparisonDocument
  {
    const Scene      &scene;
    const Comparison &comparison;
  };
  template <class Visitor> void list_numbers(const ComparisonDocument &d, Visitor &v)
  {
    const Comparison &c = d.comparison;
    v({"format", "-", "of this file", Kind::setting}, 2);
    v({"scene", "-", "name of the scene", Kind::setting}, d.scene.name);
    v({"seed", "-", "of the sample", Kind::setting}, d.scene.sample.seed);
    v({"walk", "-", "what progress is: axial_strain, shear_strain or time", Kind::setting},
      discrete::name_of(discrete::walk_of(d.scene.loading.mode)));
    v({"mean_diameter", "length", "mean diameter d of the grains", Kind::setting}, d.scene.sample.mean_diameter);
    v({"pressure", "pressure", "P of the lateral action", Kind::setting}, d.scene.loading.pressure);
    v({"averaging_width", "as walk says", "of the running means", Kind::setting}, averaging_width(d.scene));
    v.list("stages", "instants at which both panels are compared", c.stages);
    v.list("windows", "windows over which displacement increments are compared", c.windows);
    v.group("continuum_coarse", "the continuum on the coarse mesh", c.coarse);
    v.group("discrete_summary", "the grains' run as a whole", c.discrete);
    v.group("continuum_summary", "the continuum's run as a whole", c.continuum);
    v.group("cost", "CPU time and memory", c.cost);
    v.group("resolution_study", "the grains' stress against the length it is averaged over", c.resolution);
    v.group("theory", "inclinations that theories expect, to the minor principal stress", c.theory);
  }
} // namespace diptych::coupling
