// diptych: text files that are whole or absent
// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <filesystem>
#include <fstream>
#include <stdexcept>
#include <string>

namespace diptych::continuum
{
  // Calls body(stream) on a temporary file and renames it. Throws std::runtime_error naming the file.
  template <class Body> void write_text_file(const std::string &name, Body &&body)
  {
    const std::string temporary = name + ".part";
    std::ofstream     stream(temporary);
    stream.precision(12);
    body(stream);
    stream.close();
    if (!stream)
      throw std::runtime_error("cannot write " + name);
    std::filesystem::rename(temporary, name);
  }
} // namespace diptych::continuum
