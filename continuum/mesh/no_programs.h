// diptych: a process that starts no other program
// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

namespace diptych::continuum
{
  // From now on until this process ends it and its children start no program, and remove, rename or make no file or folder: the
  // system's calls for it fail with EPERM, also for root (seccomp of Linux on x86_64 and aarch64). False where the system has no
  // such filter and all is as before: this is the last layer, not the only one.
  bool forbid_programs();
} // namespace diptych::continuum
