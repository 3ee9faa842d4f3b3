// diptych: takes frames of another code, checks them and writes them as results of the discrete panel
// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <string>

#include "coupling/import/arrived_sample.h"
#include "coupling/processes/run_options.h"

namespace diptych::coupling
{
  // The contents of import.json: options, notes and the numbers of every check.
  std::string import_record(const ForeignOptions &options, const Arrival &arrival);

  // Checks the frames. Writes the files of the discrete panel, import.json and provenance.json to the folder `output`; from
  // two frames on also scene.prm. Prints the checks. Throws SceneError if the frames are refused or the folder holds other files;
  // nothing is written then.
  void import_frames(const ForeignSample  &sample,
                     const ForeignOptions &options,
                     const std::string    &output,
                     const RunOptions     &run);
} // namespace diptych::coupling
