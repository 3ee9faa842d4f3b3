// diptych: what read_mesh says of a file that it refuses
// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <stdexcept>
#include <string>

#include <gtest/gtest.h>

#include "continuum/mesh/mesh.h"

namespace diptych::continuum
{
  // It names the file first, and says `reason`.
  inline void expect_refused(const std::string &user_file, const std::string &reason)
  {
    try
      {
        (void)read_mesh(user_file);
        ADD_FAILURE() << "accepted, instead of: " << reason;
      }
    catch (const std::invalid_argument &error)
      {
        const std::string message = error.what();
        EXPECT_TRUE(message.find(user_file + ": ") == 0 || message.find(user_file + ", line ") == 0) << message;
        EXPECT_NE(message.find(reason), std::string::npos) << message << "\n instead of: " << reason;
      }
  }
} // namespace diptych::continuum
