// diptych: both panels at the same instants, seen through the same operators
// SPDX-License-Identifier: LGPL-2.1-or-later
#include "coupling/comparison.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "continuum/output.h"
#include "coupling/homogenisation/periodic.h"
#include "discrete/output.h"

namespace diptych::coupling
{
  namespace
  {
    SampleFrame make_frame(const discrete::Snapshot &from, const discrete::Snapshot &to)
    {
      Eigen::Vector2d low = to.outline.left.front(), high = to.outline.right.front();
      for (const auto *side : {&to.outline.left, &to.outline.right})
        for (const Eigen::Vector2d &x : *side)
          low = low.cwiseMin(x), high = high.cwiseMax(x);
      SampleFrame frame;
      frame.centre           = 0.5 * (low + high);
      frame.width            = high.x() - low.x();
      frame.height           = high.y() - low.y();
      frame.mean_diameter    = to.mean_diameter;
      frame.platen_increment = to.upper_platen_displacement - from.upper_platen_displacement;
      return frame;
    }

    std::vector<Eigen::Vector2d> cell_centres(const QuadMesh &mesh)
    {
      std::vector<Eigen::Vector2d> centres;
      for (unsigned int k = 0; k < mesh.cell.size(); ++k)
        centres.push_back(cell_centre(mesh, k));
      return centres;
    }

    // Both panels' strips lie along the grains' band; where they show none along the continuum's, else along the
    // platen's travel.
    Strips cut_strips(const DisplacementField &field, const Increment &increment)
    {
      const std::vector<Band> &grains = increment.discrete.band.bands, &nodes = increment.continuum.band.bands;
      const Eigen::Vector2d   &travel = increment.frame.platen_increment;
      double                   angle = std::atan2(travel.y(), travel.x()) * 180 / M_PI, offset = 0;
      if (!grains.empty())
        angle = grains[0].angle_deg, offset = grains[0].offset;
      else if (!nodes.empty())
        angle = nodes[0].angle_deg, offset = nodes[0].offset;
      if (angle <= -90)
        angle += 180;
      return strip_means(field, increment.frame, angle, strip_edges(increment.frame, angle, offset));
    }

    Increment make_increment(const Comparison &c, const std::size_t from, const std::size_t to, const BandOptions &options)
    {
      const double radius = strain_radius(c.grains[to].mean_diameter);
      Increment    result;
      result.from            = c.grains[from].axial_strain;
      result.to              = c.grains[to].axial_strain;
      result.frame           = make_frame(c.grains[from], c.grains[to]);
      result.mesh            = quad_mesh(c.nodes[to]);
      result.discrete.field  = displacement_field(c.grains[from], c.grains[to]);
      result.continuum.field = displacement_field(c.nodes[from], c.nodes[to]);
      result.cover           = grain_cover(result.mesh, c.grains[to]);

      const std::vector<Eigen::Vector2d> centres = cell_centres(result.mesh);
      for (PanelIncrement *panel : {&result.discrete, &result.continuum})
        {
          panel->band       = find_bands(panel->field, result.frame, options);
          panel->cell_shear = shear_strain_increment(panel->field, centres, radius);
        }
      for (PanelIncrement *panel : {&result.discrete, &result.continuum})
        panel->strips = cut_strips(panel->field, result);
      for (std::size_t k = 0; k < centres.size(); ++k)
        if (!result.cover.covered[k])
          result.discrete.cell_shear[k] = NAN;
      result.grain_shear = shear_strain_increment(result.discrete.field, result.discrete.field.position, radius);
      return result;
    }

    PanelRecord averages(const HistoryTable &history, const double to, const double averaging_strain)
    {
      const auto  mean = [&](const char *name) { return mean_over_strain(history, name, to - averaging_strain, to); };
      PanelRecord record;
      record.stress_ratio      = mean("stress_ratio");
      record.volumetric_strain = mean_over_strain(history, "volumetric_strain", to, to);
      record.lower_force       = {mean("lower_fx"), mean("lower_fy")};
      record.upper_force       = {mean("upper_fx"), mean("upper_fy")};
      return record;
    }

    // sqrt(sum A |a - b|^2 / sum A |b|^2) of the symmetric parts over the covered cells.
    double relative_difference(const Increment                    &increment,
                               const std::vector<Eigen::Matrix2d> &a,
                               const std::vector<Eigen::Matrix2d> &b)
    {
      const std::vector<double> area       = cell_areas(increment.mesh);
      double                    difference = 0, norm = 0;
      for (std::size_t k = 0; k < area.size(); ++k)
        if (increment.cover.covered[k])
          {
            const Eigen::Matrix2d delta = 0.5 * (a[k] + a[k].transpose()) - b[k];
            difference += area[k] * delta.squaredNorm();
            norm += area[k] * b[k].squaredNorm();
          }
      return norm > 0 ? std::sqrt(difference / norm) : NAN;
    }

    void map_stress(const discrete::Snapshot &grains, const continuum::Snapshot &nodes, StageRecord &stage)
    {
      const QuadMesh     &mesh        = stage.increment.mesh;
      const MappedGrains  by_segments = map_grains(mesh, grains);
      const MappedMoment &mapped      = by_segments.moment;
      stage.nodal_residual            = by_segments.nodal_residual;
      stage.outside_share             = mapped.outside_share;

      Eigen::Matrix2d sum  = Eigen::Matrix2d::Zero();
      double          spin = 0;
      for (std::size_t i = 0; i < grains.position.size(); ++i)
        sum += grains.mean_internal_moment[i], spin += grains.mean_spin_term[i];
      stage.total_relative_error   = total_relative_error(mapped, sum);
      stage.discrete.dynamic_share = spin / (0.5 * sum.trace());
      stage.discrete.cell_stress   = cell_stress(mesh, mapped);
      for (const continuum::CellState &cell : nodes.cell_state)
        stage.continuum.cell_stress.push_back(cell.stress.topLeftCorner<2, 2>());
      stage.stress_difference = relative_difference(stage.increment, stage.discrete.cell_stress, stage.continuum.cell_stress);
      for (std::size_t k = 0; k < mesh.cell.size(); ++k)
        if (!stage.increment.cover.covered[k])
          stage.discrete.cell_stress[k].setConstant(NAN);
    }

    void take_probes(const discrete::Snapshot &grains, const ProbeOptions &options, StageRecord &stage)
    {
      for (const ProbeRegion &region :
           place_probes(outline_polygon(grains.outline), stage.increment.frame, stage.increment.discrete.band.bands, options))
        {
          stage.discrete.probes.push_back(
            {region, grain_probe_stress(region, grains.position, grains.radius, grains.mean_internal_moment),
             probe_fabric(region, grains.contacts)});
          stage.continuum.probes.push_back(
            {region, cell_probe_stress(region, stage.increment.mesh, stage.continuum.cell_stress), {}});
        }
    }

    StageRecord make_stage(const Comparison &c, const std::size_t k, const Scene &scene)
    {
      const ComparisonOptions &options = scene.comparison;
      const double             width   = averaging_width(scene);
      StageRecord              stage;
      stage.axial_strain = c.grains[k].axial_strain;
      stage.increment    = make_increment(c, k - 1, k, options.band);
      stage.discrete     = averages(c.discrete_history, stage.axial_strain, width);
      stage.continuum    = averages(c.continuum_history, stage.axial_strain, width);
      map_stress(c.grains[k], c.nodes[k], stage);
      take_probes(c.grains[k], options.probes, stage);
      return stage;
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
          coarse.continuum.field = displacement_field(nodes[from], nodes[to]);
          coarse.continuum.band  = find_bands(coarse.continuum.field, coarse.frame, scene.comparison.band);
          result.windows.push_back(std::move(coarse));
        }
      return result;
    }
  } // namespace

  namespace
  {
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
        c.windows.push_back(make_increment(c, from, to, scene.comparison.band));
    c.coarse = coarse_run(scene, c, directory + "/coarse");
    return c;
  }
} // namespace diptych::coupling
