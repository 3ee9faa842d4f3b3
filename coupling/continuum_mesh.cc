// diptych: the sample that the continuum panel runs on, and its meshes
// SPDX-License-Identifier: LGPL-2.1-or-later
#include "coupling/continuum_mesh.h"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <iostream>

#include "continuum/mesh.h"
#include "coupling/progress.h"
#include "coupling/stop_signal.h"
#include "discrete/make_snapshot.h"
#include "discrete/output.h"

namespace diptych::coupling
{
  double first_edge(const Scene &scene, const double element_size)
  {
    const double larger = scene.continuum.refinement == "adaptive" ? std::exp2(scene.continuum.refinement_levels) : 1;
    return larger * element_size * scene.sample.mean_diameter;
  }

  namespace
  {
    bool has_coarse(const Scene &scene)
    {
      const continuum::Options &o = scene.continuum;
      if (scene.comparison.coarse_element_size == 0)
        return false;
      if (o.mesh == "rectangle")
        return first_edge(scene, scene.comparison.coarse_element_size) <= std::min(o.rectangle_width, o.rectangle_height);
      return o.mesh == "outline";
    }

    discrete::Snapshot snapshot_of(const discrete::PreparedSample &sample, const double mean_diameter)
    {
      const double          friction = sample.report.friction;
      discrete::StepSetting setting;
      setting.step          = sample.step;
      setting.law           = {friction, friction, 0, 0, friction};
      setting.mean_diameter = mean_diameter;
      return discrete::make_snapshot(sample.state, sample.last_step, {},
                                     discrete::make_reference(sample.state, mean_diameter, 0.), setting);
    }
  } // namespace

  std::vector<ContinuumPart> continuum_parts(const Scene &scene)
  {
    const std::string         &directory = scene.output.directory;
    std::vector<ContinuumPart> parts     = {{"continuum", "continuum panel", directory, scene.continuum.element_size}};
    if (has_coarse(scene))
      parts.push_back(
        {"continuum_coarse", "continuum panel, coarse mesh", directory + "/coarse", scene.comparison.coarse_element_size});
    return parts;
  }

  std::optional<discrete::Snapshot> prepared_grains(const CommandLine &line, const Scene &scene, const bool from_file)
  {
    if (from_file)
      return discrete::read_snapshots(scene.output.directory + "/discrete.h5").front();
    Progress   progress(line.quiet);
    const auto sample = discrete::prepare_sample(scene.sample,
                                                 discrete::preparation_setting(discrete_loading(scene.loading), scene.discrete),
                                                 [&](const int step, const int expected) {
                                                   progress.update("preparing the sample", double(step) / expected);
                                                   return !stop_requested();
                                                 });
    progress.finish();
    if (sample.report.quiet)
      return snapshot_of(sample, scene.sample.mean_diameter);
    std::cerr << "preparing the sample: " << (stop_requested() ? "stopped on request" : "it did not get quiet") << " after "
              << sample.report.steps << " steps (residual " << sample.report.residual << ", unbalanced force "
              << sample.report.unbalanced_force << ")" << std::endl;
    return std::nullopt;
  }

  double solid_fraction(const discrete::Snapshot &grains)
  {
    double area = 0;
    for (const double r : grains.radius)
      area += M_PI * r * r;
    return area / grains.area;
  }

  void write_mesh(const Scene &scene, const ContinuumPart &part, const discrete::Snapshot *grains)
  {
    const continuum::Options &o    = scene.continuum;
    const double              edge = first_edge(scene, part.element_size);
    if (o.mesh == "outline")
      continuum::make_mesh({grains->outline.left, grains->outline.right}, edge, part.mesh());
    else if (o.mesh == "rectangle")
      continuum::make_rectangle_mesh({o.rectangle_width, o.rectangle_height, o.platen_width, edge}, part.mesh());
    else
      continuum::prepare_mesh(o.mesh, part.mesh());
  }
} // namespace diptych::coupling
