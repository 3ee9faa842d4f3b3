// diptych: displacement increments of both panels between two instants, and their bands and strips
// SPDX-License-Identifier: LGPL-2.1-or-later
#include "coupling/comparison/increment.h"

#include <cmath>

#include "coupling/averaging/periodic.h"
#include "discrete/files/csv_file.h"
#include "coupling/statistics/block_bootstrap.h"

namespace diptych::coupling
{
  namespace
  {
    double displacement_unit(const SampleFrame &frame, const DisplacementField &grains)
    {
      if (const double platen = frame.platen_increment.norm(); platen > 1e-9 * frame.mean_diameter)
        return platen;
      std::vector<double> moved;
      for (const Eigen::Vector2d &u : grains.increment)
        moved.push_back(u.norm());
      const double largest = moved.empty() ? 0 : quantile(moved, 0.98);
      return largest > 0 ? largest : frame.mean_diameter;
    }

    // The strips of both panels lie along the grains' band. Without one they lie along the continuum's band, otherwise along the
    // platen's travel.
    Strips cut_strips(const DisplacementField &field, const Increment &increment)
    {
      const std::vector<Band> &grains = increment.discrete.band.bands, &nodes = increment.continuum.band.bands;
      const Eigen::Vector2d   &travel = increment.frame.platen_increment;
      double                   angle = std::atan2(travel.y(), travel.x()) * 180 / M_PI, offset = 0;
      if (!grains.empty())
        {
          angle  = grains[0].angle_deg;
          offset = grains[0].offset;
        }
      else if (!nodes.empty())
        {
          angle  = nodes[0].angle_deg;
          offset = nodes[0].offset;
        }
      if (angle <= -90)
        angle += 180;
      return strip_means(field, increment.frame, angle, strip_edges(increment.frame, angle, offset));
    }

    // Nothing is random in the continuum: its misfit is no noise, and resampling it gives no interval.
    BandOptions without_resampling(BandOptions options)
    {
      options.resamples = 0;
      return options;
    }

    // A mesh of a few elements has too few points.
    BandReport bands_of(const DisplacementField &field, const SampleFrame &frame, const BandOptions &options, std::uint64_t seed)
    {
      const auto n = std::count_if(field.weight.begin(), field.weight.end(), [](const double w) { return w > 0; });
      if (n >= fewest_band_points)
        return find_bands(field, frame, options, seed);
      BandReport report;
      report.verdict = "no band is sought: " + std::to_string(n) + " points, and at least " + std::to_string(fewest_band_points) +
                       " are needed";
      return report;
    }
  } // namespace

  SampleFrame sample_frame(const discrete::Snapshot &from, const discrete::Snapshot &to)
  {
    Eigen::Vector2d low = to.outline.left.front(), high = to.outline.right.front();
    for (const auto *side : {&to.outline.left, &to.outline.right})
      for (const Eigen::Vector2d &x : *side)
        {
          low  = low.cwiseMin(x);
          high = high.cwiseMax(x);
        }
    SampleFrame frame;
    frame.centre           = 0.5 * (low + high);
    frame.width            = high.x() - low.x();
    frame.height           = high.y() - low.y();
    frame.mean_diameter    = to.mean_diameter;
    frame.platen_increment = to.upper_platen_displacement - from.upper_platen_displacement;
    return frame;
  }

  Increment make_increment(const StagePair &pair, const BandOptions &options, std::uint64_t seed)
  {
    const double radius = strain_radius(pair.grains_to.mean_diameter);
    Increment    result;
    result.from              = discrete::tidy(pair.grains_from.progress); // sums of steps
    result.to                = discrete::tidy(pair.grains_to.progress);
    result.duration          = pair.grains_to.time - pair.grains_from.time;
    result.frame             = sample_frame(pair.grains_from, pair.grains_to);
    result.mesh              = quad_mesh(pair.nodes_to);
    result.discrete.field    = displacement_field(pair.grains_from, pair.grains_to);
    result.continuum.field   = displacement_field(pair.nodes_from, pair.nodes_to);
    result.cover             = grain_cover(result.mesh, pair.grains_to);
    result.displacement_unit = displacement_unit(result.frame, result.discrete.field);

    const std::vector<Eigen::Vector2d> centres = cell_centres(result.mesh);
    result.discrete.band                       = bands_of(result.discrete.field, result.frame, options, seed);
    result.continuum.band = bands_of(result.continuum.field, result.frame, without_resampling(options), seed);
    for (PanelIncrement *panel : {&result.discrete, &result.continuum})
      panel->cell_shear = shear_strain_increment(panel->field, centres, radius);
    for (PanelIncrement *panel : {&result.discrete, &result.continuum})
      {
        panel->strips = cut_strips(panel->field, result);
        if (panel->band.bands.empty())
          continue;
        const auto [level, slope]      = background(panel->strips, panel->band.bands[0]);
        panel->strips.background       = level;
        panel->strips.background_slope = slope * result.frame.mean_diameter;
      }
    for (std::size_t k = 0; k < centres.size(); ++k)
      if (!result.cover.covered[k])
        result.discrete.cell_shear[k] = NAN;
    result.grain_shear = shear_strain_increment(result.discrete.field, result.discrete.field.position, radius);
    return result;
  }

  PanelIncrement continuum_increment(const continuum::Snapshot &from,
                                     const continuum::Snapshot &to,
                                     const SampleFrame         &frame,
                                     const BandOptions         &options,
                                     std::uint64_t              seed)
  {
    PanelIncrement panel;
    panel.field = displacement_field(from, to);
    panel.band  = bands_of(panel.field, frame, without_resampling(options), seed);
    return panel;
  }
} // namespace diptych::coupling
