// diptych: the list of the numbers of a stage
// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <array>
#include <cmath>
#include <iterator>
#include <string>
#include <vector>

#include "coupling/comparison/increment_numbers.h"
#include "coupling/comparison/stage_record.h"
#include "coupling/numbers/number_entry.h"

namespace diptych::coupling
{
  struct PressurePercentiles
  {
    std::array<double, 5> values = {{NAN, NAN, NAN, NAN, NAN}};
  };
  template <class Visitor> void list_numbers(const PressurePercentiles &p, Visitor &v)
  {
    constexpr const char *keys[] = {"5", "25", "50", "75", "95"};
    static_assert(percentile_levels.size() == std::size(keys));
    for (std::size_t k = 0; k < p.values.size(); ++k)
      v({keys[k], "pressure", "that so many per cent of the grains stay below"}, p.values[k]);
  }

  template <class Visitor> void list_numbers(const GrainPressure &p, Visitor &v)
  {
    v({"mean", "pressure", "mean pressure of single grains"}, p.mean);
    v({"deviation", "pressure", "standard deviation"}, p.deviation);
    v({"grains", "-", "grains"}, p.grains);
    v.group("percentiles", "percentiles of the pressure of single grains", PressurePercentiles{p.percentiles});
  }

  namespace numbers
  {
    // What of a probe both panels tell.
    template <class Visitor> void list_place_and_stress(const ProbeRecord &p, Visitor &v)
    {
      v({"name", "-", "of the probe", Kind::setting}, p.region.name);
      v({"polygon", "length", "corners of the probe", Kind::setting}, p.region.polygon);
      v({"stress", "pressure", "mean stress"}, p.stress.stress);
      v({"count", "-", "grains or cells averaged over"}, p.stress.count);
    }
  } // namespace numbers

  // A probe of the grains: with fabric and intervals.
  struct GrainProbe : ProbeRecord
  {};
  template <class Visitor> void list_numbers(const GrainProbe &p, Visitor &v)
  {
    const ProbeIntervals &i = p.intervals;
    numbers::list_place_and_stress(p, v);
    v({"s1", "pressure", "major principal stress"}, i.s1);
    v({"s2", "pressure", "minor principal stress"}, i.s2);
    v({"direction_deg", "degrees", "direction of the major principal stress", Kind::line}, i.direction_deg);
    v({"t_over_s", "-", "stress ratio t/s"}, i.t_over_s);
    v({"blocks", "-", "blocks that were resampled"}, i.blocks);
    v({"fabric", "-", "fabric tensor, mean of n (x) n"}, p.fabric.fabric);
    v({"fabric_direction_deg", "degrees", "major direction of the fabric", Kind::line}, i.fabric_direction_deg);
    v({"fabric_direction_error_deg", "degrees", "its standard error, contacts taken as independent"},
      p.fabric.direction_error_deg);
    v({"fabric_to_stress_deg", "degrees", "turn from the stress's direction to the fabric's", Kind::line},
      i.fabric_to_stress_deg);
    v({"anisotropy", "-", "anisotropy of the fabric"}, i.anisotropy);
    v({"anisotropy_error", "-", "its standard error, contacts taken as independent"}, p.fabric.anisotropy_error);
    v({"normals_24", "-", "contact normals in sectors of 15 degrees"}, p.fabric.normals_24);
    v({"contacts", "-", "contacts that transmit force"}, p.fabric.contacts);
    v.group("grain_pressure", "pressure of single grains", p.pressure);
  }

  struct CellProbe : ProbeRecord
  {};
  template <class Visitor> void list_numbers(const CellProbe &p, Visitor &v)
  {
    numbers::list_place_and_stress(p, v);
    v({"s1", "pressure", "major principal stress"}, p.stress.s1);
    v({"s2", "pressure", "minor principal stress"}, p.stress.s2);
    v({"direction_deg", "degrees", "direction of the major principal stress", Kind::line}, p.stress.direction_deg);
    v({"t_over_s", "-", "stress ratio t/s"}, p.stress.t_over_s);
  }

  template <class Visitor> void list_numbers(const CircularProbe &c, Visitor &v)
  {
    v({"centre", "length", "of the circle", Kind::setting}, c.circle.centre);
    v({"radius", "length", "of the circle"}, c.circle.radius);
    v({"stress", "pressure", "mean stress"}, c.stress);
    v({"angles_deg", "degrees", "directions of the diameters", Kind::setting}, c.angles_deg);
    v({"normal", "pressure", "normal traction across the diameters"}, c.normal);
    v({"tangential", "pressure", "tangential traction"}, c.tangential);
    v({"predicted_normal", "pressure", "normal traction that the mean stress gives"}, c.predicted_normal);
    v({"predicted_tangential", "pressure", "tangential traction that the mean stress gives"}, c.predicted_tangential);
    v({"normal_error", "pressure", "standard error, blocks along the diameter taken as independent"}, c.normal_error);
    v({"tangential_error", "pressure", "standard error, blocks along the diameter taken as independent"}, c.tangential_error);
    v({"relative_l2", "-", "relative difference of measured and predicted tractions"}, c.relative_l2);
    v({"independent_blocks", "-", "the same norm of the standard errors"}, c.independent_blocks);
  }

  template <class Visitor> void list_numbers(const DissipationSplit &d, Visitor &v)
  {
    v({"inside", "pressure length^2", "dissipated inside the grains' band"}, d.inside);
    v({"outside", "pressure length^2", "dissipated outside"}, d.outside);
    v({"share_inside", "-", "share inside the grains' band"}, d.share_inside);
    v({"area_share", "-", "the band's share of the area"}, d.area_share);
    v({"density_ratio", "-", "dissipated per area, inside over outside"}, d.density_ratio);
  }

  template <class Visitor> void list_numbers(const BandTraction &t, Visitor &v)
  {
    v({"edges_d", "mean diameters", "edges of the strips along the normal", Kind::setting, true}, t.edges);
    v({"normal", "pressure", "normal traction on planes parallel to the band"}, t.normal);
    v({"shear", "pressure", "shear traction on them"}, t.shear);
    v({"variation_normal", "-", "deviation over the strips / size of the mean traction"}, t.variation_normal);
    v({"variation_shear", "-", "deviation over the strips / size of the mean traction"}, t.variation_shear);
    v({"normal_error", "pressure", "standard error, blocks along the strip taken as independent"}, t.normal_error);
    v({"shear_error", "pressure", "standard error, blocks along the strip taken as independent"}, t.shear_error);
    v({"independent_normal", "-", "mean standard error / size of the mean traction"}, t.independent_normal);
    v({"independent_shear", "-", "mean standard error / size of the mean traction"}, t.independent_shear);
  }

  template <class Visitor> void list_numbers(const ChainDistribution &d, Visitor &v)
  {
    v({"grains", "-", "grains"}, d.count);
    v({"mean", "-", "mean, relative to that of all grains"}, d.mean);
    v({"share_above_mean", "-", "share above the mean of all grains"}, d.share_above_mean);
    v({"values", "-", "values at the quantiles"}, d.values);
  }

  template <class Visitor> void list_numbers(const ForceChains &f, Visitor &v)
  {
    v.group("inside", "grains inside the band", f.inside);
    v.group("outside", "grains outside", f.outside);
    v({"quantiles", "-", "where the distributions have their values", Kind::setting}, chain_quantiles);
    v({"largest_distance", "-", "largest distance of the two distributions"}, f.largest_distance);
    v({"blocks", "-", "blocks that were resampled"}, f.blocks);
    v({"verdict", "-", "whether the force chains see the zone"}, f.verdict);
  }

  template <class Visitor> void list_numbers(const ProbeDifference &d, Visitor &v)
  {
    v({"of", "-", "a probe", Kind::setting}, d.first);
    v({"and", "-", "the one it is compared with", Kind::setting}, d.second);
    v({"t_over_s", "-", "difference of t/s"}, d.t_over_s);
    v({"anisotropy", "-", "difference of the anisotropy"}, d.anisotropy);
    v({"direction_deg", "degrees", "turn of the major principal stress", Kind::line}, d.direction_deg);
    v({"verdict", "-", "whether they differ"}, d.verdict);
  }

  // One panel at a stage: forces as a pair.
  struct PlatenResultants
  {
    Eigen::Vector2d lower = Eigen::Vector2d::Zero(), upper = lower;
  };
  template <class Visitor> void list_numbers(const PlatenResultants &p, Visitor &v)
  {
    v({"lower", "pressure length", "of the lower platen on the sample"}, p.lower);
    v({"upper", "pressure length", "of the upper platen on the sample"}, p.upper);
  }

  namespace numbers
  {
    template <class Visitor> void list_panel(const PanelRecord &p, const PanelIncrement &increment, Visitor &v)
    {
      const bool has_circle = p.circle.circle.radius > 0;
      v({"volumetric_strain", "-", "volumetric strain, dilation negative"}, p.volumetric_strain);
      v.group("platen_resultants", "forces, averaged like the stress ratio", PlatenResultants{p.lower_force, p.upper_force});
      v({"dynamic_share", "-", "spin term / mean stress, over the stage"}, p.dynamic_share);
      v({"minor_direction_deg", "degrees", "direction of the least compression of the mean stress", Kind::line},
        p.minor_direction_deg);
      v.group("circular_probe", "tractions across the diameters of a circle",
              has_circle ? std::optional<CircularProbe>(p.circle) : std::nullopt);
      v.group("dissipation", "inside and outside the grains' band", p.dissipation);
      v.group("band_traction", "on planes parallel to the grains' band", p.traction);
      list_numbers(increment, v);
    }

    template <class Probe> std::vector<Probe> probes_as(const std::vector<ProbeRecord> &probes)
    {
      std::vector<Probe> result;
      for (const ProbeRecord &probe : probes)
        result.push_back(Probe{probe});
      return result;
    }
  } // namespace numbers

  struct GrainsOfStage
  {
    const StageRecord &stage;
  };
  template <class Visitor> void list_numbers(const GrainsOfStage &g, Visitor &v)
  {
    const StageRecord &s = g.stage;
    v({"stress_ratio", "-", "t/s of the whole sample, mean over the last part of the stage"}, s.discrete.stress_ratio);
    numbers::list_panel(s.discrete, s.increment.discrete, v);
    v.list("probes", "rectangular probes", numbers::probes_as<GrainProbe>(s.discrete.probes));
    v({"acceleration_share", "-", "acceleration term / mean stress, in the last step"}, s.discrete.acceleration_share);
    v.group("force_chains", "major principal stress of single grains", s.force_chains);
    v.list("probe_differences", "the zone's probe minus each of the others", s.probe_differences);
  }

  struct ContinuumOfStage
  {
    const StageRecord &stage;
  };
  template <class Visitor> void list_numbers(const ContinuumOfStage &c, Visitor &v)
  {
    const StageRecord &s = c.stage;
    v({"stress_ratio", "-", "t/s of the whole sample, mean over the last part of the stage"}, s.continuum.stress_ratio.value);
    numbers::list_panel(s.continuum, s.increment.continuum, v);
    v.list("probes", "rectangular probes", numbers::probes_as<CellProbe>(s.continuum.probes));
  }

  // In mean diameters of the sample, as all lengths of a comparison.
  template <class Visitor> void list_numbers(const StressDifference &d, Visitor &v)
  {
    v({"label", "-", "of the cells", Kind::setting}, d.label);
    v({"resolution_d", "mean diameters", "size of the cells", Kind::number, true}, d.size);
    v({"cells", "-", "cells that carry both values"}, d.cells);
    v({"relative_l2", "-", "relative difference of the stresses"}, d.relative_l2);
    v({"direction_deg", "degrees", "root mean square angle between the principal directions"}, d.direction_deg);
    v({"sampling_alone", "-", "the grains' scatter about their own smooth field"}, d.sampling_alone);
    v({"lowest_scatter", "-", "scatter of independent grains: a lower bound"}, d.lowest_scatter);
  }

  struct DifferenceOfStage
  {
    const StageRecord &stage;
  };
  template <class Visitor> void list_numbers(const DifferenceOfStage &d, Visitor &v)
  {
    const StageRecord &s = d.stage;
    v({"stress_ratio", "-", "difference of t/s"}, s.stress_ratio_difference);
    v({"volumetric_strain", "-", "difference of the volumetric strains"}, s.volumetric_strain_difference);
    v({"stress_l2_relative", "-", "relative difference of the stresses on the mesh's cells"},
      s.stress_differences.empty() ? NAN : s.stress_differences.front().relative_l2);
    v.list("stress", "difference of the stresses by the size of the cells", s.stress_differences);
    v({"stress_verdict", "-", "what the widest cells say"}, s.stress_verdict);
    list_numbers(s.band_difference, v);
  }

  template <class Visitor> void list_numbers(const MappingRecord &m, Visitor &v)
  {
    v({"method", "-", "of the averaging", Kind::setting}, m.method);
    v({"total_relative_error", "-", "relative error of the total moment"}, m.total_relative_error);
    v({"nodal_residual", "-", "nodal residual of equilibrium"}, m.nodal_residual);
    v({"outside_share", "-", "share from outside the mesh"}, m.outside_share);
    v({"window_time", "time", "over which the grains' forces are averaged"}, m.window_time);
  }

  template <class Visitor> void list_numbers(const StageRecord &s, Visitor &v)
  {
    v({"progress", "as walk says", "progress at the end of the stage", Kind::setting}, s.progress);
    v({"axial_strain", "-", "axial strain of the grains at the end", Kind::setting}, s.axial_strain);
    v({"shear_strain", "-", "shear strain of the grains at the end", Kind::setting}, s.shear_strain);
    v({"time", "time", "since the start of the grains' loading", Kind::setting}, s.time);
    v({"duration", "time", "of the stage", Kind::setting}, s.increment.duration);
    v({"displacement_unit_d", "mean diameters", "what displacements count in: the upper platen's", Kind::setting, true},
      s.increment.displacement_unit);
    v.group("discrete", "the grains", GrainsOfStage{s});
    v.group("continuum", "the continuum", ContinuumOfStage{s});
    v.group("difference", "continuum minus grains", DifferenceOfStage{s});
    v.group("mapping", "of the grains' moments onto the mesh", s.mapping);
  }
} // namespace diptych::coupling
