// diptych: the walk of a problem along its load path, put down and taken up again
// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <string>

#include "continuum/checkpoint.h"
#include "continuum/driver.h"

namespace diptych::continuum
{
  // Names mesh, loading and options, those left out that may change on the way (stages, time between checkpoints).
  std::string fingerprint(const std::string &msh_file, double mean_diameter, const Loading &loading, const Options &options);

  // Independent of the number of processes. Collective; complete on the first one.
  Checkpoint make_checkpoint(const BoundaryValueProblem &problem, const LoadDriver &driver);

  // Brings a fresh problem and its driver to where the checkpoint was made, on any number of processes. Collective. Throws
  // std::runtime_error when the checkpoint's cells do not belong to the problem's mesh.
  void restore(const Checkpoint &checkpoint, BoundaryValueProblem &problem, LoadDriver &driver);
} // namespace diptych::continuum
