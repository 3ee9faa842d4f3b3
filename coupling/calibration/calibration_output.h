// diptych: result files of a calibration
// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <string>

#include "coupling/calibration/calibration_record.h"

namespace diptych::coupling
{
  // Writes calibration.json, calibration.csv (a row per observable), calibration_cost.json and calibrated.prm, replacing
  // existing files. A scene or --set-file takes the keys of calibrated.prm.
  void write_calibration(const std::string &directory, const CalibrationRecord &record);
} // namespace diptych::coupling
