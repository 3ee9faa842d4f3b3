// diptych: profiles of both panels across their bands
// SPDX-License-Identifier: LGPL-2.1-or-later
#include "coupling/comparison/increment_profiles.h"

#include <cmath>

#include "coupling/fields/continuum_averaging.h"
#include "coupling/probes/band_traction.h"
#include "coupling/probes/grain_network.h"
#include "coupling/probes/probe_regions.h"

namespace diptych::coupling
{
  namespace
  {
    constexpr int reach = 20; // strips on each side of the middle one, each one mean diameter thick

    // Rectangles in the axes of a band that cover the sample. Row k + 1 is strip k; the outer rows and the blocks that do not
    // count receive the rest of the sample.
    struct StripMesh
    {
      QuadMesh                       mesh;
      int                            n_blocks = 0;
      std::vector<std::vector<bool>> counts; // n_strips x n_blocks

      std::size_t cell(const int strip, const int block) const { return std::size_t((strip + 1) * n_blocks + block); }
    };

    StripMesh strip_mesh(const std::vector<Eigen::Vector2d> &outline,
                         const SampleFrame                  &frame,
                         const Band                         &band,
                         const double                        block)
    {
      const double        d      = frame.mean_diameter;
      const Tiles         tiles  = tiles_over(outline, band.angle_deg, block);
      const double        begin  = (tiles.origin - frame.centre).dot(band.direction());
      const double        extent = frame.width + frame.height;
      std::vector<double> edges;
      for (int k = -reach; k <= reach + 1; ++k)
        edges.push_back(band.offset + (k - 0.5) * d);
      const TractionStrips inside = traction_strips(outline, frame, band.angle_deg, edges, 1);

      StripMesh           strips;
      std::vector<double> rows = edges;
      rows.insert(rows.begin(), edges.front() - extent);
      rows.push_back(edges.back() + extent);
      strips.n_blocks = tiles.columns;
      for (const double across : rows)
        for (int b = 0; b <= tiles.columns; ++b)
          strips.mesh.node.emplace_back(frame.centre + (begin + b * tiles.side.x()) * band.direction() + across * band.normal());
      const unsigned int width = unsigned(tiles.columns) + 1;
      for (unsigned int r = 0; r + 1 < rows.size(); ++r)
        for (unsigned int b = 0; b + 1 < width; ++b)
          strips.mesh.cell.push_back({{r * width + b, r * width + b + 1, (r + 1) * width + b + 1, (r + 1) * width + b}});
      triangulate(strips.mesh);
      for (std::size_t k = 0; k < inside.from.size(); ++k)
        {
          strips.counts.emplace_back();
          for (int b = 0; b < tiles.columns; ++b)
            strips.counts.back().push_back(begin + b * tiles.side.x() >= inside.from[k] &&
                                           begin + (b + 1) * tiles.side.x() <= inside.to[k]);
        }
      return strips;
    }

    // The grains of a periodic sample within half a period of its middle, without images. Their seam lies at the sample's sides,
    // where no block counts.
    discrete::Snapshot unrolled(const discrete::Snapshot &grains)
    {
      discrete::Snapshot copy    = grains;
      GrainNetwork       network = grain_network(grains);
      copy.position              = std::move(network.position);
      copy.window_forces         = std::move(network.forces);
      copy.contacts              = std::move(network.contacts);
      copy.cell_width            = 0;
      copy.cell_vectors.setZero();
      return copy;
    }

    // Rows of a matrix of ProfileBlocks: value(cell) where the block counts, without the blocks that count in no strip.
    template <class Value> Eigen::MatrixXd blocks_of(const StripMesh &strips, Value &&value)
    {
      Eigen::MatrixXd matrix(Eigen::Index(strips.counts.size()), strips.n_blocks);
      Eigen::Index    used = 0;
      for (int b = 0; b < strips.n_blocks; ++b)
        {
          bool counts = false;
          for (int k = 0; k < int(strips.counts.size()); ++k)
            {
              const bool has_value = strips.counts[std::size_t(k)][std::size_t(b)];
              matrix(k, used)      = has_value ? value(strips.cell(k, b)) : NAN;
              counts               = counts || has_value;
            }
          used += counts;
        }
      return matrix.leftCols(used);
    }

    std::vector<double> distances()
    {
      std::vector<double> middles;
      for (int k = -reach; k <= reach; ++k)
        middles.push_back(k);
      return middles;
    }

    // -1 or 1: factor that makes anticlockwise rotations positive in the sense of the band's shear.
    double sense(const Band &band)
    {
      return band.jump > 0 ? -1 : 1;
    }

    ProfileBlocks blocks_of(const StripMesh &strips, const Band &band, const GrainFields &f, const double velocity_unit)
    {
      const double turn = sense(band);
      return {
        distances(),
        blocks_of(strips, [&](const std::size_t c) { return turn * f.relative_rotation[c]; }),
        blocks_of(strips, [&](const std::size_t c) { return turn * f.spin_increment[c]; }),
        blocks_of(strips, [&](const std::size_t c) { return turn * f.couple_stress[c].dot(band.normal()); }),
        blocks_of(strips, [&](const std::size_t c) { return f.solid_fraction[c]; }),
        blocks_of(strips, [&](const std::size_t c) { return 2 * f.granular_temperature[c] / (velocity_unit * velocity_unit); })};
    }

    ProfileBlocks blocks_of(const StripMesh       &strips,
                            const Band            &band,
                            const LocalMotion     &m,
                            const ContinuumFields &f,
                            const double           start_solid_fraction)
    {
      const double turn = sense(band);
      return {distances(),
              blocks_of(strips, [&](const std::size_t c) { return turn * m.relative_rotation[c]; }),
              blocks_of(strips, [&](const std::size_t c) { return turn * m.spin[c]; }),
              blocks_of(strips,
                        [&](const std::size_t c) {
                          return std::isnan(m.relative_rotation[c]) ? NAN : turn * f.couple_stress[c].dot(band.normal());
                        }),
              blocks_of(strips, [&](const std::size_t c) { return start_solid_fraction * f.volume_ratio[c]; }),
              blocks_of(strips, [&](const std::size_t) { return NAN; })};
    }
  } // namespace

  void add_profiles(const StagePair         &pair,
                    const ComparisonOptions &options,
                    const double             start_solid_fraction,
                    const std::uint64_t      seed,
                    Increment               &increment)
  {
    const std::vector<Band> &of_grains = increment.discrete.band.bands, &of_nodes = increment.continuum.band.bands;
    if (of_grains.empty() && of_nodes.empty())
      return;
    const double           d       = increment.frame.mean_diameter;
    const auto             outline = outline_polygon(pair.grains_to.outline);
    const BootstrapOptions bootstrap{options.probes.probe_block * d, options.probes.probe_resamples, seed};
    const BootstrapOptions none{bootstrap.block, 0, seed}; // nothing is random in the continuum
    const auto             finished = [&](const ProfileBlocks &blocks, const Band &band, const BootstrapOptions &resampling) {
      BandProfile profile = band_profile(blocks, band.half_width / d, resampling);
      profile.angle_deg   = band.angle_deg;
      profile.offset      = band.offset;
      return profile;
    };

    const Band     &first      = of_grains.empty() ? of_nodes[0] : of_grains[0];
    const StripMesh strips     = strip_mesh(outline, increment.frame, first, bootstrap.block);
    const auto      grains     = grain_fields(strips.mesh, pair.grains_from, unrolled(pair.grains_to), options.averaging);
    const double    speed      = increment.duration > 0 ? increment.displacement_unit / increment.duration : NAN;
    increment.discrete.profile = finished(blocks_of(strips, first, grains, speed), first, bootstrap);

    const Band           &second   = of_nodes.empty() ? first : of_nodes[0];
    const StripMesh       across   = strip_mesh(outline, increment.frame, second, bootstrap.block);
    const ContinuumFields own      = continuum_fields(pair.nodes_from, pair.nodes_to);
    const ContinuumFields averaged = averaged_continuum({increment.mesh, own}, across.mesh, {d, 0}, options.averaging);
    const LocalMotion     moved    = local_motion(increment.continuum.field, cell_centres(across.mesh), strain_radius(d));
    increment.continuum.profile    = finished(blocks_of(across, second, moved, averaged, start_solid_fraction), second, none);
  }
} // namespace diptych::coupling
