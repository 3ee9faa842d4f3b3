// diptych: the continuum's counterpart of the grains' loading
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
  // Throws SceneError if the continuum panel has no counterpart of a key's value. The message names the key and what is allowed.
  // Reads files, but writes none.
  void require_continuum(const Scene &scene);

  double height_of(const discrete::Outline &outline);

  void require_elements_fit(const Scene &scene, double height);

  // Throws SceneError if the upper platen rests during a whole stage, because its displacement is the unit of both panels'
  // displacements.
  void require_platen_travel(const Scene &scene);

  struct ContinuumSample
  {
    double height         = 0; // [length]
    double platen_width   = 0; // width of the upper platen [length]
    double solid_fraction = 0; // for the weight [-]
  };

  ContinuumSample measured(const continuum::QuadMesh &mesh, double solid_fraction);

  // The grains' loading applied to the continuum's sample, along the same progress: axial strain, shear strain or time. Walls
  // that follow a time table use time = progress / strain rate.
  continuum::Loading continuum_loading(const Scene &scene, const ContinuumSample &sample);
} // namespace diptych::coupling
