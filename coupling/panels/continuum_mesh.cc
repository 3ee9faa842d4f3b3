// diptych: the sample and the meshes of the continuum panel
// SPDX-License-Identifier: LGPL-2.1-or-later
#include "coupling/panels/continuum_mesh.h"

#include <algorithm>
#include <cmath>
#include <iostream>

#include "continuum/mesh/mesh.h"
#include "coupling/grains/imported_grains.h"
#include "coupling/processes/progress.h"
#include "coupling/processes/stop_signal.h"
#include "coupling/store/file_names.h"
#include "coupling/scene/identity.h"
#include "discrete/panel/panel.h"

namespace diptych::coupling
{
  double first_edge(const continuum::Options &o, const double element_size, const double mean_diameter)
  {
    const double larger = o.refinement == continuum::Refinement::adaptive ? std::exp2(o.refinement_levels) : 1;
    return larger * element_size * mean_diameter;
  }

  std::vector<ContinuumPart> continuum_parts(const Scene &scene)
  {
    using Kind                        = continuum::MeshOption::Kind;
    const continuum::Options  &o      = scene.continuum;
    const std::string         &folder = scene.output.directory;
    const double               coarse = scene.comparison.coarse_element_size;
    const auto                 edge   = [&](const double size) { return first_edge(o, size, scene.sample.mean_diameter); };
    const bool                 fits   = edge(coarse) <= std::min(o.rectangle_width, o.rectangle_height);
    std::vector<ContinuumPart> parts  = {{"continuum", "continuum panel", folder, o.element_size, edge(o.element_size)}};
    if (coarse > 0 && (o.mesh.kind == Kind::outline || (o.mesh.kind == Kind::rectangle && fits)))
      parts.push_back({"continuum_coarse", "continuum panel, coarse mesh", coarse_folder(folder), coarse, edge(coarse), true});
    return parts;
  }

  std::optional<discrete::Snapshot> prepared_grains(const Scene &scene, const bool quiet)
  {
    if (scene.discrete.method.method == discrete::Method::imported)
      return load_imported(scene).snapshots.front();
    Progress        progress(quiet);
    discrete::Hooks hooks;
    hooks.stop_requested = stop_requested;
    hooks.on_progress    = [&](const std::string &phase, const double fraction) { progress.update(phase, fraction); };
    discrete::Panel panel(scene.sample, discrete_loading(scene.loading), scene.discrete, hooks);
    const bool      quieted = panel.prepare() == discrete::Status::finished;
    progress.finish(quieted);
    if (quieted)
      return panel.snapshot();
    std::cerr << "preparing the sample: " << (stop_requested() ? "stopped on request" : panel.report().message) << std::endl;
    return std::nullopt;
  }

  double solid_fraction(const discrete::Snapshot &grains)
  {
    double area = 0;
    for (const double r : grains.radius)
      area += M_PI * r * r;
    return area / grains.area;
  }

  continuum::QuadMesh users_mesh(const std::string &file)
  {
    return continuum::read_mesh(file, [&] { leave_if_stopped("making the mesh of " + file); });
  }

  continuum::QuadMesh mesh_of(const continuum::Options &o, const double edge, const discrete::Snapshot *grains)
  {
    switch (o.mesh.kind)
      {
      case continuum::MeshOption::Kind::outline:
        return continuum::outline_mesh({grains->outline.left, grains->outline.right}, edge,
                                       [] { leave_if_stopped("making the mesh"); });
        case continuum::MeshOption::Kind::rectangle: {
          continuum::Rectangle rectangle;
          rectangle.width        = o.rectangle_width;
          rectangle.height       = o.rectangle_height;
          rectangle.platen_width = o.platen_width;
          rectangle.element_size = edge;
          return continuum::rectangle_mesh(rectangle);
        }
      case continuum::MeshOption::Kind::file:
        break;
      }
    return users_mesh(o.mesh.file);
  }

  std::string identity_of(const continuum::QuadMesh &mesh)
  {
    std::uint64_t digest = empty_digest;
    const auto    add    = [&](const void *bytes, const std::size_t n) {
      digest = digest_on(digest, {static_cast<const char *>(bytes), n});
    };
    for (const Eigen::Vector2d &x : mesh.vertices)
      add(x.data(), sizeof x);
    for (const auto &cell : mesh.cells)
      add(cell.data(), sizeof cell);
    for (const auto &edge : mesh.boundary)
      {
        add(edge.vertices.data(), sizeof edge.vertices);
        add(&edge.id, sizeof edge.id);
      }
    return "mesh " + std::to_string(digest);
  }
} // namespace diptych::coupling
