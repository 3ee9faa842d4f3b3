// diptych: an example of every command
// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <string>
#include <utility>

namespace diptych::coupling
{
  // Command -> the example at the end of its help.
  inline constexpr std::pair<const char *, const char *> command_examples[] = {
    {"run", "diptych run mine.prm --set discrete/friction=0.4 --seeds 1-8"},
    {"study", "diptych study mine.prm --vary discrete/friction=0.2,0.3,0.5 --seeds 1-3"},
    {"plan", "diptych plan mine.prm --accuracy 2%"},
    {"calibrate", "diptych calibrate mine.prm --seeds 1-4"},
    {"element", "diptych element mine.prm --set loading/path=simple_shear --seeds 1-4"},
    {"homogenise", "diptych homogenise results/mine --grid 4"},
    {"import", "diptych import csv particles_*.csv contacts_*.csv walls.csv --output mine"},
    {"export", "diptych export results/mine --format lammps --stage 2"},
    {"report", "diptych report results/mine --movie"},
    {"discrete", "diptych discrete mine.prm --threads 2"},
    {"continuum", "diptych continuum mine.prm --set continuum/element_size=2"},
    {"material-point", "diptych material-point mine.prm --path simple_shear"},
    {"check-law", "diptych check-law my_law.so"},
    {"solve", "diptych solve problem.h5 --tolerance 1e-10 --output solved.h5"},
    {"compare", "diptych compare results/mine --set comparison/averaging=kernel"},
    {"new", "diptych new biaxial > mine.prm"},
    {"explain", "diptych explain friction"},
    {"completion", "source <(diptych completion bash)"}};

  inline std::string example_of(const std::string &command)
  {
    for (const auto &[name, example] : command_examples)
      if (command == name)
        return std::string("Example: ") + example;
    return "";
  }
} // namespace diptych::coupling
