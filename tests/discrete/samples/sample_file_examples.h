// diptych: files of grains for tests
// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <cmath>
#include <fstream>

#include "discrete/files/hdf5_file.h"
#include "discrete/panel/snapshot_file.h"
#include "discrete/samples/sample_file.h"
#include "discrete/files/text_file.h"
#include "tests/files.h"

namespace
{
  using namespace diptych::discrete;
  using namespace diptych::tests;

  const Folder      samples;
  const std::string csv = samples / "grains.csv", h5 = samples / "grains.h5";

  GrainFile read(const std::string &text)
  {
    write_text(csv, text);
    return read_grains_csv(csv, 2.);
  }
} // namespace
