// diptych: the results of the comparison at one stage
// SPDX-License-Identifier: LGPL-2.1-or-later
#include "coupling/comparison/stage_record.h"

#include <stdexcept>

#include "coupling/cells/principal_axes.h"

namespace diptych::coupling
{
  namespace
  {
    Eigen::Matrix2d sum_of_moments(const discrete::Snapshot &grains)
    {
      Eigen::Matrix2d sum = Eigen::Matrix2d::Zero();
      for (const Eigen::Matrix2d &moment : grains.mean_internal_moment)
        sum += moment;
      return sum;
    }

    void map_fields(const StagePair &stage, const ComparisonOptions &options, StageRecord &record)
    {
      record.fields                       = mesh_fields(record.increment.mesh, stage, options.averaging);
      record.mapping.method               = discrete::name_of(options.averaging.method);
      record.mapping.total_relative_error = record.fields.grains.total_relative_error;
      record.mapping.outside_share        = record.fields.grains.outside_share;
      record.mapping.window_time          = stage.grains_to.window_time;
      record.mapping.couple_residual      = record.fields.grains.couple_residual;
      record.mapping.nodal_residual       = record.fields.grains.nodal_residual;
      record.grid = grid_fields(record.fields, stage, options.averaging, options.grid_size * stage.grains_to.mean_diameter);
      record.stress_differences = stress_differences(record.fields, stage, options.averaging);
      record.stress_verdict     = stress_verdict(record.stress_differences.back());
    }

    // |sum of m_i a_i (x) x_i| / |sum of M_i| of the last step, symmetric parts. For a body at rest the external forces give the
    // sum of the grains' moments; this is the relative deviation from it (Moreau 1997, section 2). m a = contact forces + applied
    // force. Places are relative to the middle of the grains.
    double acceleration_share(const discrete::Snapshot &grains)
    {
      const int                    n     = int(grains.position.size());
      std::vector<Eigen::Vector2d> force = grains.applied_force;
      force.resize(n, Eigen::Vector2d::Zero());
      for (const discrete::ContactForce &contact : grains.contacts)
        {
          force[contact.i] += contact.force;
          if (contact.j < n)
            force[contact.j] -= contact.force;
        }
      Eigen::Vector2d middle = Eigen::Vector2d::Zero();
      for (const Eigen::Vector2d &x : grains.position)
        middle += x / double(n);
      Eigen::Matrix2d term = Eigen::Matrix2d::Zero(), moment = Eigen::Matrix2d::Zero();
      for (int i = 0; i < n; ++i)
        {
          if (grains.fixed.empty() || grains.fixed[i] == 0)
            term += force[i] * (grains.position[i] - middle).transpose();
          moment += grains.internal_moment[i];
        }
      return (term + term.transpose()).norm() / (moment + moment.transpose()).norm();
    }

    double minor_direction(const Eigen::Matrix2d &stress)
    {
      return line_turn(major_direction(stress) + 90, 0);
    }

    struct ProbeView
    {
      std::vector<Eigen::Vector2d> outline;
      GrainNetwork                 network;
      BootstrapOptions             bootstrap;
      const SampleFrame           &frame;
      const std::vector<Band>     &bands; // the grains' bands
    };

    void take_rectangles(const ProbeView &view, const ProbeOptions &options, StageRecord &record)
    {
      const std::vector<ProbeRegion> regions = place_probes(view.outline, view.frame, view.bands, options);
      std::vector<ProbeBlocks>       blocks;
      for (const ProbeRegion &region : regions)
        {
          if (region.polygon.empty() && !options.probe_rectangles.empty())
            throw std::invalid_argument("comparison/probe_rectangles: " + region.name + " lies outside the sample");
          blocks.push_back(probe_blocks(region, view.network, view.bootstrap.block));
          record.discrete.probes.push_back(
            {region, grain_probe_stress(region, view.network.position, view.network.radius, view.network.moment),
             probe_fabric(region, view.network.contacts), probe_intervals(blocks.back(), view.bootstrap),
             grain_pressure(region, view.network)});
          record.continuum.probes.push_back(
            {region, cell_probe_stress(region, record.fields.mesh, record.fields.own.stress), {}, {}, {}});
        }
      record.probe_differences = probe_differences(regions, blocks, view.bootstrap);
    }

    void take_circle(const ProbeView &view, const ProbeOptions &options, StageRecord &record)
    {
      const Circle circle = place_circle(view.outline, view.frame, view.bands, options);
      if (!(circle.radius > 0) && !options.probe_circle.empty())
        throw std::invalid_argument("comparison/probe_circle: the circle lies outside the sample");
      if (!(circle.radius > 0))
        return;
      record.discrete.circle  = grain_circular_probe(circle, view.network, view.bootstrap);
      record.continuum.circle = cell_circular_probe(circle, record.fields.mesh, TriangleSearch(record.fields.mesh),
                                                    record.fields.own.stress);
    }

    // Dissipation by friction and by impacts, because the continuum's plastic work covers all dissipation. Empty if the file has
    // none.
    std::vector<double> dissipation_of_pairs(const discrete::Snapshot &grains)
    {
      std::vector<double>        sum    = grains.window_dissipation;
      const std::vector<double> &impact = grains.window_impact_dissipation;
      if (sum.size() != grains.window_forces.size() || impact.size() != sum.size())
        return {};
      for (std::size_t k = 0; k < sum.size(); ++k)
        sum[k] += impact[k];
      return sum;
    }

    void look_across_the_band(const ProbeView &view, const StagePair &stage, StageRecord &record)
    {
      if (view.bands.empty())
        return;
      const Band                  &band = view.bands[0];
      const BandZone               zone = band_zone(view.frame, band);
      std::vector<Eigen::Vector2d> points;
      for (const discrete::ContactForce &contact : view.network.forces)
        points.push_back(contact.point);
      if (const std::vector<double> dissipation = dissipation_of_pairs(stage.grains_to); !dissipation.empty())
        record.discrete.dissipation = contact_dissipation_split(zone, view.outline, points, dissipation);
      record.continuum.dissipation = cell_dissipation_split(zone, record.fields.mesh, record.fields.own.dissipation);

      const TractionStrips strips = traction_strips(view.outline, view.frame, band.angle_deg,
                                                    strip_edges(view.frame, band.angle_deg, band.offset));
      record.discrete.traction    = grain_band_traction(strips, view.network, view.bootstrap.block);
      record.continuum.traction   = cell_band_traction(strips, record.fields.mesh, TriangleSearch(record.fields.mesh),
                                                       record.fields.own.stress);
      record.force_chains = grain_force_chains(zone, view.outline, view.network, 2 * view.frame.mean_diameter, view.bootstrap);
    }
  } // namespace

  StageRecord stage_record(Increment                increment,
                           const StagePair         &stage,
                           const ComparisonOptions &options,
                           const std::uint64_t      seed)
  {
    StageRecord record;
    record.progress     = stage.grains_to.progress;
    record.axial_strain = stage.grains_to.axial_strain;
    record.shear_strain = stage.grains_to.shear_strain;
    record.time         = stage.grains_to.time;
    record.increment    = std::move(increment);
    map_fields(stage, options, record);

    double spin = 0;
    for (const double term : stage.grains_to.mean_spin_term)
      spin += term;
    record.discrete.dynamic_share = spin / (0.5 * sum_of_moments(stage.grains_to).trace());

    record.discrete.acceleration_share   = acceleration_share(stage.grains_to);
    record.discrete.minor_direction_deg  = minor_direction(sum_of_moments(stage.grains_to));
    record.continuum.minor_direction_deg = minor_direction(
      (stage.nodes_from.mean_stress + stage.nodes_to.mean_stress).topLeftCorner<2, 2>());

    const ProbeOptions &probes = options.probes;
    const ProbeView     view{outline_polygon(stage.grains_to.outline),
                         grain_network(stage.grains_to),
                         {probes.probe_block * stage.grains_to.mean_diameter, probes.probe_resamples, seed},
                         record.increment.frame,
                         record.increment.discrete.band.bands};
    take_rectangles(view, probes, record);
    take_circle(view, probes, record);
    look_across_the_band(view, stage, record);
    return record;
  }
} // namespace diptych::coupling
