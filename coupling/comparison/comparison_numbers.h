// diptych: the only list of the numbers of a comparison
// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <vector>

#include "coupling/comparison/checks.h"
#include "coupling/comparison/comparison.h"
#include "coupling/comparison/key_numbers.h"
#include "coupling/comparison/stage_numbers.h"
#include "coupling/numbers/number_entry.h"

namespace diptych::coupling
{
  // A window of the coarse run, which has the continuum only.
  struct CoarseWindow
  {
    double            from = 0, to = 0;
    std::vector<Band> bands;
  };
  template <class Visitor> void list_numbers(const CoarseWindow &w, Visitor &v)
  {
    v({"from", "strain or time", "progress at the beginning of the window", Kind::setting}, w.from);
    v({"to", "strain or time", "progress at the end of the window", Kind::setting}, w.to);
    v.list("bands", "shear bands of the continuum on the coarse mesh, the strongest first", w.bands);
  }

  template <class Visitor> void list_numbers(const CoarseRun &c, Visitor &v)
  {
    std::vector<CoarseWindow> windows;
    for (const Increment &window : c.windows)
      windows.push_back({window.from, window.to, window.continuum.band.bands});
    v({"element_size_d", "mean diameters", "element size of the coarse mesh"}, c.element_size);
    v({"peak_stress_ratio", "-", "largest running mean of the stress ratio t/s"}, c.peak.value);
    v.list("windows", "windows over which the bands of the coarse run are taken", windows);
  }

  template <class Visitor> void list_numbers(const PointStress &p, Visitor &v)
  {
    v({"name", "-", "name of the point", Kind::setting}, p.name);
    v({"s", "pressure", "mean stress s = (s_1 + s_2)/2 at the point, positive in compression"}, p.s);
    v({"t_over_s", "-", "stress ratio t/s at the point"}, p.t_over_s);
  }

  namespace numbers
  {
    template <class Visitor> void list_row(const char *key, const char *meaning, const ResolutionRow &r, Visitor &v)
    {
      v({key, "mean diameters", meaning, Kind::setting}, r.width);
      v.list("points", "stress at each point for this averaging width", r.points);
      v({"scatter_s", "-", "standard deviation of s over the covered cells, relative to the mean of s"}, r.scatter_s);
      v({"scatter_t", "-", "standard deviation of t over the covered cells, relative to the mean of t"}, r.scatter_t);
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
    numbers::list_row("size_d", "side of the square cells", r, v);
  }

  template <class Visitor> void list_numbers(const ResolutionStudy &s, Visitor &v)
  {
    v.list("kernel", "stress smoothed by a kernel, one entry for each width", numbers::rows_as<KernelRow>(s.kernel));
    v.list("cells", "stress averaged over square cells, one entry for each size", numbers::rows_as<CellRow>(s.cells));
    v({"plateau_d", "mean diameters",
       "smallest and largest kernel width between which the stress at points does not depend on the width"},
      s.plateau);
    v({"verdict", "-", "conclusion of the resolution study"}, s.verdict);
  }

  template <class Visitor> void list_numbers(const TheoryLines &t, Visitor &v)
  {
    v({"coulomb_deg", "degrees", "inclination to the minor principal stress after Coulomb, 45° + φ/2"}, t.coulomb_deg);
    v({"roscoe_deg", "degrees", "inclination to the minor principal stress after Roscoe, 45° + ψ/2"}, t.roscoe_deg);
    v({"arthur_deg", "degrees", "inclination to the minor principal stress after Arthur, 45° + (φ + ψ)/4"}, t.arthur_deg);
  }

  template <class Visitor> void list_numbers(const PanelNumbers &n, Visitor &v)
  {
    for (const KeyQuantity &q : key_quantities)
      if (q.of_panel)
        v({q.key, q.unit, q.meaning}, value_of(n.compared, q));
    v({"strain_at_peak", "strain or time", "progress at the peak of the stress ratio"}, n.peak.progress);
    v({"early_strength", "-", "strength T/S up to 0.3 % strain: mean of t over mean of s"}, n.early_strength);
    v({"mean_sxx", "pressure", "mean of sxx from 0.3 % strain to the end"}, n.mean_sxx);
    v({"sides_sxx", "pressure", "part of it that the forces on the sides cause"}, n.sides_sxx);
    v({"platens_sxx", "pressure", "part of it that the platens cause; accelerations and spin of grains cause the rest"},
      n.platens_sxx);
  }

  template <class Visitor> void list_numbers(const DiscreteSummary &s, Visitor &v)
  {
    v({"grains", "-", "number of grains"}, s.grains);
    v({"steps", "-", "number of steps"}, s.steps);
    v({"sweeps", "-", "total number of solver sweeps"}, s.sweeps);
    v({"step_length", "time", "length of the step"}, s.step_length);
    v({"max_penetration_d", "mean diameters", "largest penetration of two grains"}, s.max_penetration);
    v({"mean_inertial_number", "-", "mean inertial number"}, s.mean_inertial_number);
    v({"impact_share", "-", "share of impacts in the dissipation from 0.3 % strain on"}, s.impact_share);
    v({"energy_residual", "-", "relative residual of the energy balance"}, s.energy_residual);
    v({"momentum_residual", "-", "relative residual of the momentum balance"}, s.momentum_residual);
    v({"residual", "-", "largest contact residual (natural map, relative)"}, s.residual);
    v({"solver_noise", "-", "solver noise: contact residual × step / mean inertial number"}, s.solver_noise);
    v({"grain_stress_error", "-", "error of the stress of single grains"}, s.grain_stress_error);
    list_numbers(s.numbers, v);
    v({"spin_term_share", "-", "largest ratio of spin term to mean stress"}, s.spin_term_share);
    v({"kinetic_energy_ratio_median", "-", "median of kinetic energy / (M|V|²/4)"}, s.kinetic_energy_ratio_median);
    v({"kinetic_energy_ratio_largest", "-", "largest value of kinetic energy / (M|V|²/4)"}, s.kinetic_energy_ratio_largest);
    v({"contacts", "-", "number of contacts at the end"}, s.contacts);
    v({"coordination_number", "-", "coordination number at the end"}, s.coordination_number);
    v({"rattlers", "-", "number of grains without contact force at the end"}, s.rattlers);
    v({"platen_difference_share_below_1_percent", "-", "share of steps in which the platen forces agree within 1 %"},
      s.balance.share_below_1_percent);
    v({"platen_difference_mean", "-", "mean difference of the platen forces, relative to their mean size, with sign"},
      s.balance.mean);
    v({"platen_difference_largest", "-", "largest difference of the platen forces, relative to their mean size"},
      s.balance.largest);
    v({"platen_friction", "-",
       "largest ratio of shear to normal stress along a platen, fitted to traction and slip; the interval is that of this "
       "sample"},
      s.platens.friction);
    v({"platen_slip_length_d", "mean diameters", "slip length of that fit (continuum/platen_slip_length)"},
      s.platens.slip_length);
    list_numbers(s.facts, v);
  }

  template <class Visitor> void list_numbers(const ContinuumSummary &s, Visitor &v)
  {
    v({"element_size_d", "mean diameters", "element size"}, s.element_size);
    v({"newton_iterations", "-", "total number of Newton iterations"}, s.newton_iterations);
    v({"cut_backs", "-", "number of load steps that were repeated with a smaller step"}, s.cut_backs);
    list_numbers(s.numbers, v);
    v({"share_zz_not_intermediate", "-", "largest share of the area in which σ_zz is not the intermediate principal stress"},
      s.share_zz_not_intermediate);
    v({"viscous_share", "-", "largest share of the strength that is due to viscosity"}, s.viscous_share);
    v({"unstable_share", "-", "largest share of the area that weakens in a step while its plastic flow contracts"},
      s.unstable_share);
    v({"max_equivalent_plastic_strain", "-", "largest equivalent plastic strain"}, s.max_equivalent_plastic_strain);
    v({"platen_unbalance", "-", "sum of the vertical platen forces at the end, relative to their mean size"}, s.platen_unbalance);
    v({"law", "-", "constitutive law", Kind::setting}, s.law);
    v({"internal_length_d", "mean diameters", "internal length of the law"}, s.internal_length);
    v({"parameters_from", "-", "origin of the continuum parameters: fitted or predicted", Kind::setting}, s.parameters_from);
    list_numbers(s.facts, v);
  }

  template <class Visitor> void list_numbers(const CostSummary &c, Visitor &v)
  {
    v({"preparation_cpu_s", "s", "CPU time for the preparation of the grains", Kind::clock}, c.preparation_cpu_s);
    v({"discrete_cpu_s", "s", "CPU time for the loading of the grains", Kind::clock}, c.discrete_cpu_s);
    v({"continuum_cpu_s", "s", "CPU time for the continuum", Kind::clock}, c.continuum_cpu_s);
    v({"comparison_cpu_s", "s", "CPU time for homogenisation and comparison", Kind::clock}, c.comparison_cpu_s);
    v({"peak_memory_mb", "MB", "largest memory of the program", Kind::clock}, c.peak_memory_mb);
  }

  struct ComparisonDocument
  {
    const Scene      &scene;
    const Comparison &comparison;
  };
  template <class Visitor> void list_numbers(const ComparisonDocument &d, Visitor &v)
  {
    const Comparison &c = d.comparison;
    v({"format", "-", "version of the format of this file", Kind::setting}, 2);
    v({"scene", "-", "name of the scene", Kind::setting}, d.scene.name);
    v({"seed", "-", "seed of the random sample", Kind::setting}, d.scene.sample.seed);
    v({"walk", "-", "meaning of progress: axial_strain, shear_strain or time", Kind::setting},
      discrete::name_of(discrete::loading_variable_of(d.scene.loading.mode)));
    v({"mean_diameter", "length", "mean diameter d of the grains", Kind::setting}, d.scene.sample.mean_diameter);
    v({"pressure", "pressure", "lateral pressure P on the sample", Kind::setting}, d.scene.loading.pressure);
    v({"averaging_width", "strain or time", "range of progress over which running means are taken", Kind::setting},
      averaging_width(d.scene));
    v.list("stages", "instants at which both panels are compared", c.stages);
    v.list("windows", "windows over which displacement increments are compared", c.windows);
    v.group("continuum_coarse", "the continuum's run on the coarse mesh", c.coarse);
    v.group("discrete_summary", "the grains' whole run", c.discrete);
    v.group("continuum_summary", "the continuum's whole run", c.continuum);
    v.list("summary", "the numbers that a user asks for first", key_numbers(c));
    v.list("checks", "limits within which the results are reliable", checks_of(d.scene.discrete, d.scene.comparison, c));
    v.group("cost", "CPU time and memory", c.cost);
    v.group("resolution_study", "dependence of the grains' stress on the averaging length", c.resolution);
    v.group("theory", "inclinations of a band to the minor principal stress by theory", c.theory);
  }
} // namespace diptych::coupling
