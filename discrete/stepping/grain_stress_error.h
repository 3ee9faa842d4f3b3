// diptych: estimated error of the grain stresses of an unfinished solve
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
    visitor("snapshot_accuracy", o.snapshot_accuracy, "-", {1e-6, 1e3},
            "estimated rms error of the grains' stress, relative to its rms value, at which the solve of a snapshot's step ends");
    visitor(
      "snapshot_max_sweeps", o.snapshot_max_sweeps, "-", {0, 1000000000},
      "largest number of sweeps for the step of a snapshot; some ten thousand if single grains matter. If they do not suffice, "
      "the "
      "run goes on and stores the estimate with the snapshot. 0: snapshots are solved like all other steps, without an estimate");
    visitor("reference_sweeps", o.reference_sweeps, "-", {0, 1000000000},
            "further sweeps, towards a residual of 1e-9, for the first sampled step of a run: they measure the ratio of error to "
            "residual "
            "and check the estimate; 0: not measured");
  }

  // Contact moments (r_i + gap/2) n (x) r of all grains as one list of numbers. They show how a difference of impulses affects
  // the grain stress. The difference of two such lists, divided by the norm of one, has no scale.
  std::vector<double> contact_moments(const std::vector<double>  &radius,
                                      const std::vector<Contact> &contacts,
                                      const std::vector<Impulse> &impulses);

  // ||a - b||_2 / ||b||_2; 0 if both vanish, infinity if only b does.
  double relative_difference(const std::vector<double> &a, const std::vector<double> &b);

  // Estimates the error of the grain stress from the iterates, because the residual does not show it. In slow flow the sweeps
  // pass one near-solution after another: at a residual of 1e-5 the stress may be wrong by 2 % or by 50 %. D_k = ||M(2^k) -
  // M(2^(k-1))|| / ||M(2^k)|| is the change in a doubling of the sweeps, with the contact moments M. Let q be the larger of the
  // last two ratios D_k / D_(k-1), at least 0.7. The estimate is four times the rest of a geometric series:
  //   E = 4 D_k q / (1 - q),   unknown (infinity) for q >= 0.9
  // E is not a bound: it was too small in 4 of 56 solves with 300 discs, once by a factor of four. In slow flow the changes
  // grow for 10^5 sweeps, and the error remains unknown.
  class GrainStressError
  {
  public:
    // Call with growing numbers of sweeps. Moments are wanted at 100, 200, 400, ... sweeps.
    bool wants(long sweeps) const { return sweeps >= next_; }
    void observe(std::vector<double> moments);

    double estimate() const; // infinity if it is unknown
    bool   hopeless() const; // no decrease in two successive doublings; more sweeps will not help
    double change() const { return changes_.empty() ? std::numeric_limits<double>::infinity() : changes_.back(); } // D_k

  private:
    std::vector<double> moments_; // of the last sample
    std::vector<double> changes_; // D_k, all of them
    long                next_ = 100;
  };

  // Request of a sampled step to its solve.
  struct SampleRequest
  {
    SamplingOptions options;
    bool            measure_factor = false; // solve a copy further, towards 1e-9
    // If set, called with the problem of the step and its solution.
    std::function<void(const ContactProblem &, const std::vector<Contact> &, const std::vector<Impulse> &)> on_problem = {};
  };

  struct SampledAccuracy
  {
    double stress_error  = 0;     // estimate
    double stress_change = 0;     // in the last doubling of the sweeps
    bool   reached       = false; // below snapshot_accuracy
    // The copy that was solved further: its residual, the difference from it, and the ratio of that difference to the
    // residual. NaN if no copy was requested. The ratio is also NaN if the copy's residual is above a tenth of the first one.
    double reference_residual = std::numeric_limits<double>::quiet_NaN(), true_error = reference_residual;
    double error_over_residual = reference_residual;
  };

  struct SampledProblem
  {
    const ContactProblem       &problem;
    const std::vector<double>  &radius; // of the grains
    const std::vector<Contact> &contacts;
  };

  // Solves to the tolerance of `solver` and then further. It ends if the estimate is below the wanted accuracy or hopeless, the
  // residual below 1e-9 (estimate: 0), or no sweep is left. The ratio is measured only if the accuracy was reached. The report
  // says whether the tolerance was met, `accuracy` contains the rest.
  SolveReport solve_sampled(const SampledProblem &sampled,
                            const SolverOptions  &solver,
                            const SampleRequest  &request,
                            ThreadTeam           &team,
                            std::vector<Impulse> &impulses,
                            SampledAccuracy      &accuracy);
} // namespace diptych::discrete
