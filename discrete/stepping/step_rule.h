// diptych: step length and tolerance, from forces, motion and accuracy
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
    visitor(
      "accuracy", o.accuracy, "-", {1e-3, 0.5},
      "relative error of the strength that step = auto and tolerance = auto may cause; the error of the dilation may be 1.25 "
      "times as large (discrete/README.md; measured in biaxial compression)");
    visitor("tolerance", o.tolerance, "-", {1e-14, 1.},
            "residual at which a step ends: natural map relative to |r|; auto: from accuracy, strain rate and step, so that the "
            "expected "
            "relative error of the dilation is 1.25 accuracy");
  }

  // Error of the dilation that the rules allow / accuracy.
  constexpr double dilation_share = 1.25;

  // State of the flow, from which the rules follow.
  struct FlowState
  {
    double          mean_stress = 0; // s [pressure]; 0 without pressure
    double          rate        = 0; // of strain [1/time]; 0 without strain
    AccuracyOptions accuracy    = {};
  };

  // Result of the rule. An accuracy above 0.05 counts as 0.05. Symbols: mean diameter d, density rho of the grains.
  struct StepChoice
  {
    double      step;  // the smallest bound [time]
    std::string bound; // which one: "forces", "motion", "drives", "gravity", "strength" or "solver"
  };

  // step = auto. Moreau (1997) takes the forces if grains are pressed together and the speeds if they fly. The step is the
  // smallest of these bounds:
  //   forces   1 d sqrt(rho/s) with free end grains, 5 otherwise; s the larger of pressure and present mean stress
  //   motion   0.1 d / V, V the speed of the fastest wall or, if larger, three times the root mean square of the grains'
  //   drives   0.1 of the shortest interval of a wall's table; sqrt(0.1 d M/F) for a wall of mass M under a force F; the largest
  //            speed of a table counts as a speed of the wall
  //   gravity  0.3 sqrt(d/g)
  //   strength the step with an expected error of the strength of `accuracy`; at most 0.4 d sqrt(rho/s)
  //   solver   the step at which the tolerance causes a relative error of the dilation of 1.25 accuracy; auto counts as
  //            1e-3 accuracy here, because sweeps wander below that residual
  StepChoice choose_step(const State &state, const StepSetting &setting, const FlowState &flow);

  // The bounds forces, strength and solver, which are known before the grains are placed. Infinity without pressure and strain.
  struct SampleScales
  {
    double n_grains     = 0;
    double unit_of_time = 0; // d sqrt(rho/s); infinity without pressure
    bool   end_grains   = false;
  };
  StepChoice step_at_rest(const SampleScales &sample, const FlowState &flow);

  // Tolerance that the user gave. `auto`: the tolerance that causes a relative error of the dilation of 1.25 accuracy, or 1e-3
  // accuracy without strain or pressure.
  double choose_tolerance(const State &state, const StepSetting &setting, const FlowState &flow);

  // Expected relative errors due to step h and tolerance, with time in units of d sqrt(rho/s). Both are 0 without strain or
  // pressure. Measured in straight and oblique biaxial compression of 1000 and 2000 discs.
  //   strength  the larger of 0.06 sqrt(h) and 55 x (strain per step); against the limit of short steps, at inertial numbers of
  //             1e-4 to 1e-2 (benchmarks/rigid_limit). Order 1/2 is proved for Moreau's scheme (Bernicot & Venel 2013)
  //   loss      (0.2 + 0.8 h) x tolerance x h / I x (grains / 1000)^0.75, with grains between 1000 and 8000: what the residual
  //             takes from the dilation (benchmarks/studies/step_tolerance; the size from 1000 to 16000 grains:
  //             benchmarks/rigid_limit)
  struct ExpectedErrors
  {
    double strength = 0, dilation_loss = 0;

    // The dilation that the step adds, measured with its error of the strength, less the loss by the residual.
    double dilation() const { return 0.14 / 0.06 * strength - dilation_loss; }
  };
  ExpectedErrors expected_errors(const State &state, const StepSetting &setting, const FlowState &flow);
} // namespace diptych::discrete
