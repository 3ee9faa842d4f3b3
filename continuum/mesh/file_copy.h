// diptych: a copy of a text in a folder of its own
// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <string>

namespace diptych::continuum
{
  // A file `mesh` + `ending` with the given text, alone in a new folder below the system's temporary directory; both are removed
  // at the end of its life. gmsh also reads FILE.opt beside a FILE and does what it says: beside this one there is none.
  struct FileCopy
  {
    // Throws std::runtime_error naming the folder that cannot be written to.
    FileCopy(const std::string &ending, const std::string &text);
    ~FileCopy();
    FileCopy(const FileCopy &)            = delete;
    FileCopy &operator=(const FileCopy &) = delete;

    std::string folder, file;
  };

  // `message` with the name of the user's file where it has that of the copy.
  std::string with_name_of(const std::string &user_file, const FileCopy &copy, std::string message);
} // namespace diptych::continuum
