// diptych: the observables of one run, by which grains and continuum are compared
// SPDX-License-Identifier: LGPL-2.1-or-later
#include "coupling/calibration/observation.h"

#include <algorithm>
#include <stdexcept>

#include "coupling/bands/band_detection.h"
#include "coupling/comparison/increment.h"
#include "coupling/ensembles/ensemble.h"
#include "coupling/store/results.h"
#include "coupling/scene/scene.h"

namespace diptych::coupling
{
  namespace
  {
    const char *column_of(const ObservableKind kind)
    {
      return kind == ObservableKind::stress_ratio ? "stress_ratio" : "volumetric_strain";
    }

    // Everything but the bands.
    Observation of_history(const Scene &scene, const std::vector<Observable> &observables, const HistoryTable &history)
    {
      Observation o;
      o.values = Eigen::VectorXd::Constant(Eigen::Index(observables.size()), NAN);
      if (history.empty() || column(history, "progress").empty())
        return o;
      const double end = column(history, "progress").back();
      for (std::size_t k = 0; k < observables.size(); ++k)
        if (const Observable &one = observables[k]; one.kind != ObservableKind::ln_width && !is_beyond(one.to, end))
          o.values[Eigen::Index(k)] = mean_over_progress(history, column_of(one.kind), one.from, one.to);
      o.peak_stress_ratio = peak_of_running_mean(history, "stress_ratio", averaging_width(scene)).value;
      const double last = std::min(end, scene.loading.axial_strain), width = last / curve_points;
      for (int k = 1; k <= curve_points; ++k)
        {
          const double to = k * width;
          o.progress.push_back(to - 0.5 * width);
          o.stress_ratio.push_back(mean_over_progress(history, "stress_ratio", to - width, to));
          o.volumetric_strain.push_back(mean_over_progress(history, "volumetric_strain", to - width, to));
        }
      return o;
    }

    BandOptions without_intervals(BandOptions options)
    {
      options.resamples = 0;
      return options;
    }

    // Adds the band of every window; find(from, to, index of the window) returns its bands.
    template <class Snapshot, class Find>
    void add_bands(const Scene                   &scene,
                   const std::vector<Observable> &observables,
                   const std::vector<Snapshot>   &snapshots,
                   const Find                    &find,
                   Observation                   &o)
    {
      std::size_t window = 0;
      for (std::size_t k = 0; k < observables.size(); ++k)
        {
          if (observables[k].kind != ObservableKind::ln_width)
            continue;
          const auto from = snapshot_at(snapshots, observables[k].from), to = snapshot_at(snapshots, observables[k].to);
          if (from && to)
            if (const std::vector<Band> bands = find(snapshots[*from], snapshots[*to], window); !bands.empty())
              {
                o.values[Eigen::Index(k)] = std::log(bands.front().width_10_90 / scene.sample.mean_diameter);
                o.angle_deg = is_mirror_symmetric(scene) ? std::abs(bands.front().angle_deg) : bands.front().angle_deg;
              }
          ++window;
        }
    }
  } // namespace

  std::vector<Observable> observables_of(const Calibration &calibration, const Scene &scene)
  {
    std::vector<Observable>    observables;
    const std::vector<double> &bins = calibration.bins, &windows = scene.comparison.window_edges;
    for (const ObservableKind kind : calibration.kinds)
      {
        const std::vector<double> &edges = kind == ObservableKind::ln_width ? windows : bins;
        for (std::size_t k = 0; k + 1 < edges.size(); ++k)
          if (!is_beyond(edges[k + 1], scene.loading.axial_strain))
            observables.push_back({kind, edges[k], edges[k + 1]});
      }
    if (observables.empty())
      throw std::invalid_argument("no bin and no window lies within the loading; check bins and comparison/window_edges");
    return observables;
  }

  std::vector<SampleFrame> frames_of(const std::vector<Observable> &observables, const std::vector<discrete::Snapshot> &snapshots)
  {
    std::vector<SampleFrame> frames;
    for (const Observable &one : observables)
      if (one.kind == ObservableKind::ln_width)
        {
          const auto from = snapshot_at(snapshots, one.from), to = snapshot_at(snapshots, one.to);
          if (!from || !to)
            throw std::invalid_argument("an edge of comparison/window_edges is not a stage of the grains");
          frames.push_back(sample_frame(snapshots[*from], snapshots[*to]));
        }
    return frames;
  }

  Observation observe(const Scene                           &scene,
                      const std::vector<Observable>         &observables,
                      const HistoryTable                    &history,
                      const std::vector<discrete::Snapshot> &snapshots)
  {
    Observation       o       = of_history(scene, observables, history);
    const BandOptions options = without_intervals(scene.comparison.band);
    const auto        find    = [&](const discrete::Snapshot &from, const discrete::Snapshot &to, std::size_t) {
      return find_bands(displacement_field(from, to), sample_frame(from, to), options).bands;
    };
    add_bands(scene, observables, snapshots, find, o);
    return o;
  }

  Observation observe(const Scene                            &scene,
                      const std::vector<Observable>          &observables,
                      const HistoryTable                     &history,
                      const std::vector<continuum::Snapshot> &snapshots,
                      const std::vector<SampleFrame>         &frames)
  {
    Observation       o       = of_history(scene, observables, history);
    const BandOptions options = without_intervals(scene.comparison.band);
    const auto        find    = [&](const continuum::Snapshot &from, const continuum::Snapshot &to, const std::size_t window) {
      return continuum_increment(from, to, frames.at(window), options, 1).band.bands;
    };
    const bool ran = !history.empty() && o.values.size() > 0;
    add_bands(scene, observables, snapshots, find, o);
    std::size_t window = 0;
    for (std::size_t k = 0; k < observables.size(); ++k)
      if (observables[k].kind == ObservableKind::ln_width)
        {
          double &value = o.values[Eigen::Index(k)];
          if (ran && !std::isfinite(value) && snapshot_at(snapshots, observables[k].to))
            value = std::log(0.5 * frames.at(window).height / scene.sample.mean_diameter);
          ++window;
        }
    return o;
  }
} // namespace diptych::coupling
