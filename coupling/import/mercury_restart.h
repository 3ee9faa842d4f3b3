// diptych: reads restart files of MercuryDPM
// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include "coupling/import/foreign_sample.h"

namespace diptych::coupling
{
  struct MercuryRestart
  {
    ForeignFrame frame;
    double       density             = not_told; // of the first species [mass/length^particle_dimensions]
    int          particle_dimensions = 2;        // 2: discs, 3: spheres, also for a run in the plane
    bool         has_fixed           = false;    // grains of infinite mass

    double mass_of(double radius) const;
  };

  // Throws SceneError naming file, line and the expected text.
  MercuryRestart read_mercury_restart(const std::string &path);
} // namespace diptych::coupling
