// diptych: readers of other codes' files, one per format
// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include "coupling/import/foreign_sample.h"

namespace diptych::coupling
{
  // Files are recognised by their content, in any order. All readers throw SceneError naming the file, its line or dataset,
  // what was found and what was expected. README.md beside this header lists the files and columns of each format.
  ForeignSample read_lammps(const ForeignOptions &options);
  ForeignSample read_liggghts(const ForeignOptions &options);
  ForeignSample read_yade(const ForeignOptions &options);
  ForeignSample read_lmgc90(const ForeignOptions &options); // text and HDF5
  ForeignSample read_mercurydpm(const ForeignOptions &options);
  ForeignSample read_plain_csv(const ForeignOptions &options);

  // Reads VTKRecorder's .vtu of spheres and .vtp of interactions, in pairs. These files lack the direction of tangential forces
  // and all wall contacts.
  ForeignSample read_yade_vtk(const ForeignOptions &options, const std::vector<std::string> &files);
} // namespace diptych::coupling
