// diptych: list of the numbers of a stage
// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <array>
#include <cmath>
#include <iterator>
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
      v({keys[k], "pressure", "pressure below which this percentage of the grains lies"}, p.values[k]);
  }

  template <class Visitor> void list_numbers(const GrainPressure &p, Visitor &v)
  {
    v({"mean", "pressure", "mean pressure of single grains"}, p.mean);
    v({"deviation", "pressure", "standard deviation of the pressure of single grains"}, p.deviation);
    v({"grains", "-", "number of grains in the probe"}, p.grains);
    v.group("percentiles", "percentiles of the pressure of single grains", PressurePercentiles{p.percentiles});
  }

  namespace numbers
  {
    // values: s1, s2, direction_deg and t_over_s, with or without intervals.
    template <class Values, class Visitor> void list_place_and_stress(const ProbeRecord &p, const Values &values, Visitor &v)
    {
      v({"name", "-", "name of the probe", Kind::setting}, p.region.name);
      v({"polygon", "length", "corners of the probe", Kind::setting}, p.region.polygon);
      v({"stress", "pressure", "mean stress in the probe, positive in compression"}, p.stress.stress);
      v({"count", "-", "number of grains or cells in the mean"}, p.stress.count);
      v({"s1", "pressure", "major principal stress of the probe"}, values.s1);
      v({"s2", "pressure", "minor principal stress of the probe"}, values.s2);
      v({"direction_deg", "degrees", "direction of the major principal stress, anticlockwise from the horizontal", Kind::line},
        values.direction_deg);
      v({"t_over_s", "-", "stress ratio t/s of the probe"}, values.t_over_s);
    }
  } // namespace numbers

  struct GrainProbe : ProbeRecord
  {};
  template <class Visitor> void list_numbers(const GrainProbe &p, Visitor &v)
  {
    const ProbeIntervals &i = p.intervals;
    numbers::list_place_and_stress(p, i, v);
    v({"blocks", "-", "number of blocks that were resampled"}, i.blocks);
    v({"fabric", "-", "fabric tensor of the contact normals n, mean of n (x) n"}, p.fabric.fabric);
    v({"fabric_direction_deg", "degrees", "major direction of the fabric, anticlockwise from the horizontal", Kind::line},
      i.fabric_direction_deg);
    v({"fabric_direction_error_deg", "degrees", "standard error of the fabric's direction for independent contacts"},
      p.fabric.direction_error_deg);
    v({"fabric_to_stress_deg", "degrees", "angle from the major stress direction to the major fabric direction, anticlockwise",
       Kind::line},
      i.fabric_to_stress_deg);
    v({"anisotropy", "-", "anisotropy of the fabric"}, i.anisotropy);
    v({"anisotropy_error", "-", "standard error of the anisotropy for independent contacts"}, p.fabric.anisotropy_error);
    v({"normals_24", "-", "number of contact normals in each sector of 15 degrees"}, p.fabric.normals_24);
    v({"contacts", "-", "number of contacts that transmit force"}, p.fabric.contacts);
    v.group("grain_pressure", "pressure of single grains", p.pressure);
  }

  struct CellProbe : ProbeRecord
  {};
  template <class Visitor> void list_numbers(const CellProbe &p, Visitor &v)
  {
    numbers::list_place_and_stress(p, p.stress, v);
  }

  template <class Visitor> void list_numbers(const CircularProbe &c, Visitor &v)
  {
    v({"centre", "length", "centre of the circle", Kind::setting}, c.circle.centre);
    v({"radius", "length", "radius of the circle"}, c.circle.radius);
    v({"stress", "pressure", "mean stress in the circle, positive in compression"}, c.stress);
    v({"angles_deg", "degrees", "angles of the diameters, anticlockwise from the horizontal", Kind::setting}, c.angles_deg);
    v({"normal", "pressure", "normal traction across each diameter, positive in compression"}, c.normal);
    v({"tangential", "pressure", "tangential traction across each diameter"}, c.tangential);
    v({"predicted_normal", "pressure", "normal traction predicted by the mean stress"}, c.predicted_normal);
    v({"predicted_tangential", "pressure", "tangential traction predicted by the mean stress"}, c.predicted_tangential);
    v({"normal_error", "pressure", "standard error of the normal traction for independent blocks along the diameter"},
      c.normal_error);
    v({"tangential_error", "pressure", "standard error of the tangential traction for independent blocks along the diameter"},
      c.tangential_error);
    v({"relative_l2", "-", "relative difference of measured and predicted tractions"}, c.relative_l2);
    v({"independent_blocks", "-", "standard errors of the tractions relative to the predicted tractions, for independent blocks"},
      c.independent_blocks);
  }

  template <class Visitor> void list_numbers(const DissipationSplit &d, Visitor &v)
  {
    v({"inside", "pressure length^2", "energy dissipated inside the grains' band, per unit thickness"}, d.inside);
    v({"outside", "pressure length^2", "energy dissipated outside the grains' band, per unit thickness"}, d.outside);
    v({"share_inside", "-", "share of the dissipation inside the grains' band"}, d.share_inside);
    v({"area_share", "-", "share of the area inside the grains' band"}, d.area_share);
    v({"density_ratio", "-", "ratio of dissipation per area, inside over outside the grains' band"}, d.density_ratio);
  }

  template <class Visitor> void list_numbers(const BandTraction &t, Visitor &v)
  {
    v({"edges_d", "mean diameters", "edges of the strips along the band's normal, from the sample's centre", Kind::setting, true},
      t.edges);
    v({"normal", "pressure", "normal traction on planes parallel to the band, positive in compression"}, t.normal);
    v({"shear", "pressure", "shear traction on planes parallel to the band"}, t.shear);
    v({"variation_normal", "-", "standard deviation of the normal traction over the strips / size of the mean traction"},
      t.variation_normal);
    v({"variation_shear", "-", "standard deviation of the shear traction over the strips / size of the mean traction"},
      t.variation_shear);
    v({"normal_error", "pressure", "standard error of the normal traction for independent blocks along the strip"},
      t.normal_error);
    v({"shear_error", "pressure", "standard error of the shear traction for independent blocks along the strip"}, t.shear_error);
    v({"independent_normal", "-", "root mean square standard error of the normal traction / size of the mean traction"},
      t.independent_normal);
    v({"independent_shear", "-", "root mean square standard error of the shear traction / size of the mean traction"},
      t.independent_shear);
  }

  template <class Visitor> void list_numbers(const ChainDistribution &d, Visitor &v)
  {
    v({"grains", "-", "number of grains"}, d.count);
    v({"mean", "-", "mean major principal stress, relative to the mean of all grains"}, d.mean);
    v({"share_above_mean", "-", "share of these grains whose stress exceeds the mean of all grains"}, d.share_above_mean);
    v({"values", "-", "stress at each quantile, relative to the mean of all grains"}, d.values);
  }

  template <class Visitor> void list_numbers(const ForceChains &f, Visitor &v)
  {
    v.group("inside", "grains inside the band", f.inside);
    v.group("outside", "grains outside the band", f.outside);
    v({"quantiles", "-", "shares of grains at which the distributions are given", Kind::setting}, chain_quantiles);
    v({"largest_distance", "-", "largest distance between the distributions inside and outside the band"}, f.largest_distance);
    v({"blocks", "-", "number of resampled blocks inside or outside the band, the smaller of the two"}, f.blocks);
    v({"verdict", "-", "verdict on whether the force chains differ inside the band"}, f.verdict);
  }

  template <class Visitor> void list_numbers(const ProbeDifference &d, Visitor &v)
  {
    v({"of", "-", "name of the probe", Kind::setting}, d.first);
    v({"and", "-", "name of the probe that is subtracted", Kind::setting}, d.second);
    v({"t_over_s", "-", "difference of the stress ratios t/s"}, d.t_over_s);
    v({"anisotropy", "-", "difference of the fabric anisotropies"}, d.anisotropy);
    v({"direction_deg", "degrees", "rotation of the major principal stress, anticlockwise", Kind::line}, d.direction_deg);
    v({"verdict", "-", "verdict on whether the probes differ"}, d.verdict);
  }

  struct PlatenResultants
  {
    Eigen::Vector2d lower = Eigen::Vector2d::Zero(), upper = lower;
  };
  template <class Visitor> void list_numbers(const PlatenResultants &p, Visitor &v)
  {
    v({"lower", "pressure length", "force of the lower platen on the sample per unit thickness"}, p.lower);
    v({"upper", "pressure length", "force of the upper platen on the sample per unit thickness"}, p.upper);
  }

  namespace numbers
  {
    template <class Visitor> void list_panel(const PanelRecord &p, const PanelIncrement &increment, Visitor &v)
    {
      const bool has_circle = p.circle.circle.radius > 0;
      v({"volumetric_strain", "-", "volumetric strain of the sample, dilation negative"}, p.volumetric_strain);
      v.group("platen_resultants", "forces of the platens, averaged over the same range as the stress ratio",
              PlatenResultants{p.lower_force, p.upper_force});
      v({"dynamic_share", "-", "ratio of spin term to mean stress over the stage"}, p.dynamic_share);
      v({"minor_direction_deg", "degrees",
         "direction of the smallest compression of the mean stress, anticlockwise from the horizontal", Kind::line},
        p.minor_direction_deg);
      v.group("circular_probe", "tractions across the diameters of a circle",
              has_circle ? std::optional<CircularProbe>(p.circle) : std::nullopt);
      v.group("dissipation", "dissipation inside and outside the grains' band", p.dissipation);
      v.group("band_traction", "tractions on planes parallel to the grains' band", p.traction);
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
    v({"acceleration_share", "-", "ratio of acceleration term to mean stress in the last step"}, s.discrete.acceleration_share);
    v.group("force_chains", "distribution of the major principal stress of single grains", s.force_chains);
    v.list("probe_differences", "the band's probe minus each of the others", s.probe_differences);
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

  // Lengths are in mean diameters of the sample, like all lengths of a comparison.
  template <class Visitor> void list_numbers(const StressDifference &d, Visitor &v)
  {
    v({"label", "-", "name of the set of cells", Kind::setting}, d.label);
    v({"resolution_d", "mean diameters", "side of the cells", Kind::number, true}, d.size);
    v({"cells", "-", "number of cells with values of both panels"}, d.cells);
    v({"relative_l2", "-", "relative difference between the stresses of the panels"}, d.relative_l2);
    v({"direction_deg", "degrees", "root mean square angle between the major principal directions of the panels"},
      d.direction_deg);
    v({"sampling_alone", "-", "scatter of the grains' stress about its own smooth field"}, d.sampling_alone);
    v({"lowest_scatter", "-", "scatter of the stress for independent grains, a lower bound"}, d.lowest_scatter);
  }

  struct DifferenceOfStage
  {
    const StageRecord &stage;
  };
  template <class Visitor> void list_numbers(const DifferenceOfStage &d, Visitor &v)
  {
    const StageRecord &s = d.stage;
    v({"stress_ratio", "-", "difference of the stress ratios t/s of the whole sample"}, s.stress_ratio_difference);
    v({"volumetric_strain", "-", "difference of the volumetric strains of the sample"}, s.volumetric_strain_difference);
    v({"stress_l2_relative", "-", "relative difference of the stresses on the mesh's cells"},
      s.stress_differences.empty() ? NAN : s.stress_differences.front().relative_l2);
    v.list("stress", "difference of the stresses for each size of the cells", s.stress_differences);
    v({"stress_verdict", "-", "verdict on the difference of the stresses, from the widest cells"}, s.stress_verdict);
    list_numbers(s.band_difference, v);
  }

  template <class Visitor> void list_numbers(const MappingRecord &m, Visitor &v)
  {
    v({"method", "-", "averaging method", Kind::setting}, m.method);
    v({"total_relative_error", "-", "relative error of the mapped total moment"}, m.total_relative_error);
    v({"nodal_residual", "-", "largest residual of the nodal equilibrium, relative to the largest contact force"},
      m.nodal_residual);
    v({"couple_residual", "-",
       "largest residual of the nodal balance of moment, relative to largest force x longest half branch"},
      m.couple_residual);
    v({"outside_share", "-", "share of the contact forces that lies outside the mesh"}, m.outside_share);
    v({"window_time", "time", "time over which the grains' forces are averaged"}, m.window_time);
  }

  template <class Visitor> void list_numbers(const StageRecord &s, Visitor &v)
  {
    v({"progress", "strain or time", "progress at the end of the stage", Kind::setting}, s.progress);
    v({"axial_strain", "-", "axial strain of the grains at the end of the stage", Kind::setting}, s.axial_strain);
    v({"shear_strain", "-", "shear strain of the grains at the end of the stage", Kind::setting}, s.shear_strain);
    v({"time", "time", "time since the start of the grains' loading", Kind::setting}, s.time);
    v({"duration", "time", "duration of the stage", Kind::setting}, s.increment.duration);
    v({"displacement_unit_d", "mean diameters", "unit of displacements: the displacement of the upper platen", Kind::setting,
       true},
      s.increment.displacement_unit);
    v.group("discrete", "the grains", GrainsOfStage{s});
    v.group("continuum", "the continuum", ContinuumOfStage{s});
    v.group("difference", "continuum minus grains", DifferenceOfStage{s});
    v.group("mapping", "mapping of the grains' moments onto the mesh", s.mapping);
  }
} // namespace diptych::coupling
