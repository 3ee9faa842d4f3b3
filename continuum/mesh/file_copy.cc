// diptych: a copy of a text in a folder of its own
// SPDX-License-Identifier: LGPL-2.1-or-later
#include "continuum/mesh/file_copy.h"

#include <cerrno>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <stdexcept>

#include <stdlib.h>

namespace diptych::continuum
{
  FileCopy::FileCopy(const std::string &ending, const std::string &text)
  {
    std::error_code   none;
    const std::string parent = std::filesystem::temp_directory_path(none).string();
    folder                   = parent + "/diptych_mesh_XXXXXX";
    if (none || mkdtemp(folder.data()) == nullptr)
      throw std::runtime_error("cannot make a folder for a copy of the mesh in the folder of temporary files '" + parent +
                               "' (TMPDIR): " + (none ? none.message() : std::strerror(errno)));
    file = folder + "/mesh" + ending;
    std::ofstream out(file, std::ios::binary);
    out << text;
    out.close();
    if (out)
      return;
    std::filesystem::remove_all(folder, none);
    throw std::runtime_error("cannot write a copy of the mesh to " + parent + " (TMPDIR)");
  }

  FileCopy::~FileCopy()
  {
    std::error_code ignored;
    std::filesystem::remove_all(folder, ignored);
  }

  std::string with_name_of(const std::string &user_file, const FileCopy &copy, std::string message)
  {
    for (std::size_t at = 0; (at = message.find(copy.file, at)) != std::string::npos; at += user_file.size())
      message.replace(at, copy.file.size(), user_file);
    return message;
  }
} // namespace diptych::continuum
