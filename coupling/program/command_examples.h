// diptych: the group and an example of every command
// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <string>

namespace diptych::coupling
{
  // The group of a command in `diptych --help`, and the example at the end of its help.
  struct CommandExample
  {
    const char *name, *group, *example;
  };

  inline constexpr CommandExample command_examples[] = {
    {"new", "Help", "diptych new biaxial > mine.prm"},
    {"run", "Run", "diptych run mine.prm --set discrete/friction=0.4 --seeds 1-8"},
    {"study", "Run", "diptych study mine.prm --vary discrete/friction=0.2,0.3,0.5 --seeds 1-3"},
    {"plan", "Run", "diptych plan mine.prm --accuracy 2%"},
    {"calibrate", "Fit", "diptych calibrate mine.prm --seeds 1-4"},
    {"element", "Run", "diptych element mine.prm --set loading/path=simple_shear --seeds 1-4"},
    {"homogenise", "Data", "diptych homogenise results/mine --grid 4"},
    {"import", "Data", "diptych import csv particles_*.csv contacts_*.csv walls.csv --output mine"},
    {"export", "Data", "diptych export results/mine --format lammps --stage 2"},
    {"report", "Data", "diptych report results/mine --movie"},
    {"discrete", "Run", "diptych discrete mine.prm --threads 2"},
    {"continuum", "Run", "diptych continuum mine.prm --set continuum/element_size=2"},
    {"material-point", "Fit", "diptych material-point mine.prm --path simple_shear"},
    {"check-law", "Fit", "diptych check-law my_law.so"},
    {"solve", "Data", "diptych solve problem.h5 --tolerance 1e-10 --output solved.h5"},
    {"compare", "Data", "diptych compare results/mine --set comparison/averaging=kernel"},
    {"explain", "Help", "diptych explain friction"},
    {"completion", "Help", "source <(diptych completion bash)"}};

  inline std::string example_of(const std::string &command)
  {
    for (const CommandExample &known : command_examples)
      if (command == known.name)
        return std::string("Example: ") + known.example;
    return "";
  }
} // namespace diptych::coupling
