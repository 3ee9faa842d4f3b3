// diptych: the options that every command shares
// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <iostream>
#include <string>

#include "coupling/processes/followers.h"
#include "coupling/processes/progress.h"

namespace diptych::coupling
{
  struct RunOptions
  {
    int         threads   = 1;       // --threads: threads of the contact solver
    bool        resume    = false;   // --resume
    bool        overwrite = false;   // --overwrite
    bool        quiet     = false;   // --quiet: neither progress nor messages
    std::string text;                // the command line
    Followers  *followers = nullptr; // of an MPI job
  };

  inline void say(const RunOptions &options, const std::string &text)
  {
    if (options.quiet)
      return;
    Progress::make_room();
    std::cout << text << std::endl;
  }

  // Writes to standard error, also with --quiet; an empty text is not written.
  inline void warn(const std::string &text)
  {
    if (!text.empty())
      std::cerr << "diptych: warning: " << text << std::endl;
  }
} // namespace diptych::coupling
