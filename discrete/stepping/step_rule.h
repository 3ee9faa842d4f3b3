// diptych: the length of a step, from forces and motion
// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <string>

#include "discrete/stepping/time_stepping.h"

namespace diptych::discrete
{
  struct AccuracyOptions
  {
    double                accuracy = 0.02;
    std::optional<double> tolerance; // none: auto
  };

  template <class Visitor> void visit_parameters(AccuracyOptions &o, Visitor &&visitor)
  {
    visitor("accuracy", o.accuracy, "-", {1e-3, 0.5},
            "relative error of the strength that step = auto and tolerance = auto may make; that of the dilation is one and a "
            "half times as large (discrete/README.md: measured in biaxial compression)");
    visitor(
      "tolerance", o.tolerance, "-", {1e-14, 1.},
      "stop of a step: natural map residual relative to |r|; auto: from accuracy, strain rate and step, so that tolerance x "
      "step / inertial number is 2.5 accuracy");
  }

  // What the sample feels, for the rules.
  struct FlowState
  {
    double          mean_stress = 0; // s [pressure]; 0 where nothing is pressed
    double          rate        = 0; // of strain [1/time]; 0 where there is none
    AccuracyOptions accuracy    = {};
  };

  // The bounds of the rule and what they gave. d: mean diameter, rho: grain density.
  struct StepChoice
  {
    double      step;  // the smallest bound [time]
    std::string bound; // which one: "forces", "motion", "drives", "gravity", "strain" or "solver"
  };

  // step = auto (Moreau 1997: from the forces where grains are pressed together, from the speeds where they fly):
  //   forces   1 d sqrt(rho/s) with free end grains, 5 otherwise; s the larger of pressure and present mean stress
  //   motion   0.1 d / V, V the speed of the fastest wall or, if larger, three times the root mean square of the grains'
  //   drives   0.1 of the shortest interval of a wall's table; sqrt(0.1 d M/F) of a wall of mass M under a force F; the largest
  //            speed of a table counts among the speeds of walls
  //   gravity  0.3 sqrt(d/g)
  //   strain   1/100 accuracy / rate: long steps add about 100 x (strain per step) to the strength
  //   solver   2.5 accuracy I / tolerance in units of d sqrt(rho/s), tolerance = auto: 1e-3 accuracy, below which sweeps wander
  StepChoice choose_step(const State &state, const StepSetting &setting, const FlowState &flow);

  // What was asked for; auto: 2.5 accuracy I / h in units of d sqrt(rho/s), 1e-3 accuracy where nothing strains or presses.
  double choose_tolerance(const State &state, const StepSetting &setting, const FlowState &flow);

  // What step and tolerance of the setting cost, relative, as measured in biaxial compression of 1000 discs: strength + 100 x
  // (strain per step), dilation lost half of tolerance x step / I. 0 where nothing strains or presses.
  struct ExpectedErrors
  {
    double strength = 0, dilation = 0;
  };
  ExpectedErrors expected_errors(const State &state, const StepSetting &setting, const FlowState &flow);
} // namespace diptych::discrete
