// diptych: the sample that the continuum panel runs on, and its meshes
// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "continuum/mesh/quad_mesh.h"
#include "coupling/scene/scene.h"
#include "coupling/store/file_names.h"
#include "discrete/snapshot.h"

namespace diptych::coupling
{
  // One run of the continuum panel, in a folder of its own.
  struct ContinuumPart
  {
    std::string name;             // of its facts and its phase in provenance.json
    std::string title;            // for messages
    std::string directory;        // of its files
    double      element_size = 0; // [mean diameters]
    bool        is_coarse    = false;

    std::string checkpoint() const { return continuum_checkpoint(directory); }
  };

  // The run on the scene's mesh and the one on the coarse mesh. A mesh of the user's has no coarse one, nor has a rectangle that
  // is too small for it.
  std::vector<ContinuumPart> continuum_parts(const Scene &scene);

  // Elements of the first mesh [length]; refinement = adaptive divides them down to the element size [mean diameters].
  double first_edge(const Scene &scene, double element_size);

  // The prepared grain sample with the forces that carry it. Nothing, with a message, where it does not get quiet or the
  // preparation is interrupted.
  std::optional<discrete::Snapshot> prepared_grains(const Scene &scene, bool quiet);

  // Area of the grains over that of their outline.
  double solid_fraction(const discrete::Snapshot &grains);

  // A .msh or .geo file. Throws std::invalid_argument naming it, StoppedOnRequest.
  continuum::QuadMesh users_mesh(const std::string &file);

  // The part's mesh. `grains` is not looked at unless continuum/mesh = outline.
  continuum::QuadMesh mesh_of(const Scene &scene, const ContinuumPart &part, const discrete::Snapshot *grains);

  // What a checkpoint must agree on: places and connections of all vertices, bit by bit.
  std::string identity_of(const continuum::QuadMesh &mesh);
} // namespace diptych::coupling
