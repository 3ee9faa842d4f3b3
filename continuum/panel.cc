// diptych: the continuum panel from mesh and loading to snapshots and history
// SPDX-License-Identifier: LGPL-2.1-or-later
#include "continuum/panel.h"

#include <array>
#include <chrono>
#include <cmath>
#include <memory>
#include <stdexcept>

#include <deal.II/base/mpi.h>

#include "continuum/boundary_value_problem.h"
#include "continuum/driver.h"
#include "continuum/mesh.h"
#include "continuum/problem_checkpoint.h"
#include "continuum/require.h"
#include "continuum/sample_state.h"

namespace diptych::continuum
{
  namespace
  {
    using Clock = std::chrono::steady_clock;

    bool is_first_process()
    {
      return dealii::Utilities::MPI::this_mpi_process(MPI_COMM_WORLD) == 0;
    }

    // One run: the problem, its driver and who listens.
    struct Run
    {
      BoundaryValueProblem problem;
      LoadDriver           driver;
      const Options       &options;
      const Callbacks     &callbacks;
      std::string          identity; // of the checkpoint
      Report               report;
      bool                 stopped         = false;
      Clock::time_point    last_checkpoint = Clock::now();

      Run(const std::string &msh_file,
          const double       mean_diameter,
          const Loading     &loading,
          const Options     &options,
          const Callbacks   &callbacks)
          : problem(msh_file, mean_diameter, loading, options),
            driver(problem, options),
            options(options),
            callbacks(callbacks),
            identity(fingerprint(msh_file, mean_diameter, loading, options))
      {}

      void resume()
      {
        const auto checkpoint = read_checkpoint(callbacks.checkpoint_file);
        if (checkpoint.fingerprint != identity)
          throw std::runtime_error(callbacks.checkpoint_file + ": belongs to another mesh, loading or set of options");
        restore(checkpoint, problem, driver);
        if (checkpoint.counts.at("localised") == 1)
          report.localisation_strain = checkpoint.scalars.at("localisation_strain");
        report.localisation_angle = checkpoint.scalars.at("localisation_angle");
      }

      void write_checkpoint_file()
      {
        if (callbacks.checkpoint_file.empty())
          return;
        auto checkpoint                           = make_checkpoint(problem, driver);
        checkpoint.fingerprint                    = identity;
        checkpoint.counts["localised"]            = report.localisation_strain.has_value();
        checkpoint.scalars["localisation_strain"] = report.localisation_strain.value_or(0);
        checkpoint.scalars["localisation_angle"]  = report.localisation_angle;
        if (is_first_process())
          write_checkpoint(callbacks.checkpoint_file, checkpoint);
        last_checkpoint = Clock::now();
      }

      bool checkpoint_is_due() const
      {
        const std::chrono::duration<double> passed = Clock::now() - last_checkpoint;
        return dealii::Utilities::MPI::max(int(passed.count() >= 60 * options.checkpoint_minutes), MPI_COMM_WORLD) == 1;
      }

      // Tells about the accepted step; false ends the run.
      bool after_step()
      {
        const auto row = make_history_row(problem, driver);
        if (row.step > 0 && !report.localisation_strain && row.least_acoustic_determinant <= 0)
          {
            report.localisation_strain = row.axial_strain;
            report.localisation_angle  = row.localisation_angle;
          }
        if (callbacks.on_step && is_first_process())
          callbacks.on_step(row);
        if (checkpoint_is_due())
          write_checkpoint_file();
        const bool asked = callbacks.stop_requested && callbacks.stop_requested();
        stopped          = dealii::Utilities::MPI::max(int(asked), MPI_COMM_WORLD) == 1;
        return !stopped;
      }

      void hand_over_stage() const
      {
        if (!callbacks.on_stage)
          return;
        const auto snapshot = make_snapshot(problem);
        if (is_first_process())
          callbacks.on_stage(snapshot);
      }

      // The snapshot lists the cells of all processes one after the other.
      void map_initial_stress()
      {
        const auto                   snapshot = make_snapshot(problem);
        std::vector<Eigen::Matrix2d> all;
        if (is_first_process())
          all = callbacks.initial_stress(snapshot);
        std::vector<double> numbers;
        for (const auto &tensor : all)
          numbers.insert(numbers.end(), tensor.data(), tensor.data() + 4);
        numbers                  = dealii::Utilities::MPI::broadcast(MPI_COMM_WORLD, numbers);
        const unsigned int mine  = problem.discretisation().cells.size();
        unsigned int       first = 0;
        MPI_Exscan(&mine, &first, 1, MPI_UNSIGNED, MPI_SUM, MPI_COMM_WORLD);
        if (is_first_process())
          first = 0; // MPI leaves it undefined there
        std::vector<Eigen::Matrix2d> stress;
        for (unsigned int c = 0; c < mine; ++c)
          stress.push_back(Eigen::Map<const Eigen::Matrix2d>(&numbers[4 * (first + c)]));
        problem.set_initial_stress(stress);
      }

      // Empty, or why it did not come to rest.
      std::string begin()
      {
        if (options.initial_stress == "mapped")
          map_initial_stress();
        if (const auto why = driver.equilibrate(); !why.empty())
          return why;
        return after_step() ? "" : "stopped on request";
      }

      // Empty, or why it ended early.
      std::string through(const std::vector<double> &stages)
      {
        if (callbacks.resume)
          resume();
        else if (const auto why = begin(); !why.empty())
          return why;
        for (const double stage : stages)
          {
            if (callbacks.resume && stage <= problem.progress() && !(driver.state().count.steps == 0 && stage == 0))
              continue; // told before the interruption
            const auto why     = driver.advance(stage, [&] { return after_step(); });
            const bool reached = problem.progress() == stage;
            if (reached || problem.progress() > 0)
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

  namespace
  {
    // Both platens are level, the upper one above, and the left side is left of the right one.
    void check_places(const std::string &msh_file, const Discretisation &mesh)
    {
      std::array<Eigen::Vector2d, 5> mean;
      for (const unsigned int id : {lower_platen, upper_platen, left_side, right_side})
        {
          const auto nodes = mesh.boundary_nodes(id);
          mean[id].setZero();
          for (const auto &node : nodes)
            mean[id] += node.initial / double(nodes.size());
          for (const auto &node : nodes)
            require((id != lower_platen && id != upper_platen) ||
                      std::abs(node.initial.y() - mean[id].y()) < 1e-6 * mesh.extent.y(),
                    msh_file, ": the ", id == lower_platen ? "lower" : "upper", " platen is not level at x = ", node.initial.x(),
                    ", y = ", node.initial.y());
        }
      require(mean[upper_platen].y() > mean[lower_platen].y(), msh_file, ": upper_platen lies below lower_platen");
      require(mean[left_side].x() < mean[right_side].x(), msh_file, ": left_side lies to the right of right_side");
    }
  } // namespace

  void validate(const Options &options)
  {
    require(options.min_step > 0 && options.min_step <= options.initial_step && options.initial_step <= options.max_step,
            "steps: 0 < min_step = ", options.min_step, " <= initial_step = ", options.initial_step,
            " <= max_step = ", options.max_step, " is needed");
    require(options.tolerance > 0 && options.tolerance < 1, "tolerance = ", options.tolerance, " must lie in (0, 1)");
    require(options.max_newton_iterations > 0, "max_newton_iterations = ", options.max_newton_iterations, " must be positive");
    require(options.law.rfind("cosserat", 0) != 0 || options.element != "q1_bbar", "element = ", options.element,
            " with law = ", options.law, ": Cosserat laws need q2 (equal orders of displacement and rotation lock)");
    require(options.mesh != "rectangle" || (options.rectangle_width > 0 && options.rectangle_height > 0),
            "rectangle_width = ", options.rectangle_width, ", rectangle_height = ", options.rectangle_height,
            ": mesh = rectangle needs both");
    (void)make_law(options.law, options.material); // checks its own parameters
  }

  Report run(const std::string &msh_file,
             const double       mean_diameter,
             const Loading     &loading,
             const Options     &options,
             const Callbacks   &callbacks)
  {
    validate(loading);
    validate(options);
    require(options.initial_stress != "mapped" || callbacks.initial_stress, "initial_stress = mapped: there is no stress to map");
    require(!callbacks.resume || !callbacks.checkpoint_file.empty(), "resume: no checkpoint file is named");
    const auto mesh = check_mesh(msh_file);
    require(!std::holds_alternative<PeriodicSides>(loading.lateral) || (mesh.sides_match && options.refinement == "uniform"),
            "lateral = periodic needs sides that match node by node and refinement = uniform");

    Run panel(msh_file, mean_diameter, loading, options, callbacks);
    check_places(msh_file, panel.problem.discretisation());
    auto &report        = panel.report;
    report.message      = panel.through(loading.stages);
    report.axial_strain = panel.problem.progress();
    report.status  = panel.stopped ? Status::stopped_by_user : report.message.empty() ? Status::finished : Status::not_converged;
    report.n_cells = panel.problem.discretisation().triangulation.n_global_active_cells();
    report.n_unknowns        = panel.problem.discretisation().dof_handler.n_dofs();
    report.steps             = panel.driver.state().count.steps;
    report.cut_backs         = panel.driver.state().count.cut_backs;
    report.newton_iterations = panel.driver.state().count.newton_iterations;
    if (report.status == Status::stopped_by_user)
      panel.write_checkpoint_file();
    if (report.message.empty())
      report.message = "finished";
    return report;
  }
} // namespace diptych::continuum
