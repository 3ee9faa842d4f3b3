// diptych: the options that every command shares
// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <iostream>
#include <string>

#include "coupling/processes/progress.h"

namespace diptych::coupling
{
  struct RunOptions
  {
    int         threads   = 1;     // --threads, of the contact solver
    int         jobs      = 0;     // --jobs: runs at once; 0: as many as the cores allow
    bool        resume    = false; // --resume
    bool        overwrite = false; // --overwrite
    bool        quiet     = false; // --quiet: neither progress nor messages
    std::string text;              // the command line as it was typed
  };

  // To standard output, unless --quiet.
  inline void say(const RunOptions &options, const std::string &text)
  {
    if (options.quiet)
      return;
    Progress::make_room();
    std::cout << text << std::endl;
  }

  // To standard error, quiet or not; nothing where the text is empty.
  inline void warn(const std::string &text)
  {
    if (!text.empty())
      std::cerr << "diptych: warning: " << text << std::endl;
  }
} // namespace diptych::coupling
