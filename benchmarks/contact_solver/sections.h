// diptych: tables of the benchmark, one function per table
// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <string>

namespace diptych::benchmarks
{
  // `states`: folder that keeps sheared samples. If it is empty, each call makes them again.
  void update_cost(const std::string &states);     // ns per update, sweeps only
  void stored_problems(const std::string &states); // contact problems in files
  void step_solve(const std::string &states);      // solve of one step, 4000 discs
  void how_far(const std::string &states);         // smallest residuals reached
  void sweep_orders(const std::string &states);    // order of the sweeps beside omega by status
  void whole_step(const std::string &states);      // seconds per step and memory, 500 to 64000 discs
  void threads(const std::string &states);         // two threads, wall time
  void accuracy(const std::string &states);        // grain-stress error against residual
  void warm_start(const std::string &states);      // with and without the impulses of the preceding step
  void wandering(const std::string &states);       // sweeps that do not converge
  void stalls(const std::string &states);          // sweeps that stall on a few contacts
  void compliant(const std::string &states);       // implicit compliant contacts
} // namespace diptych::benchmarks
