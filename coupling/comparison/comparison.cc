// diptych: both panels at the same instants, seen through the same operators
// SPDX-License-Identifier: LGPL-2.1-or-later
#include "coupling/comparison/comparison.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "continuum/output.h"
#include "coupling/statistics/batch_means.h"
#include "discrete/output.h"

namespace diptych::coupling
{
  namespace
  {
    StagePair stage_pair(const Comparison &c, const std::size_t from, const std::size_t to)
    {
      return {c.grains[from], c.grains[to], c.nodes[from], c.nodes[to]};
    }

    void take_averages(const HistoryTable &history, const double to, const double averaging_strain, PanelRecord &record)
    {
      const auto mean           = [&](const char *name) { return mean_over_strain(history, name, to - averaging_strain, to); };
      record.stress_ratio.value = mean("stress_ratio");
      record.volumetric_strain  = mean_over_strain(history, "volumetric_strain", to, to);
      record.lower_force        = {mean("lower_fx"), mean("lower_fy")};
      record.upper_force        = {mean("upper_fx"), mean("upper_fy")};
    }

    StageRecord make_stage(const Comparison &c, const std::size_t k, const Scene &scene)
    {
      const StagePair pair  = stage_pair(c, k - 1, k);
      const double    width = averaging_width(scene);
      StageRecord     stage = stage_record(make_increment(pair, scene.comparison.band, std::uint64_t(scene.sample.seed)), pair,
                                           scene);
      take_averages(c.discrete_history, stage.axial_strain, width, stage.discrete);
      take_averages(c.continuum_history, stage.axial_strain, width, stage.continuum);
      stage.discrete.stress_ratio = mean_interval_over_strain(c.discrete_history, "stress_ratio", stage.axial_strain - width,
                                                              stage.axial_strain);
      return stage;
    }

    // Stress against the averaging length, at the centres of the last stage's probes.
    ResolutionStudy study_of(const Comparison &c, const ComparisonOptions &options)
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
      return resolution_study(c.stages.back().fields.mesh, c.grains.back(), points, options.averaging.kernel);
    }

    // Index of the stage at an axial strain; -1 if it was not reached.
    int stage_at(const Comparison &c, const double strain)
    {
      for (std::size_t k = 0; k < c.grains.size(); ++k)
        if (std::abs(c.grains[k].axial_strain - strain) < 1e-6)
          return int(k);
      return -1;
    }

    CoarseRun coarse_run(const Scene &scene, const Comparison &c, const std::string &directory)
    {
      CoarseRun result;
      result.element_size = scene.comparison.coarse_element_size;
      result.peak = peak_of_running_mean(read_history(directory + "/continuum.csv"), "stress_ratio", averaging_width(scene));
      const std::vector<continuum::Snapshot> nodes = continuum::read_snapshots(directory + "/continuum.h5");
      for (const Increment &window : c.windows)
        {
          const int from = stage_at(c, window.from), to = stage_at(c, window.to);
          if (to >= int(nodes.size()))
            break;
          Increment coarse;
          coarse.from = window.from, coarse.to = window.to, coarse.frame = window.frame;
          coarse.continuum = continuum_increment(nodes[from], nodes[to], window.frame, scene.comparison.band,
                                                 std::uint64_t(scene.sample.seed));
          result.windows.push_back(std::move(coarse));
        }
      return result;
    }

    // In the place of the axial strain, where the stages of the loading are something else: grains and continuum are compared at
    // the same progress.
    void count_by_progress(const LoadingOptions &loading, Comparison &c)
    {
      if (loading.mode == "descent")
        return;
      const bool time                    = loading.mode == "time";
      c.discrete_history["axial_strain"] = column(c.discrete_history, time ? "time" : "shear_strain");
      for (discrete::Snapshot &grains : c.grains)
        grains.axial_strain = time ? grains.time : grains.shear_strain;
    }
  } // namespace

  Comparison compare(const Scene &scene, const std::string &directory)
  {
    Comparison c;
    c.discrete_history  = read_history(directory + "/discrete.csv");
    c.continuum_history = read_history(directory + "/continuum.csv");
    c.grains            = discrete::read_snapshots(directory + "/discrete.h5");
    c.nodes             = continuum::read_snapshots(directory + "/continuum.h5");
    count_by_progress(scene.loading, c);
    // A panel that ended early leaves its last instant behind, which is no stage of the other.
    std::size_t n = 0;
    while (n < std::min(c.grains.size(), c.nodes.size()) && std::abs(c.grains[n].axial_strain - c.nodes[n].axial_strain) < 1e-6)
      ++n;
    if (n < 2)
      throw std::runtime_error(directory + ": discrete.h5 (" + std::to_string(c.grains.size()) + " stages) and continuum.h5 (" +
                               std::to_string(c.nodes.size()) + ") share no stage beyond the start");
    c.grains.resize(n), c.nodes.resize(n);
    for (std::size_t k = 1; k < n; ++k)
      c.stages.push_back(make_stage(c, k, scene));
    const std::vector<double> &edges = scene.comparison.window_edges;
    for (std::size_t w = 0; w + 1 < edges.size(); ++w)
      if (const int from = stage_at(c, edges[w]), to = stage_at(c, edges[w + 1]); from >= 0 && to >= 0)
        c.windows.push_back(make_increment(stage_pair(c, from, to), scene.comparison.band, std::uint64_t(scene.sample.seed)));
    c.coarse             = coarse_run(scene, c, directory + "/coarse");
    c.resolution         = study_of(c, scene.comparison);
    const auto &material = scene.continuum.material;
    if (scene.continuum.law != "linear_elastic")
      c.theory = theory_lines(material.friction_angle_peak, material.dilatancy_angle_peak);
    return c;
  }
} // namespace diptych::coupling
