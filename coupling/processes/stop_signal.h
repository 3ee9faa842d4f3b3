// diptych: Ctrl-C and SIGTERM end the run at the next step
// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

namespace diptych::coupling
{
  void install_stop_signals(); // a second Ctrl-C kills as usual
  bool stop_requested();
} // namespace diptych::coupling
