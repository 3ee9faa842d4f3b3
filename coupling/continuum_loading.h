// diptych: the grains' loading as the continuum takes it
// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <string>

#include "continuum/loading.h"
#include "coupling/scene.h"

namespace diptych::coupling
{
  // Throws SceneError naming a key that asks for what the continuum panel does not have, and what it has. Reads, but does not
  // write files.
  void require_continuum(const Scene &scene);

  // What the loading must know of the continuum's sample.
  struct ContinuumSample
  {
    double height         = 0; // [length]
    double platen_width   = 0; // of the upper one [length]
    double solid_fraction = 0; // for the weight [-]
  };

  // Height of a mesh that one of continuum/mesh.h's functions wrote, and the width of its upper platen; the solid fraction stays
  // 0. Throws std::runtime_error naming the file.
  ContinuumSample measure_mesh(const std::string &msh_file);

  // The grains' loading on the continuum's sample. Its progress is the axial strain of the scene's stages (modes shear and
  // plane_shear: travel / height, mode time: the time); walls that move as times say are at time = progress / strain rate.
  continuum::Loading continuum_loading(const Scene &scene, const ContinuumSample &sample);
} // namespace diptych::coupling
