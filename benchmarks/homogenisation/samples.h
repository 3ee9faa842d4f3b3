// diptych: sheared samples and their meshes
// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <string>
#include <vector>

#include "coupling/cells/mesh_cells.h"
#include "discrete/snapshot.h"

namespace diptych::benchmarks
{
  // Default sample (4000 discs, radii 0.3 to 0.7 d, width/height 0.7, seed 1) under a 45 degree loading with free end grains,
  // I = 1e-4, step 0.5: snapshots at 0, 2, 2.5, 3, 3.5 and 4 % axial strain, with the mean forces in between. If `folder` is
  // not empty, keeps the sample there and reads it at the next call. Throws std::runtime_error if the run does not converge.
  std::vector<discrete::Snapshot> sheared_sample(const std::string &folder);

  // A mesh of columns x rows quadrilaterals between the sides of a sample's outline and its platens.
  coupling::QuadMesh outline_mesh(const discrete::Outline &outline, unsigned int columns, unsigned int rows);

  // n x n copies of the sample side by side. Copies do not touch.
  discrete::Snapshot copies(const discrete::Snapshot &sample, int n);
} // namespace diptych::benchmarks
