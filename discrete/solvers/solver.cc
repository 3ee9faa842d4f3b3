// diptych: sweeps, checked from outside, until the residual is small
// SPDX-License-Identifier: LGPL-2.1-or-later
#include "discrete/solvers/solver.h"

#include <algorithm>
#include <ctime>
#include <limits>
#include <stdexcept>

#include "discrete/solvers/batched_sweep.h"
#include "discrete/solvers/sweeps.h"

namespace diptych::discrete
{
  namespace
  {
    // Plain sweeps within every hundred over-relaxed ones: they take out what over-relaxation leaves at the Coulomb bound.
    constexpr int plain_sweeps = 10, cycle = 100;

    // Over-relaxation can end in a limit cycle. Where the residual has not halved within `patience` sweeps, omega moves a
    // third of its way towards 1; each halving starts a new count.
    class StagnationControl
    {
    public:
      explicit StagnationControl(const double omega)
          : omega_(omega)
      {}

      double omega() const { return omega_; }

      void observe(const long sweeps, const double residual)
      {
        if (residual < 0.5 * reference_)
          reference_ = residual, since_ = sweeps;
        else if (sweeps - since_ >= patience)
          omega_ = 1 + 2. / 3 * (omega_ - 1), since_ = sweeps;
      }

    private:
      static constexpr long patience = 1000;

      double omega_, reference_ = std::numeric_limits<double>::infinity();
      long   since_ = 0;
    };
  } // namespace

  SolveReport solve(const ContactProblem &problem, const SolverOptions &options, std::vector<Impulse> &impulses)
  {
    if (options.solver != "psor" && options.solver != "nsgs")
      throw std::invalid_argument("unknown contact solver '" + options.solver + "': psor or nsgs");
    const bool over_relaxed = options.solver == "psor";

    const std::clock_t begin = std::clock();
    StagnationControl  control(options.omega_sticking);
    SolveReport        report;
    report.residual = natural_map_residual(problem, impulses);
    if (report.residual > options.tolerance)
      {
        BatchedContacts batches(problem);
        while (report.residual > options.tolerance && report.sweeps < options.max_sweeps)
          {
            // Velocities are taken afresh from the impulses after every check, so that round-off does not pile up.
            std::vector<BodyVelocity> v     = velocities(problem, impulses);
            const long                until = std::min<long>(report.sweeps + options.sweeps_per_check, options.max_sweeps);
            batches.set_impulses(impulses);
            for (; report.sweeps < until; ++report.sweeps)
              if (!over_relaxed)
                sweep_nsgs(problem, v, impulses);
              else if (report.sweeps % cycle < cycle - plain_sweeps)
                batches.sweep(control.omega(), options.omega_slipping, v);
              else
                batches.sweep(1., 1., v);
            if (over_relaxed)
              impulses = batches.impulses();
            report.residual = natural_map_residual(problem, impulses);
            control.observe(report.sweeps, report.residual);
          }
      }
    if (!(report.residual <= options.tolerance))
      report.status = SolveStatus::max_sweeps_reached;
    report.cpu_s = double(std::clock() - begin) / CLOCKS_PER_SEC;
    return report;
  }
} // namespace diptych::discrete
