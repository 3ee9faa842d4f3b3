// diptych: the commands that Python carries out
// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

namespace diptych::coupling
{
  // Name and line in `diptych --help`. Python parses the words of these commands, and prints their help.
  struct PythonCommand
  {
    const char *name, *description;
  };

  inline constexpr PythonCommand python_commands[] = {
    {"study", "vary keys of a scene over many samples: quantities over keys, or errors against a reference"},
    {"plan", "find step, elements, load steps, law and number of samples for an accuracy, from short pilot runs"},
    {"calibrate",
     "fit a continuum, or the friction of grains, to curves of grains or tests; report parameters that the data cannot "
     "determine"},
    {"element", "drive grains and the law's point along one path and draw them beside each other"},
    {"homogenise", "stress, strain, fabric and band of grains without a continuum"},
    {"import", "check a sample of another code, or a measured displacement field, and store it like results"},
    {"export", "write a sample of a result folder for another code, or all stages for OVITO"},
    {"report", "draw report.html again, of any folder of results"}};
} // namespace diptych::coupling
