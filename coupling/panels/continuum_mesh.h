// diptych: the sample and the meshes of the continuum panel
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
  // One run of the continuum panel, with a separate folder.
  struct ContinuumPart
  {
    std::string name;             // name of its facts and of its phase in provenance.json
    std::string title;            // text for messages
    std::string directory;        // folder of its files
    double      element_size = 0; // [mean diameters]
    double      edge         = 0; // of its elements before refinement [length]
    bool        is_coarse    = false;

    std::string checkpoint() const { return continuum_checkpoint(directory); }
  };

  // The runs on the scene's mesh and on the coarse mesh. There is no coarse run for a mesh file, or for a rectangle that is too
  // small for it.
  std::vector<ContinuumPart> continuum_parts(const Scene &scene);

  // Size of the elements before refinement [length]. refinement = adaptive divides them down to the element size [mean
  // diameters].
  double first_edge(const continuum::Options &options, double element_size, double mean_diameter);

  // The prepared grain sample with the forces that carry it. Empty, with a message, if it does not come to rest or the
  // preparation is interrupted.
  std::optional<discrete::Snapshot> prepared_grains(const Scene &scene, bool quiet);

  // Area of the grains over that of their outline.
  double solid_fraction(const discrete::Snapshot &grains);

  // Reads a .msh or .geo file. Throws std::invalid_argument with the file's name, or StoppedOnRequest.
  continuum::QuadMesh users_mesh(const std::string &file);

  // The mesh of a part with elements of `edge`. `grains` is used only if continuum/mesh = outline.
  continuum::QuadMesh mesh_of(const continuum::Options &options, double edge, const discrete::Snapshot *grains);

  // Hash of the places and connections of all vertices. A checkpoint must have the same one, bit by bit.
  std::string identity_of(const continuum::QuadMesh &mesh);
} // namespace diptych::coupling
