// diptych: how far the grain stresses of an unfinished solve are from those of a finished one
// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <functional>
#include <limits>
#include <vector>

#include "discrete/contacts/contact_detection.h"
#include "discrete/solvers/solver.h"

namespace diptych::discrete
{
  struct SamplingOptions
  {
    double snapshot_accuracy   = 0.02;
    int    snapshot_max_sweeps = 0;
    int    reference_sweeps    = 50000;
  };

  template <class Visitor> void visit_parameters(SamplingOptions &o, Visitor &&visitor)
  {
    visitor(
      "snapshot_accuracy", o.snapshot_accuracy, "-", {1e-6, 1e3},
      "the step of a snapshot is solved on until the estimated rms error of the grains' stress, relative to its rms value, is "
      "below this");
    visitor("snapshot_max_sweeps", o.snapshot_max_sweeps, "-", {0, 1000000000},
            "sweeps such a step may take; where they do not suffice the run goes on and the estimate stands with the snapshot; "
            "some ten "
            "thousand where single grains count. 0: "
            "snapshots are solved like all other steps, with no estimate");
    visitor(
      "reference_sweeps", o.reference_sweeps, "-", {0, 1000000000},
      "further sweeps by which the first sampled step of a run is solved on towards a residual of 1e-9, to measure the ratio "
      "of error to residual and check the estimate; 0: not measured");
  }

  // Contact moments (r_i + gap/2) n (x) r of all grains, as one list of numbers: what a difference of impulses does to grain
  // stress. Differences of such lists are scale-free when divided by their norm.
  std::vector<double> contact_moments(const std::vector<double>  &radius,
                                      const std::vector<Contact> &contacts,
                                      const std::vector<Impulse> &impulses);

  // ||a - b||_2 / ||b||_2; 0 where both vanish, infinity where only b does.
  double relative_difference(const std::vector<double> &a, const std::vector<double> &b);

  // Estimate of the error from the iterates themselves. The residual does not tell it: where grains are pressed together and
  // move slowly the sweeps come near one near-solution after another, and at a residual of 1e-5 the grain stress may be wrong by
  // 2 or by 50 %. What the sweeps do to it goes on in the logarithm of their number: with D_k = ||M(2^k) - M(2^(k-1))|| /
  // ||M(2^k)|| the change in a doubling and q the larger of its last two ratios D_k / D_(k-1), at least 0.7,
  //   E = 4 D_k q / (1 - q),   unknown (infinity) for q >= 0.9,
  // four times the rest of a geometric series: of 56 solves at 300 discs (eight samples) the error was above the rest itself
  // doubled in 14, above E in 4. It is no bound: where the iterates stand on a plateau before a last change, or another exact
  // solution is near, the error may be four times as large (once of 56). In slow flow the changes grow for 10^5 sweeps and the
  // error stays unknown, as it must: there the warm start has hardly been left. Checked against solutions at 1e-9 (tests,
  // benchmarks/contact_solver).
  class GrainStressError
  {
  public:
    // To be called with growing numbers of sweeps. Takes moments at 100, 200, 400, ... sweeps.
    bool wants(long sweeps) const { return sweeps >= next_; }
    void observe(std::vector<double> moments);

    double estimate() const; // infinity where it is not known
    bool   hopeless() const; // the change has not fallen in two doublings on end: more sweeps will not tell
    double change() const { return changes_.empty() ? std::numeric_limits<double>::infinity() : changes_.back(); } // D_k

  private:
    std::vector<double> moments_; // of the last sample
    std::vector<double> changes_; // D_k, all of them
    long                next_ = 100;
  };

  // What a step that is sampled asks of its solve.
  struct SampleRequest
  {
    SamplingOptions options;
    bool            measure_factor = false; // solve a copy on towards 1e-9
    // Shown the problem of the step with its solution, where it is set.
    std::function<void(const ContactProblem &, const std::vector<Contact> &, const std::vector<Impulse> &)> on_problem = {};
  };

  struct SampledAccuracy
  {
    double stress_error  = 0;     // estimate
    double stress_change = 0;     // in the last doubling of the sweeps
    bool   reached       = false; // below snapshot_accuracy
    // Of the copy solved on, NaN where it was not asked for: its residual, the difference from it, and the ratio of that to
    // the residual (NaN where the copy did not get below a tenth of that residual and so is no solution to measure against).
    double reference_residual = std::numeric_limits<double>::quiet_NaN(), true_error = reference_residual;
    double error_over_residual = reference_residual;
  };

  // A contact problem with the geometry that its moments need.
  struct SampledProblem
  {
    const ContactProblem       &problem;
    const std::vector<double>  &radius; // of the grains
    const std::vector<Contact> &contacts;
  };

  // Solves to the tolerance of `solver`, then on until the estimate is below the accuracy wanted, the residual below 1e-9
  // (estimate: 0), it is hopeless, or the sweeps are used up. The factor is measured only where the accuracy was reached. The
  // report says whether the tolerance was met, `accuracy` the rest.
  SolveReport solve_sampled(const SampledProblem &sampled,
                            const SolverOptions  &solver,
                            const SampleRequest  &request,
                            ThreadTeam           &team,
                            std::vector<Impulse> &impulses,
                            SampledAccuracy      &accuracy);
} // namespace diptych::discrete
