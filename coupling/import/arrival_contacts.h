// diptych: puts contacts and walls of another code's frame in order
// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include "coupling/import/arrived_sample.h"

namespace diptych::coupling
{
  void remark_once(Arrival &arrival, const std::string &text);

  // Fills contacts, status and walls of `to`; its grains are already there, in the order of arrival.id. Repeated pairs are
  // counted once. Forces that pull are reversed. The grains that touch a wall without a side locate it. Each of these is
  // reported once for all frames in arrival.remarks. Throws SceneError like arrive().
  void take_contacts(const ForeignFrame &from, Arrival &arrival, const ForeignOptions &options, ArrivedFrame &to);
} // namespace diptych::coupling
