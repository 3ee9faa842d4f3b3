// diptych: the loop around the sweeps of any solver
// SPDX-License-Identifier: LGPL-2.1-or-later
#include "discrete/solvers/iteration.h"

#include <algorithm>
#include <ctime>
#include <limits>
#include <stdexcept>

namespace diptych::discrete
{
  namespace
  {
    // Plain sweeps in every cycle of a hundred. They remove the error that over-relaxation leaves at the Coulomb bound.
    constexpr int plain_sweeps = 10, cycle = 100;

    // Remedy against stagnation, i.e. a residual that has not halved within `patience` sweeps. Sheared rigid grains have just
    // enough contacts, and some of these slide without a stable balance. If these are few, they are swept by themselves
    // (stall_relief.h). Otherwise the sweeps wander from one set of sliding contacts to the next until they converge on one.
    // Plain sweeps wander longest. Then omega moves to another of a few values, in turn, because the states differ on which
    // different omegas circle.
    class StagnationControl
    {
    public:
      explicit StagnationControl(const double omega)
          : omega_(omega)
      {}

      double omega() const { return 1 + shares[turn_ % 4] * (omega_ - 1); }

      bool stagnates(const long sweeps, const double residual)
      {
        if (residual < 0.5 * reference_)
          {
            reference_ = residual;
            since_     = sweeps;
          }
        return sweeps - since_ >= patience_;
      }

      void change_omega(const long sweeps, const double residual)
      {
        ++turn_;
        reference_ = residual;
        since_     = sweeps;
        patience_  = long_patience;
      }

      // If some contacts are swept by themselves, fewer sweeps show whether the others converge.
      void start_again(const long sweeps, const double residual)
      {
        turn_      = 0;
        reference_ = 2 * residual;
        since_     = sweeps;
        patience_  = short_patience;
      }

    private:
      static constexpr long   long_patience = 3000, short_patience = 1000;
      static constexpr double shares[4] = {1, 0.75, 0.875, 0.625};

      double omega_, reference_ = std::numeric_limits<double>::infinity();
      long   since_ = 0, turn_ = 0, patience_ = long_patience;
    };

    // Makes the sweeps up to the next check, and counts them.
    void sweep_until_check(const SolverOptions &options, const Iteration &iteration, const double omega, long &sweeps)
    {
      const long until = std::min<long>(sweeps + options.sweeps_per_check, options.max_sweeps);
      while (sweeps < until)
        {
          const long at   = sweeps % cycle;
          const bool fast = options.solver == ContactSolver::psor && at < cycle - plain_sweeps;
          const long end  = sweeps + (fast ? cycle - plain_sweeps : cycle) - at;
          const int  n    = int(std::min(end, until) - sweeps);
          iteration.sweep(fast ? omega : 1., fast ? options.omega_slipping : 1., n);
          sweeps += n;
        }
    }
  } // namespace

  SolveReport iterate(const SolverOptions &options, const Iteration &iteration)
  {
    constexpr long     sweeps_per_refresh = 1000; // keeps the round-off of the running velocities below 1e-13
    const std::clock_t begin              = std::clock();
    StagnationControl  control(options.omega_sticking);
    SolveReport        report;
    long               refreshed = 0;
    const auto         measure   = [&](const bool fresh) {
      if (fresh)
        {
          iteration.refresh();
          refreshed = report.sweeps;
        }
      report.residual = iteration.residual();
    };
    const auto good = [&] {
      if (!(report.residual <= options.tolerance))
        return false;
      report.velocity_error = iteration.velocity_error();
      return report.velocity_error <= options.velocity_tolerance && (!iteration.good_enough || iteration.good_enough(report));
    };
    measure(true);
    bool stopped = false, done = good();
    while (!done && report.sweeps < options.max_sweeps)
      {
        stopped = options.stop_requested && options.stop_requested();
        if (stopped)
          break;
        sweep_until_check(options, iteration, control.omega(), report.sweeps);
        measure(report.sweeps - refreshed >= sweeps_per_refresh);
        if (report.residual <= options.tolerance && refreshed != report.sweeps)
          measure(true);
        done = good();
        if (done || !control.stagnates(report.sweeps, report.residual))
          continue;
        if (iteration.relieve && iteration.relieve())
          control.start_again(report.sweeps, report.residual);
        else
          control.change_omega(report.sweeps, report.residual);
      }
    if (!done && refreshed != report.sweeps)
      {
        measure(true);
        done = good();
      }
    if (!done)
      {
        report.velocity_error = iteration.velocity_error();
        report.status         = stopped ? SolveStatus::stopped : SolveStatus::max_sweeps_reached;
      }
    report.cpu_s = double(std::clock() - begin) / CLOCKS_PER_SEC;
    return report;
  }
} // namespace diptych::discrete
