// diptych: a dense grain sample between two platens, ready to be loaded
// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <functional>
#include <string>

#include "discrete/time_stepping.h"

namespace diptych::discrete
{
  struct SampleOptions
  {
    int    grains                 = 4000;
    double mean_diameter          = 1;
    double radius_min             = 0.3;
    double radius_max             = 0.7;
    double width_over_height      = 0.7;
    double density                = 1;
    double solid_fraction         = 0.85;
    double box_solid_fraction     = 0.835;
    int    preparation_steps      = 300;
    double preparation_step       = 0.2;
    double preparation_tolerance  = 1e-3;
    int    preparation_max_sweeps = 300;
    double quiet_unbalanced_force = 0.05;
    int    seed                   = 1;
  };

  template <class Visitor> void visit_parameters(SampleOptions &o, Visitor &&visitor)
  {
    visitor("grains", o.grains, "-", {10, 10000000}, "number of discs");
    visitor("mean_diameter", o.mean_diameter, "length", {1e-12, 1e12}, "mean diameter d");
    visitor("radius_min", o.radius_min, "mean diameters", {0.05, 0.5}, "smallest radius; radii are uniform by number");
    visitor("radius_max", o.radius_max, "mean diameters", {0.5, 5.}, "largest radius; the two must average 0.5");
    visitor("width_over_height", o.width_over_height, "-", {0.05, 20.},
            "of the sample; below 1 a 45 degree band leaves by the sides");
    visitor("density", o.density, "mass/length^2", {1e-12, 1e12}, "of the grains, per unit thickness");
    visitor("solid_fraction", o.solid_fraction, "-", {0.3, 0.92}, "expected; fixes the height from the number of grains");
    visitor("box_solid_fraction", o.box_solid_fraction, "-", {0.3, 0.9}, "of the box in which soft discs are relaxed first");
    visitor("preparation_steps", o.preparation_steps, "-", {1, 1000000},
            "frictionless steps under the containing action, platens fixed; ten times as many are allowed to get quiet");
    visitor("preparation_step", o.preparation_step, "time", {1e-12, 1e12}, "their length");
    visitor("preparation_tolerance", o.preparation_tolerance, "-", {1e-14, 1.},
            "natural map residual at which a preparation step ends, and which the last one must have reached");
    visitor("preparation_max_sweeps", o.preparation_max_sweeps, "-", {1, 100000000}, "sweeps a preparation step may take");
    visitor("quiet_unbalanced_force", o.quiet_unbalanced_force, "-", {1e-12, 1e3},
            "the sample is quiet when the mean unbalanced force on a grain / mean contact force is below this");
    visitor("seed", o.seed, "-", {0, 2147483647}, "of the one random generator");
  }

  // Throws std::invalid_argument naming key and range where options contradict each other.
  void validate(const SampleOptions &options);

  struct PreparationReport
  {
    bool   quiet    = false;
    int    steps    = 0;
    double residual = 0, unbalanced_force = 0; // of the last step
    double solid_fraction = 0;                 // grain area / outline area
    double soft_overlap   = 0;                 // largest overlap left by the soft discs [length]
  };

  struct PreparedSample
  {
    State             state;     // at rest; walls[0] the lower platen at y = 0, walls[1] the upper one
    StepResult        last_step; // contacts and impulses that carry it
    PreparationReport report;
  };

  // 1. height from count, width/height and solid fraction; 2. soft discs relaxed in a box at box_solid_fraction;
  // 3. frictionless steps with platens fixed and the containing action on. Grains are numbered upward.
  // `progress` is called with (step, expected steps) and stops the preparation when it returns false.
  PreparedSample prepare_sample(const SampleOptions                 &options,
                                const LateralOptions                &lateral,
                                const SolverOptions                 &solver,
                                double                               pressure,
                                const std::function<bool(int, int)> &progress);

  // Mean over grains of |m dv/h| / mean normal contact force.
  double unbalanced_force(const State &before, const State &after, const StepResult &result, double step);
} // namespace diptych::discrete
