// diptych: files that come with the program, and its parts that are written in Python
// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <string>

namespace diptych::coupling
{
  // This process becomes `program`. Stop signals that arrive meanwhile are kept for it. Throws std::runtime_error if it cannot be
  // started, StoppedOnRequest if a signal came before.
  [[noreturn]] void become(const char *command, const std::string &program, char *const *words);

  // Absolute path of share/diptych/NAME beside the program's own folder where it was built, beside PREFIX/bin or
  // PREFIX/libexec/diptych where it is installed. Throws std::runtime_error without it.
  std::string shared_file(const std::string &name);

  // The folder that holds the package `diptych`: beside this program where it was built, else PREFIX/lib/python3/dist-packages.
  std::string python_package();

  // Lets Python processes that this one starts or becomes find the package. Throws SceneError if the program was built without
  // it.
  void use_python_package(const char *command);

  // This process becomes `python3 -m diptych WORDS...` with this package. Throws as become() and use_python_package().
  [[noreturn]] void become_python(char *const *words);
} // namespace diptych::coupling
