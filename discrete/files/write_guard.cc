// diptych: who wants to know before a file is written
// SPDX-License-Identifier: LGPL-2.1-or-later
#include "discrete/files/write_guard.h"

#include <utility>

namespace diptych::discrete
{
  namespace
  {
    std::function<void(const std::string &)> &guard()
    {
      static std::function<void(const std::string &)> one;
      return one;
    }
  } // namespace

  void set_write_guard(std::function<void(const std::string &path)> wanted)
  {
    guard() = std::move(wanted);
  }

  void ask_write_guard(const std::string &path)
  {
    if (guard())
      guard()(path);
  }
} // namespace diptych::discrete
