// diptych: the continuum panel from mesh and loading to snapshots and history
// SPDX-License-Identifier: LGPL-2.1-or-later
#include "continuum/panel.h"

#include <sstream>
#include <stdexcept>

#include "continuum/boundary_value_problem.h"
#include "continuum/driver.h"
#include "continuum/mesh.h"
#include "continuum/sample_state.h"

namespace diptych::continuum
{
  namespace
  {
    template <class... Text> void require(const bool holds, const Text &...text)
    {
      if (holds)
        return;
      std::ostringstream message;
      (message << ... << text);
      throw std::invalid_argument(message.str());
    }

    Law make_law(const Options &options)
    {
      if (options.law == "linear_elastic")
        return LinearElastic(options.mohr_coulomb.elastic);
      return MohrCoulomb(options.mohr_coulomb);
    }

    void require_one_process()
    {
      if (dealii::Utilities::MPI::n_mpi_processes(MPI_COMM_WORLD) != 1)
        throw std::runtime_error("the continuum panel runs on one process so far; start it without mpirun");
    }

    // One run: the problem, its driver and who listens.
    struct Run
    {
      BoundaryValueProblem problem;
      LoadDriver           driver;
      const Callbacks     &callbacks;
      bool                 stopped = false;

      Run(const std::string &msh_file, const Loading &loading, const Options &options, const Callbacks &callbacks)
          : problem(msh_file, loading, make_law(options)),
            driver(problem, options),
            callbacks(callbacks)
      {}

      // Tells about the accepted step; false ends the run.
      bool after_step()
      {
        if (callbacks.on_step)
          callbacks.on_step(make_history_row(problem, driver));
        stopped = callbacks.stop_requested && callbacks.stop_requested();
        return !stopped;
      }

      void hand_over_stage() const
      {
        if (callbacks.on_stage)
          callbacks.on_stage(make_snapshot(problem));
      }

      // Empty, or why it ended early.
      std::string through(const std::vector<double> &stages)
      {
        if (const auto why = driver.equilibrate(); !why.empty())
          return why;
        if (!after_step())
          return "stopped on request";
        for (const double stage : stages)
          {
            const auto why     = driver.advance(stage, [&] { return after_step(); });
            const bool reached = problem.axial_strain() == stage;
            if (reached || problem.axial_strain() > 0)
              hand_over_stage();
            if (!why.empty())
              return why;
            if (stopped && !(reached && stage == stages.back()))
              return "stopped on request";
          }
        stopped = false;
        return {};
      }
    };
  } // namespace

  void validate(const Loading &loading)
  {
    require(loading.pressure > 0, "pressure = ", loading.pressure, " must be positive");
    require(loading.upper_platen_travel.allFinite() && loading.upper_platen_travel.y() < 0, "upper_platen_travel = (",
            loading.upper_platen_travel.transpose(), "): the upper platen must descend");
    require(loading.platens == "rough" || loading.platens == "smooth", "platens = '", loading.platens,
            "' must be rough or smooth");
    require(!loading.stages.empty(), "stages: at least one axial strain is needed");
    for (std::size_t i = 0; i < loading.stages.size(); ++i)
      require(loading.stages[i] >= 0 && loading.stages[i] < 1 && (i == 0 || loading.stages[i] > loading.stages[i - 1]),
              "stages: ", loading.stages[i], " is not ascending within [0, 1)");
  }

  void validate(const Options &options)
  {
    require(options.law == "mohr_coulomb" || options.law == "linear_elastic", "law = '", options.law,
            "' must be mohr_coulomb or linear_elastic");
    require(options.min_step > 0 && options.min_step <= options.initial_step && options.initial_step <= options.max_step,
            "steps: 0 < min_step = ", options.min_step, " <= initial_step = ", options.initial_step,
            " <= max_step = ", options.max_step, " is needed");
    require(options.tolerance > 0 && options.tolerance < 1, "tolerance = ", options.tolerance, " must lie in (0, 1)");
    require(options.max_newton_iterations > 0, "max_newton_iterations = ", options.max_newton_iterations, " must be positive");
    validate(options.mohr_coulomb);
  }

  Report run(const std::string &msh_file, const Loading &loading, const Options &options, const Callbacks &callbacks)
  {
    validate(loading);
    validate(options);
    require_one_process();
    const auto mesh = check_mesh(msh_file);

    Run    panel(msh_file, loading, options, callbacks);
    Report report;
    report.message      = panel.through(loading.stages);
    report.axial_strain = panel.problem.axial_strain();
    report.status  = panel.stopped ? Status::stopped_by_user : report.message.empty() ? Status::finished : Status::not_converged;
    report.n_cells = mesh.n_cells;
    report.n_unknowns        = panel.problem.discretisation().dof_handler.n_dofs();
    report.steps             = panel.driver.counts().steps;
    report.cut_backs         = panel.driver.counts().cut_backs;
    report.newton_iterations = panel.driver.counts().newton_iterations;
    if (report.message.empty())
      report.message = "finished";
    return report;
  }
} // namespace diptych::continuum
