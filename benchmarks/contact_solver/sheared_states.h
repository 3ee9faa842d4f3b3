// diptych: samples during a loading; the benchmark solves their next contact problem
// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <string>

#include "discrete/stepping/time_stepping.h"

namespace diptych::benchmarks
{
  // A loading at 45 degrees with free sides: inertial number I, step [d sqrt(rho/P)], tolerance of the preceding steps.
  struct LoadCase
  {
    const char *name;
    double      inertial_number, step, tolerance;
  };
  constexpr LoadCase state_a{"A", 1e-3, 0.02, 3e-4}, state_b{"B", 1e-4, 0.2, 1e-4}, rapid_flow{"rapid", 0.1, 0.02, 1e-4};

  struct Sheared
  {
    discrete::State       state;
    discrete::StepSetting setting;
    discrete::StepCache   cache = {};
  };

  // Default sample (radii 0.3 to 0.7 d, width/height 0.7, seed 1), prepared and in motion.
  Sheared start_shear(int grains, const LoadCase &load);

  // Axial strain of the next step.
  double strain_of_a_step(const LoadCase &load);

  // Advances one step at the tolerance of its load case. Throws std::runtime_error if the step does not converge.
  discrete::StepResult advance(Sheared &sheared);

  // start_shear() and steps to 1 % axial strain. If `folder` is not empty, keeps the state there as a checkpoint and reads it
  // from there at the next call. Prints to stderr what it computes.
  Sheared sheared_state(const std::string &folder, int grains, const LoadCase &load);

  // Input of the solver in the next step of `sheared`, which is not changed.
  struct NextStep
  {
    discrete::ContactProblem       problem;
    std::vector<discrete::Contact> contacts;
    std::vector<double>            radius; // Radii of the grains.
    std::vector<discrete::Impulse> guess;  // Impulses of the preceding step.
  };
  NextStep next_step(const Sheared &sheared);

  // Solves of several steps: CPU seconds including the making of the batches, sweeps, residuals, number of converged steps.
  struct MeasuredSolves
  {
    std::vector<double> seconds, sweeps, residuals;
    int                 converged = 0;

    void add(const NextStep &next, const discrete::SolverOptions &options); // Starts from the impulses of the preceding step.
  };

  // Rms difference of the grain stress, relative to its rms value in `exact`.
  double stress_difference(const NextStep                       &step,
                           const std::vector<discrete::Impulse> &impulses,
                           const std::vector<discrete::Impulse> &exact);
} // namespace diptych::benchmarks
