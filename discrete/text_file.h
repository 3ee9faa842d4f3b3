// diptych: text files that are whole or absent
// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <cstdio>
#include <fstream>
#include <stdexcept>
#include <string>

namespace diptych::discrete
{
  // Writes under `path`.part, then renames. Throws std::runtime_error naming the file.
  inline void write_text(const std::string &path, const std::string &text)
  {
    std::ofstream file(path + ".part");
    file << text;
    file.close();
    if (!file || std::rename((path + ".part").c_str(), path.c_str()) != 0)
      throw std::runtime_error("cannot write " + path);
  }
} // namespace diptych::discrete
