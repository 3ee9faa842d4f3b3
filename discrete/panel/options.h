// diptych: options of the discrete panel
// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include "discrete/panel/loading.h"
#include "discrete/stepping/penalty.h"
#include "discrete/stepping/step_rule.h"
#include "discrete/samples/sample_preparation.h"
#include "discrete/stepping/time_stepping.h"

namespace diptych::discrete
{
  enum class Method
  {
    nscd,      // Non-Smooth Contact Dynamics
    compliant, // the springs and dashpots of penalty, implicit over long steps
    penalty,   // explicit springs, dashpots and Coulomb friction (Cundall & Strack 1979)
    imported,  // no computation: frames of another code
    automatic  // one of the first three; coupling/scene/derived_keys.h replaces it before a run
  };

  constexpr auto choices(Method)
  {
    return std::array{std::pair{Method::nscd, "nscd"}, std::pair{Method::compliant, "compliant"},
                      std::pair{Method::penalty, "penalty"}, std::pair{Method::imported, "imported"},
                      std::pair{Method::automatic, "auto"}};
  }

  struct MethodOptions
  {
    Method      method = Method::nscd;
    std::string file;
    int         history_interval   = 0;
    double      checkpoint_minutes = 10;
    bool        store_problems     = false;
  };

  template <class Visitor> void visit_parameters(MethodOptions &o, Visitor &&visitor)
  {
    visitor(
      "method", o.method, "-",
      "nscd: Non-Smooth Contact Dynamics; compliant: the springs of `penalty`, implicit over long steps; penalty: explicit "
      "springs, dashpots and Coulomb friction (Cundall & Strack 1979); imported: no computation; the frames of another code are "
      "taken from `file`; auto: the cheapest of the first three at this size, speed and accuracy, springs with penalty_stiffness "
      "1e4 unless given; the resolved scene states the choice and the reason");
    visitor("file", FileName{o.file}, "-",
            "imported: discrete.h5 of `diptych import`, with discrete.csv in the same folder; {seed} in the path stands for "
            "sample/seed, so "
            "that an ensemble can use several samples");
    visitor("history_interval", o.history_interval, "steps", {0, 1000000000},
            "steps between two rows of discrete.csv; 0: every step (penalty: about a thousand rows per stage)");
    visitor("checkpoint_minutes", o.checkpoint_minutes, "min", {0., 1e6},
            "time between two checkpoints of a run, from which --resume continues; 0: at every step");
    visitor("store_problems", o.store_problems, "-",
            "write the contact problem of every snapshot's step with its solution to problem_NNNN.h5 (FCLIB layout, for "
            "`diptych solve` and other solvers)");
  }

  struct Options
  {
    MethodOptions     method;
    StepOptions       stepping;
    AccuracyOptions   accuracy;
    ContactLawOptions law;
    SolverOptions     solver;
    SamplingOptions   sampling;
    LateralOptions    lateral;
    WallDriveOptions  drives;
    PenaltyOptions    penalty;
    int               threads = 1; // from the command line; results do not depend on it
  };

  template <class Visitor> void visit_parameters(Options &o, Visitor &&visitor)
  {
    visit_parameters(o.method, visitor);
    visit_parameters(o.stepping, visitor);
    visit_parameters(o.accuracy, visitor);
    visit_parameters(o.law, visitor);
    visit_parameters(o.solver, visitor);
    visit_parameters(o.sampling, visitor);
    visit_parameters(o.lateral, visitor);
    visit_parameters(o.drives, visitor);
    visit_parameters(o.penalty, visitor);
  }

  // A key without effect, and the setting that makes it so. Both with their section.
  struct UnusedKey
  {
    std::string key, because; // "discrete/side_velocity", "discrete/lateral = end_grains"
  };
  std::vector<UnusedKey> unused_keys(const SampleOptions &sample, const Options &options);

  void validate(const SampleOptions &sample, const Loading &loading, const Options &options);

  constexpr double most_steps = 1e9; // largest number of steps of a loading; it would take months even for a hundred grains

  // Estimates from the scene only: length of a step [time], steps of the whole loading, rows of its history. With step = auto
  // they assume slow loading (step_at_rest) and stresses at which a sample under loading/pressure yields. They return 0 if the
  // pressure is 0. The stages in `loading` must be valid; the other conditions of validate() need not hold.
  double expected_step(const SampleOptions &sample, const Loading &loading, const Options &options);
  double expected_steps(const SampleOptions &sample, const Loading &loading, const Options &options);
  double expected_rows(const SampleOptions &sample, const Loading &loading, const Options &options);

  Compliance         compliance(const Loading &loading, const Options &options); // stiffness 0: method is not compliant
  PreparationSetting preparation_setting(const Loading &loading, const Options &options);
} // namespace diptych::discrete
