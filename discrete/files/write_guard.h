// diptych: who wants to know before a file is written
// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <functional>
#include <string>

namespace diptych::discrete
{
  // Called with the path of a file before it is opened to be written and before it takes its name; what it throws ends the
  // writing, and the file of that name stays as it was. Empty: nobody wants to know. Not to be set while files are written.
  void set_write_guard(std::function<void(const std::string &path)> guard);
  void ask_write_guard(const std::string &path);
} // namespace diptych::discrete
