// diptych: files of grains for tests
// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <cmath>
#include <filesystem>
#include <fstream>
#include <functional>

#include <gtest/gtest.h>

#include <unistd.h>

#include "discrete/files/hdf5_file.h"
#include "discrete/panel/snapshot_file.h"
#include "discrete/samples/sample_file.h"
#include "discrete/files/text_file.h"

namespace
{
  using namespace diptych::discrete;

  std::string temporary_path(const std::string &name)
  {
    return (std::filesystem::path(testing::TempDir()) / ("sample_file" + std::to_string(::getpid()) + name)).string();
  }

  // Message about a fault, without the name of the file in front.
  std::string complaint(const std::string &path, const std::function<void()> &action)
  {
    try
      {
        action();
      }
    catch (const std::exception &error)
      {
        const std::string what = error.what();
        return what.compare(0, path.size(), path) == 0 ? what.substr(path.size()) : what;
      }
    return "no error";
  }

  const std::string csv = temporary_path(".csv"), h5 = temporary_path(".h5");

  GrainFile read(const std::string &text)
  {
    write_text(csv, text);
    const GrainFile file = read_grains_csv(csv, 2.);
    std::filesystem::remove(csv);
    return file;
  }

  std::string csv_complaint(const std::string &text)
  {
    const std::string what = complaint(csv, [&] { read(text); });
    std::filesystem::remove(csv);
    return what;
  }
} // namespace
