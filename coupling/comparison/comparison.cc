// diptych: comparison of both panels at the same instants, with the same operators
// SPDX-License-Identifier: LGPL-2.1-or-later
#include "coupling/comparison/comparison.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "coupling/averaging/periodic.h"
#include "coupling/cells/principal_axes.h"
#include "coupling/comparison/increment_profiles.h"
#include "coupling/statistics/batch_means.h"

namespace diptych::coupling
{
  namespace
  {

    // A panel that ended early stores its last instant, which is not a stage of the other panel.
    std::size_t n_common_snapshots(const Results &results)
    {
      const auto &grains = results.discrete.snapshots;
      const auto &nodes  = results.continuum.snapshots;
      std::size_t n      = 0;
      while (n < std::min(grains.size(), nodes.size()) && std::abs(grains[n].progress - nodes[n].progress) < same_progress)
        ++n;
      if (n < 2)
        throw std::invalid_argument("the grains (" + std::to_string(grains.size()) + " snapshots) and the continuum (" +
                                    std::to_string(nodes.size()) + ") share no stage beyond the start");
      return n;
    }

    StagePair stage_pair(const Results &r, const std::size_t from, const std::size_t to)
    {
      return {r.discrete.snapshots[from], r.discrete.snapshots[to], r.continuum.snapshots[from], r.continuum.snapshots[to]};
    }

    void take_averages(const HistoryTable &history, const double to, const double width, PanelRecord &record)
    {
      const auto mean           = [&](const char *name) { return mean_over_progress(history, name, to - width, to); };
      record.stress_ratio.value = mean("stress_ratio");
      record.volumetric_strain  = mean_over_progress(history, "volumetric_strain", to, to);
      record.lower_force        = {mean("lower_fx"), mean("lower_fy")};
      record.upper_force        = {mean("upper_fx"), mean("upper_fy")};
    }

    void take_differences(StageRecord &stage)
    {
      const double   continuum = stage.continuum.stress_ratio.value;
      const Interval exact{continuum, continuum, continuum}; // exact, apart from errors of mesh and step
      stage.stress_ratio_difference      = difference_of(stage.discrete.stress_ratio, exact);
      stage.volumetric_strain_difference = stage.continuum.volumetric_strain - stage.discrete.volumetric_strain;
      stage.band_difference              = band_difference(stage.increment);
    }

    struct Settings
    {
      const ComparisonOptions &options;
      std::uint64_t            seed;
      double                   averaging_width; // range of progress
      bool                     is_mirror_symmetric;
      double                   start_solid_fraction; // of the grains inside the sample
    };

    Increment increment_of(const StagePair &pair, const Settings &settings)
    {
      Increment increment           = make_increment(pair, settings.options.band, settings.seed);
      increment.is_mirror_symmetric = settings.is_mirror_symmetric;
      add_profiles(pair, settings.options, settings.start_solid_fraction, settings.seed, increment);
      return increment;
    }

    StageRecord make_stage(const Comparison &c, const Results &results, const std::size_t k, const Settings &settings)
    {
      const StagePair pair  = stage_pair(results, k - 1, k);
      const double    width = settings.averaging_width;
      StageRecord     stage = stage_record(increment_of(pair, settings), pair, settings.options, settings.seed);
      take_averages(c.discrete_history, stage.progress, width, stage.discrete);
      take_averages(c.continuum_history, stage.progress, width, stage.continuum);
      stage.discrete.stress_ratio = mean_interval_over_progress(c.discrete_history, "stress_ratio", stage.progress - width,
                                                                stage.progress);
      take_differences(stage);
      return stage;
    }

    // Direction of the smallest compression in the band's probe, or in the first probe; NaN without probes.
    double minor_direction(const PanelRecord &panel)
    {
      const ProbeRecord *probe = panel.probes.empty() ? nullptr : &panel.probes.front();
      for (const ProbeRecord &one : panel.probes)
        if (one.region.is_zone)
          probe = &one;
      return probe == nullptr ? NAN : probe->stress.direction_deg + 90;
    }

    // Sets the angle of the theory lines: between a band and the minor principal stress, in [0, 90]. A diffuse zone gets none.
    void take_angles_to_stress(std::vector<Band> &bands, const PanelRecord &at_the_end)
    {
      for (Band &band : bands)
        if (!band.is_diffuse)
          {
            const double    turn  = line_turn(band.angle_deg, minor_direction(at_the_end));
            const Interval &angle = band.interval.angle_deg;
            const double    low = std::abs(turn + angle.low - angle.value), high = std::abs(turn + angle.high - angle.value);
            band.to_minor_stress_deg = {std::abs(turn), std::min(low, high), std::max(low, high)};
          }
    }

    void take_angles_to_stress(Increment &increment, const StageRecord &at_the_end)
    {
      take_angles_to_stress(increment.discrete.band.bands, at_the_end.discrete);
      take_angles_to_stress(increment.continuum.band.bands, at_the_end.continuum);
    }

    // Stress over the averaging length, at the centres of the last stage's probes.
    ResolutionStudy study_of(const Comparison &c, const discrete::Snapshot &grains, const ComparisonOptions &options)
    {
      std::vector<StudyPoint> points;
      for (const ProbeRecord &probe : c.stages.back().discrete.probes)
        if (!probe.region.polygon.empty())
          {
            Eigen::Vector2d centre = Eigen::Vector2d::Zero();
            for (const Eigen::Vector2d &x : probe.region.polygon)
              centre += x / double(probe.region.polygon.size());
            points.push_back({probe.region.name, centre});
          }
      return resolution_study(c.stages.back().fields.mesh, grains, points, options.averaging.kernel);
    }

    // The pieces of work: stages, windows, the coarse run's windows and the final part.
    class Pieces
    {
    public:
      Pieces(const OnProgress &on_progress, const std::size_t n)
          : on_progress(on_progress),
            n(double(n))
      {}
      void next()
      {
        if (on_progress)
          on_progress(std::min(1., done++ / n));
      }

    private:
      const OnProgress &on_progress;
      double            n, done = 0;
    };

    void make_windows(const Settings &settings, const Results &results, const std::size_t n, Pieces &pieces, Comparison &c)
    {
      const std::vector<double>             &edges  = settings.options.window_edges;
      const std::vector<discrete::Snapshot> &grains = results.discrete.snapshots;
      for (std::size_t w = 0; w + 1 < edges.size(); ++w, pieces.next())
        {
          const auto from = snapshot_at(grains, edges[w]), to = snapshot_at(grains, edges[w + 1]);
          if (!from || !to || *from >= n || *to >= n)
            continue;
          c.windows.push_back(increment_of(stage_pair(results, *from, *to), settings));
          if (*to > 0)
            take_angles_to_stress(c.windows.back(), c.stages[*to - 1]);
        }
    }

    void compare_platens(const Results &results, const std::size_t n, const bool is_mirror_symmetric, Comparison &c)
    {
      const int                n_parts = is_mirror_symmetric ? 5 : 10; // ten along a platen: wider than elements and grains
      std::vector<PlatenParts> grains, nodes;
      for (std::size_t k = 1; k < n; ++k)
        {
          const StagePair pair   = stage_pair(results, k - 1, k);
          const double    travel = c.stages[k - 1].increment.frame.platen_increment.x();
          grains.push_back(platen_parts(platen_contacts(pair.grains_from, pair.grains_to), is_mirror_symmetric, n_parts));
          nodes.push_back(platen_parts(platen_contacts(pair.nodes_from, pair.nodes_to, travel), is_mirror_symmetric, n_parts));
        }
      c.discrete.platens  = platen_friction(grains);
      c.discrete_platens  = sum_of(grains);
      c.continuum_platens = sum_of(nodes);
    }

    std::optional<CoarseRun> coarse_run(const Settings               &settings,
                                        const Results                &results,
                                        const std::vector<Increment> &windows,
                                        Pieces                       &pieces)
    {
      const std::vector<continuum::Snapshot> &nodes = results.coarse.snapshots;
      CoarseRun                               result;
      result.element_size = settings.options.coarse_element_size;
      if (nodes.empty())
        return std::nullopt;
      result.peak = peak_of_running_mean(history_table(results.coarse.rows), "stress_ratio", settings.averaging_width);
      for (const Increment &window : windows)
        {
          const std::size_t from = snapshot_at(results.discrete.snapshots, window.from).value();
          const std::size_t to   = snapshot_at(results.discrete.snapshots, window.to).value();
          if (to >= nodes.size())
            break;
          pieces.next();
          Increment coarse;
          coarse.from      = window.from;
          coarse.to        = window.to;
          coarse.frame     = window.frame;
          coarse.continuum = continuum_increment(nodes[from], nodes[to], window.frame, settings.options.band, settings.seed);
          result.windows.push_back(std::move(coarse));
        }
      return result;
    }
  } // namespace

  Comparison compare(const Scene &scene, const Results &results, const OnProgress &on_progress)
  {
    const std::size_t n = n_common_snapshots(results);
    const Settings    settings{
      scene.comparison, std::uint64_t(scene.sample.seed), averaging_width(scene), is_mirror_symmetric(scene),
      grain_cover(quad_mesh(results.continuum.snapshots.front()), results.discrete.snapshots.front()).typical_solid_fraction};
    Pieces     pieces(on_progress, n + 2 * scene.comparison.window_edges.size());
    Comparison c;
    c.discrete_history  = history_table(results.discrete.rows);
    c.continuum_history = history_table(results.continuum.rows);
    for (std::size_t k = 1; k < n; ++k)
      {
        pieces.next();
        c.stages.push_back(make_stage(c, results, k, settings));
        take_angles_to_stress(c.stages.back().increment, c.stages.back());
      }
    make_windows(settings, results, n, pieces, c);
    c.coarse = coarse_run(settings, results, c.windows, pieces);
    pieces.next();
    c.resolution         = study_of(c, results.discrete.snapshots[n - 1], scene.comparison);
    const auto &material = scene.continuum.material;
    const auto  unused   = continuum::unused_keys(scene.continuum);
    if (std::none_of(unused.begin(), unused.end(), [](const auto &one) { return one.key == "friction_angle_peak"; }))
      c.theory = theory_lines(material.friction_angle_peak, material.dilatancy_angle_peak);
    c.discrete = summary_of(scene, results.discrete, results.discrete.snapshots[n - 1], c.discrete_history);
    if (scene.loading.mode != discrete::LoadingMode::time)
      compare_platens(results, n, settings.is_mirror_symmetric, c);
    c.discrete.platens.slip_length = times(1 / scene.sample.mean_diameter, c.discrete.platens.slip_length);
    c.continuum                    = summary_of(scene, results.continuum, c.continuum_history);
    c.cost                         = summary_of(results.phases);
    return c;
  }
} // namespace diptych::coupling
