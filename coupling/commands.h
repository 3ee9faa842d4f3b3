// diptych: what the program can be asked to do
// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <string>
#include <vector>

namespace diptych::coupling
{
  struct CommandLine
  {
    std::string              command, target;     // target: scene file, result folder or section
    std::string              output;              // --output
    std::vector<std::string> overrides;           // --set section/key=value
    int                      threads = 1;         // --threads
    bool                     resume  = false;     // --resume
    std::string              study;               // --study: step
    std::string              seeds;               // --seeds: "1-8", "1,3,5-7"
    int                      jobs       = 0;      // --jobs; 0: as many as fit
    std::string              solver     = "psor"; // --solver, --tolerance, --max-sweeps, --form: of solve
    double                   tolerance  = 1e-8;
    int                      max_sweeps = 1000000;
    std::string              form;
    bool                     quiet = false; // --quiet
    std::string              text;          // as it was typed
  };

  enum ExitCode
  {
    done          = 0,
    invariant     = 1,
    wrong_input   = 2,
    not_converged = 3
  };

  struct Scene;

  // Throws SceneError where `diptych run` cannot compare the panels of a scene, before anything is written.
  void check_comparable(const CommandLine &line, const Scene &scene);

  // Each returns an ExitCode. Throw SceneError or std::invalid_argument on wrong input and std::runtime_error on trouble with
  // files.
  int run_both(const CommandLine &line);           // run SCENE
  int run_discrete(const CommandLine &line);       // discrete SCENE
  int run_continuum(const CommandLine &line);      // continuum SCENE; on all processes together
  int run_material_point(const CommandLine &line); // material-point SCENE
  int compare_again(const CommandLine &line);      // compare DIR
  int report_again(const CommandLine &line);       // report DIR
  int explain_keys(const CommandLine &line);       // explain [SECTION]
} // namespace diptych::coupling
