// diptych: readers of other codes' files, one a format
// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include "coupling/import/foreign_sample.h"

namespace diptych::coupling
{
  // Which file is what is seen from its content, in any order. All throw SceneError naming the file, its line or dataset, what
  // stood there and what was expected. README.md beside this header says which files and columns each reads.
  ForeignSample read_lammps(const ForeignOptions &options);
  ForeignSample read_liggghts(const ForeignOptions &options);
  ForeignSample read_yade(const ForeignOptions &options);
  ForeignSample read_lmgc90(const ForeignOptions &options); // text and HDF5
  ForeignSample read_mercurydpm(const ForeignOptions &options);
  ForeignSample read_plain_csv(const ForeignOptions &options);

  // VTKRecorder's .vtu of spheres and .vtp of interactions, in pairs. The direction of tangential forces and all wall contacts
  // are lost in them.
  ForeignSample read_yade_vtk(const ForeignOptions &options, const std::vector<std::string> &files);
} // namespace diptych::coupling
