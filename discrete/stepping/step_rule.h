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
      "stop of a step: natural map residual relative to |r|; auto: from accuracy, strain rate and step, so that the dilation is "
      "expected to err by 1.25 accuracy");
  }

  // Error of the dilation that the rules allow, over the accuracy.
  constexpr double dilation_share = 1.25;

  // What the sample feels, for the rules.
  struct FlowState
  {
    double          mean_stress = 0; // s [pressure]; 0 where nothing is pressed
    double          rate        = 0; // of strain [1/time]; 0 where there is none
    AccuracyOptions accuracy    = {};
  };

  // The bounds of the rule and what they gave; an accuracy above 0.05 counts as 0.05. d: mean diameter, rho: grain density.
  struct StepChoice
  {
    double      step;  // the smallest bound [time]
    std::string bound; // which one: "forces", "motion", "drives", "gravity", "strength" or "solver"
  };

  // step = auto (Moreau 1997: from the forces where grains are pressed together, from the speeds where they fly):
  //   forces   1 d sqrt(rho/s) with free end grains, 5 otherwise; s the larger of pressure and present mean stress
  //   motion   0.1 d / V, V the speed of the fastest wall or, if larger, three times the root mean square of the grains'
  //   drives   0.1 of the shortest interval of a wall's table; sqrt(0.1 d M/F) of a wall of mass M under a force F; the largest
  //            speed of a table counts among the speeds of walls
  //   gravity  0.3 sqrt(d/g)
  //   strength accuracy / (0.05 / (d sqrt(rho/s)) + 55 rate): what long steps add to the strength; at most 0.4 d sqrt(rho/s)
  //   solver   at which tolerance, if auto 1e-3 accuracy (below which sweeps wander), loses 1.25 accuracy of the dilation
  StepChoice choose_step(const State &state, const StepSetting &setting, const FlowState &flow);

  // The bounds forces, strength and solver, which a sample has before there are grains; infinity where nothing presses and
  // nothing strains.
  struct SampleScales
  {
    double n_grains     = 0;
    double unit_of_time = 0; // d sqrt(rho/s); infinity where nothing is pressed
    bool   end_grains   = false;
  };
  StepChoice step_at_rest(const SampleScales &sample, const FlowState &flow);

  // What was asked for; auto: at which 1.25 accuracy of the dilation are lost; 1e-3 accuracy where nothing strains or presses.
  double choose_tolerance(const State &state, const StepSetting &setting, const FlowState &flow);

  // What step h and tolerance of the setting cost, relative, with time in units of d sqrt(rho/s): strength 0.05 h + 55 x (strain
  // per step), dilation (0.2 + 0.8 h) x tolerance x h / I x (grains / 1000)^0.75 from 1000 grains on. Measured in biaxial
  // compression of 1000 and 2000 discs, straight and oblique, at I of 1e-4 and 1e-3
  // (benchmarks/studies/step_tolerance), the size at 4000 and 8000. 0 where
  // nothing strains or presses.
  struct ExpectedErrors
  {
    double strength = 0, dilation = 0;
  };
  ExpectedErrors expected_errors(const State &state, const StepSetting &setting, const FlowState &flow);
} // namespace diptych::discrete
