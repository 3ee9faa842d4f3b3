// diptych: a calibration as files
// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <string>

#include "coupling/calibration/calibration_record.h"

namespace diptych::coupling
{
  // calibration.json, calibration.csv (a row an observable), calibration_cost.json and calibrated.prm: the keys that were found,
  // as a scene or --set-file takes them. What is there is replaced.
  void write_calibration(const std::string &directory, const CalibrationRecord &record);
} // namespace diptych::coupling
