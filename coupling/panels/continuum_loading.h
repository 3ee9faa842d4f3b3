// diptych: the grains' loading as the continuum takes it
// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <string>

#include "continuum/loading.h"
#include "continuum/mesh/quad_mesh.h"
#include "coupling/scene/scene.h"
#include "coupling/scene/scene_error.h"
#include "discrete/snapshot.h"

namespace diptych::coupling
{
  // Throws SceneError naming a key that asks for what the continuum panel does not have, and what it has. Reads, but does not
  // write files.
  void require_continuum(const Scene &scene);

  double height_of(const discrete::Outline &outline);

  // Throws SceneError where elements that the scene asks for are larger than that [length].
  void require_elements_fit(const Scene &scene, double height);

  // Throws SceneError where the scene leaves the upper platen where it is over a whole stage: the two panels' displacements are
  // compared in units of its way.
  void require_platen_travel(const Scene &scene);

  // What the loading must know of the continuum's sample.
  struct ContinuumSample
  {
    double height         = 0; // [length]
    double platen_width   = 0; // of the upper one [length]
    double solid_fraction = 0; // for the weight [-]
  };

  // Height of a mesh and width of its upper platen.
  ContinuumSample measured(const continuum::QuadMesh &mesh, double solid_fraction);

  // The grains' loading on the continuum's sample, along the same progress: axial strain, shear strain or time; walls that move
  // as times say are at time = progress / strain rate.
  continuum::Loading continuum_loading(const Scene &scene, const ContinuumSample &sample);
} // namespace diptych::coupling
