// diptych: the commands
// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include "coupling/program/command_line.h"

namespace diptych::coupling
{
  // Each returns an ExitCode. Wrong input is thrown as std::invalid_argument, a system failure as std::runtime_error.
  // The scene is that of the line.

  int run_both(const CommandLine &line, const Scene &scene);           // run SCENE: both panels, comparison, report
  int run_discrete(const CommandLine &line, const Scene &scene);       // discrete SCENE
  int run_continuum(const CommandLine &line, const Scene &scene);      // continuum SCENE; on all processes together
  int run_material_point(const CommandLine &line, const Scene &scene); // material-point SCENE: writes material_point.csv

  int compare_again(const CommandLine &line); // compare DIR: a result folder or an ensemble

  int print_template(const CommandLine &line); // new [TEMPLATE]
  int print_completion();                      // completion bash

  int check_law_of(const CommandLine &line); // check-law SCENE or LIBRARY.so; wrong_input if a check fails

  // Checks a scene and prints the resources of all samples. seeds: those of an ensemble, whose first sample is prepared and
  // checked, too. With --check or --resume no sample is prepared.
  int check_run(const CommandLine &line, const Scene &scene, const std::vector<int> &seeds = {});

  // solve PROBLEM.h5: solves a problem in the layout of FCLIB from r = 0 to line.solve.tolerance (natural map relative to |r|).
  // Prints the cost, one `name: value` per line. With --output it writes the problem and the reached solution, converged or not.
  int solve_stored_problem(const CommandLine &line);
} // namespace diptych::coupling
