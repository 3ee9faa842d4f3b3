// diptych: the place of the Python package
// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <filesystem>
#include <string>

#include "coupling/processes/child_process.h"

namespace diptych::coupling
{
  // The folder that holds the package `diptych`: beside this program where it was built, else PREFIX/lib/python3/dist-packages.
  inline std::string python_package()
  {
    namespace fs           = std::filesystem;
    const fs::path folder = fs::path(own_path()).parent_path(), built = folder / "python";
    return (fs::exists(built / "diptych/campaigns") ? built : folder.parent_path() / "lib/python3/dist-packages").string();
  }
} // namespace diptych::coupling
