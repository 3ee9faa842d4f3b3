// diptych: contacts and walls of another code's frame put in order
// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include "coupling/import/arrived_sample.h"

namespace diptych::coupling
{
  // Fills contacts, status and walls of `to`, whose grains stand there in the order of arrival.id. Pairs that stand twice are
  // taken once; forces that pull where all push are turned; a wall without a side is where the grains touch it. Each of these is
  // said in arrival.remarks, once for all frames. Throws SceneError as arrive() says.
  void take_contacts(const ForeignFrame &from, Arrival &arrival, const ForeignOptions &options, ArrivedFrame &to);
} // namespace diptych::coupling
