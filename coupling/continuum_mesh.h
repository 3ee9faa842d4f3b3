// diptych: the sample that the continuum panel runs on, and its meshes
// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "coupling/commands.h"
#include "coupling/scene.h"
#include "discrete/snapshot.h"

namespace diptych::coupling
{
  // One run of the continuum panel, in a folder of its own.
  struct ContinuumPart
  {
    std::string name;             // of its facts and its phase in provenance.json
    std::string title;            // for messages
    std::string directory;        // of its files, sample.msh and continuum_checkpoint.h5 among them
    double      element_size = 0; // [mean diameters]

    std::string mesh() const { return directory + "/sample.msh"; }
    std::string checkpoint() const { return directory + "/continuum_checkpoint.h5"; }
  };

  // The run on the scene's mesh and the one on the coarse mesh. A mesh of the user's has no coarse one, nor has a rectangle that
  // is too small for it.
  std::vector<ContinuumPart> continuum_parts(const Scene &scene);

  // Elements of the first mesh [length]; refinement = adaptive divides them down to the element size [mean diameters].
  double first_edge(const Scene &scene, double element_size);

  // The prepared grain sample with the forces that carry it: stage 0 of discrete.h5, or prepared again. Nothing, with a message,
  // where it does not get quiet or the preparation is interrupted.
  std::optional<discrete::Snapshot> prepared_grains(const CommandLine &line, const Scene &scene, bool from_file);

  // Area of the grains over that of their outline.
  double solid_fraction(const discrete::Snapshot &grains);

  // Writes part.mesh(). `grains` is not looked at unless continuum/mesh = outline.
  void write_mesh(const Scene &scene, const ContinuumPart &part, const discrete::Snapshot *grains);
} // namespace diptych::coupling
