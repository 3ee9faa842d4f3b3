// diptych: the continuum panel, a sample on a mesh loaded through a list of stages
// SPDX-License-Identifier: LGPL-2.1-or-later
#include "continuum/panel/panel.h"

#include <array>
#include <cmath>

#include <deal.II/base/mpi.h>

#include "continuum/equilibrium/driver.h"
#include "continuum/panel/problem_checkpoint.h"
#include "continuum/panel/point_values.h"
#include "continuum/panel/sample_state.h"
#include "continuum/require.h"

namespace diptych::continuum
{
  namespace
  {
    QuadMesh checked(const QuadMesh &mesh, const Loading &loading, const Options &options)
    {
      validate(loading);
      validate(options);
      check(mesh);
      require(!std::holds_alternative<PeriodicSides>(loading.lateral) ||
                (summarise(mesh).sides_match && options.refinement == Refinement::uniform),
              "lateral = periodic needs sides that match node by node and refinement = uniform");
      return mesh;
    }

    void check_places(const Discretisation &mesh)
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
                    "mesh: the ", id == lower_platen ? "lower" : "upper", " platen is not level at x = ", node.initial.x(),
                    ", y = ", node.initial.y());
        }
      require(mean[upper_platen].y() > mean[lower_platen].y(), "mesh: upper_platen lies below lower_platen");
      require(mean[left_side].x() < mean[right_side].x(), "mesh: left_side lies to the right of right_side");
    }

    // Ways out if a step fails. A local law that softens or whose flow is not associated may lose its solution (Rudnicki and Rice
    // 1975). Its constant associated form keeps a unique stress.
    std::string advice(const Options &options)
    {
      const LawTraits   is       = traits(options.law);
      const LawOptions &material = options.material;
      if (!is.is_plastic || is.has_length() || material.viscosity > 0 ||
          (material.hardening == kind_of<ConstantHardening> && material.dilatancy_angle_peak == material.friction_angle_peak))
        return "";
      return ". " + name_of(options.law) +
             " has neither an internal length nor viscosity: where it softens, or where its dilatancy angle is below its "
             "friction "
             "angle, a step may have no solution. A Cosserat law (continuum/law = cosserat_mohr_coulomb), continuum/viscosity or "
             "a smaller difference of the two angles helps";
    }
  } // namespace

  class Panel::Course
  {
  public:
    Course(const QuadMesh &mesh,
           const Units    &units,
           const Loading  &loading,
           const Options  &options,
           Hooks           hooks,
           const MPI_Comm  communicator)
        : loading_(loading),
          options_(options),
          hooks_(std::move(hooks)),
          communicator_(communicator),
          problem_(checked(mesh, loading, options), units, loading, options, communicator, hooks_.check_stop),
          driver_(problem_, options, stop_request())
    {
      check_places(problem_.discretisation());
      describe();
    }

    Report report;
    int    stage = 0;

    void set_initial_stress(const std::vector<Eigen::Matrix2d> &stress)
    {
      std::vector<double> numbers;
      for (const auto &tensor : stress)
        numbers.insert(numbers.end(), tensor.data(), tensor.data() + 4);
      numbers = local_part(numbers, 4, "initial stress");
      std::vector<Eigen::Matrix2d> of_mine;
      for (std::size_t c = 0; c < numbers.size(); c += 4)
        of_mine.push_back(Eigen::Map<const Eigen::Matrix2d>(&numbers[c]));
      problem_.set_initial_stress(of_mine);
      has_stress_ = true;
    }

    void set_initial_solid_fraction(const std::vector<double> &solid_fraction)
    {
      problem_.set_initial_solid_fraction(local_part(solid_fraction, 1, "initial solid fraction"));
      has_solid_fraction_ = true;
    }

    void prepare()
    {
      require(options_.initial_stress == InitialStress::isotropic || has_stress_,
              "initial_stress = mapped: no stress was given to map");
      require(!follows_solid_fraction(options_.material.hardening) || !traits(options_.law).is_plastic ||
                options_.material.solid_fraction_start || has_solid_fraction_,
              "solid_fraction_start = auto: no solid fraction was given to map");
      if (report.status == Status::stopped_by_user)
        report = resumed(report);
      if (const auto why = driver_.equilibrate(); !why.empty())
        return end_early(why);
      is_at_rest_ = true;
      report_row();
    }

    void load_to_stage(const int wanted)
    {
      require(wanted <= int(loading_.stages.size()), "stage ", wanted, " does not exist; last stage: ", loading_.stages.size());
      if (report.status == Status::stopped_by_user && !is_at_rest_)
        prepare();
      else if (report.status == Status::stopped_by_user)
        report = resumed(report);
      while (stage < wanted && report.status == Status::finished)
        {
          const double end = loading_.stages[std::size_t(stage)];
          while (problem_.progress() < end && report.status == Status::finished)
            step(end);
          if (report.status == Status::finished)
            ++stage;
        }
    }

    void resume(const Checkpoint &of_this_process)
    {
      const Checkpoint checkpoint = of_first_process(of_this_process, communicator_);
      restore(checkpoint, problem_, driver_);
      is_at_rest_                  = true;
      stage                        = checkpoint.stage;
      report.localisation_progress = checkpoint.localisation_progress;
      report.localisation_angle    = checkpoint.localisation_angle;
      describe();
    }

    Checkpoint checkpoint() const
    {
      Checkpoint checkpoint            = make_checkpoint(problem_, driver_);
      checkpoint.stage                 = stage;
      checkpoint.localisation_progress = report.localisation_progress;
      checkpoint.localisation_angle    = report.localisation_angle;
      return checkpoint;
    }

    Snapshot snapshot() const { return make_snapshot(problem_, loading_); }

  private:
    // Returns this process's part of the first process's numbers: `width` per cell, in the order of the cells in the snapshot.
    std::vector<double> local_part(const std::vector<double> &given, const std::size_t width, const char *what) const
    {
      const std::vector<double> numbers = dealii::Utilities::MPI::broadcast(communicator_, given);
      const unsigned int        mine    = problem_.discretisation().cells.size();
      unsigned int              first   = 0;
      MPI_Exscan(&mine, &first, 1, MPI_UNSIGNED, MPI_SUM, communicator_);
      if (is_first_process())
        first = 0; // MPI leaves it undefined there
      require(numbers.size() == width * problem_.discretisation().triangulation.n_global_active_cells(), what, ": ",
              numbers.size() / width, " values for ", problem_.discretisation().triangulation.n_global_active_cells(), " cells");
      return {numbers.begin() + std::ptrdiff_t(width * first), numbers.begin() + std::ptrdiff_t(width * (first + mine))};
    }

    bool is_first_process() const { return dealii::Utilities::MPI::this_mpi_process(communicator_) == 0; }

    StopRequest stop_request() const
    {
      return hooks_.stop_requested ? StopRequest([this] { return stop_requested(); }) : StopRequest();
    }

    bool stop_requested() const
    {
      const bool asked = hooks_.stop_requested && hooks_.stop_requested();
      return dealii::Utilities::MPI::max(int(asked), communicator_) == 1;
    }

    static Report resumed(Report report)
    {
      report.status = Status::finished; // the run continues now
      report.message.clear();
      return report;
    }

    void step(const double end)
    {
      if (hooks_.before_step)
        hooks_.before_step();
      if (stop_requested())
        return note_stop();
      if (const auto why = driver_.step_towards(end); !why.empty())
        return end_early(why + advice(options_));
      report_row();
    }

    void note_stop()
    {
      report.status  = Status::stopped_by_user;
      report.message = "stopped on request";
    }

    void end_early(const std::string &why)
    {
      report.status  = Status::not_converged;
      report.message = "stopped at " + text_of(loading_.loading_variable, problem_.progress()) + ": " + why;
      if (driver_.was_stopped())
        note_stop();
      describe();
    }

    void report_row()
    {
      const auto row = make_history_row(problem_, driver_, loading_);
      if (row.step > 0 && !report.localisation_progress && row.least_acoustic_determinant <= 0)
        {
          report.localisation_progress = row.progress;
          report.localisation_angle    = row.localisation_angle;
        }
      describe();
      if (!is_first_process())
        return;
      if (hooks_.on_row)
        hooks_.on_row(row);
      if (hooks_.on_progress)
        hooks_.on_progress("continuum", row.progress / loading_.stages.back());
    }

    void describe()
    {
      const Progress now       = progress_of(problem_, loading_);
      report.progress          = now.progress;
      report.axial_strain      = now.axial_strain;
      report.shear_strain      = now.shear_strain;
      report.n_cells           = int(problem_.discretisation().triangulation.n_global_active_cells());
      report.n_unknowns        = int(problem_.discretisation().dof_handler.n_dofs());
      report.processes         = int(dealii::Utilities::MPI::n_mpi_processes(communicator_));
      report.steps             = driver_.state().count.steps;
      report.cut_backs         = driver_.state().count.cut_backs;
      report.newton_iterations = driver_.state().count.newton_iterations;
    }

    Loading              loading_;
    Options              options_;
    Hooks                hooks_;
    MPI_Comm             communicator_;
    BoundaryValueProblem problem_;
    LoadDriver           driver_;
    bool                 has_stress_         = false;
    bool                 has_solid_fraction_ = false;
    bool                 is_at_rest_         = false; // true once equilibrium at rest was found
  };

  Panel::Panel(const QuadMesh &mesh,
               const Units    &units,
               const Loading  &loading,
               const Options  &options,
               Hooks           hooks,
               const MPI_Comm  communicator)
      : course(std::make_unique<Course>(mesh, units, loading, options, std::move(hooks), communicator))
  {}

  Panel::~Panel()                            = default;
  Panel::Panel(Panel &&) noexcept            = default;
  Panel &Panel::operator=(Panel &&) noexcept = default;

  void Panel::set_initial_stress(const std::vector<Eigen::Matrix2d> &stress)
  {
    course->set_initial_stress(stress);
  }

  void Panel::set_initial_solid_fraction(const std::vector<double> &solid_fraction)
  {
    course->set_initial_solid_fraction(solid_fraction);
  }

  Status Panel::prepare()
  {
    course->prepare();
    return course->report.status;
  }

  void Panel::resume(const Checkpoint &checkpoint)
  {
    course->resume(checkpoint);
  }

  Status Panel::advance_to(const int stage)
  {
    course->load_to_stage(stage);
    return course->report.status;
  }

  Snapshot Panel::snapshot() const
  {
    return course->snapshot();
  }

  Checkpoint Panel::checkpoint() const
  {
    return course->checkpoint();
  }

  const Report &Panel::report() const
  {
    return course->report;
  }

  int Panel::stage() const
  {
    return course->stage;
  }
} // namespace diptych::continuum
