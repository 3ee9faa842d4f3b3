// diptych: samples under way, whose next contact problem is what the benchmark solves
// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <string>

#include "discrete/stepping/time_stepping.h"

namespace diptych::benchmarks
{
  // A loading at 45 degrees with free end grains: inertial number I, step [d sqrt(rho/P)], tolerance of the preceding steps.
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

  // Default sample (radii 0.3 to 0.7 d, width/height 0.7, seed 1), prepared and set moving.
  Sheared start_shear(int grains, const LoadCase &load);

  // Axial strain by which the next step shears it.
  double strain_of_a_step(const LoadCase &load);

  // One step at the tolerance of its setting. Throws std::runtime_error where it does not converge.
  discrete::StepResult advance(Sheared &sheared);

  // start_shear() and steps to 1 % axial strain. Kept as a checkpoint in `folder`, if that is not empty, and read from there when
  // asked again. Says on stderr what it waits for.
  Sheared sheared_state(const std::string &folder, int grains, const LoadCase &load);

  // What the solver is given in the next step of `sheared`, which stays as it is.
  struct NextStep
  {
    discrete::ContactProblem       problem;
    std::vector<discrete::Contact> contacts;
    std::vector<double>            radius; // of the grains
    std::vector<discrete::Impulse> guess;  // impulses of the preceding step
  };
  NextStep next_step(const Sheared &sheared);

  // Solves of several steps: CPU seconds with the making of the batches, sweeps, residuals, and how many converged.
  struct MeasuredSolves
  {
    std::vector<double> seconds, sweeps, residuals;
    int                 converged = 0;

    void add(const NextStep &next, const discrete::SolverOptions &options); // from the impulses of the preceding step
  };

  // Rms difference of the grains' stress, relative to its rms value in `exact`.
  double stress_difference(const NextStep                       &step,
                           const std::vector<discrete::Impulse> &impulses,
                           const std::vector<discrete::Impulse> &exact);
} // namespace diptych::benchmarks
