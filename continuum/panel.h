// diptych: the continuum panel from mesh and loading to snapshots and history
// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include <Eigen/Core>

#include "continuum/laws/options.h"
#include "continuum/loading.h"
#include "continuum/snapshot.h"

namespace diptych::continuum
{
  struct Options
  {
    std::string law                   = "cosserat_mohr_coulomb";
    std::string element               = "auto";
    std::string geometry              = "updated";
    std::string platens               = "rough";
    std::string platen_rotation       = "free";
    std::string initial_stress        = "isotropic";
    std::string mesh                  = "outline";
    double      rectangle_width       = 0;
    double      rectangle_height      = 0;
    double      platen_width          = 0;
    double      element_size          = 2;
    std::string refinement            = "uniform";
    int         refinement_levels     = 1;
    double      refinement_threshold  = 0.2;
    std::string linear_solver         = "auto";
    double      initial_step          = 1e-3;
    double      max_step              = 5e-3;
    double      min_step              = 1e-5;
    double      tolerance             = 1e-5;
    int         max_newton_iterations = 20;
    double      weak_spot_strain      = 0;
    double      weak_spot_radius      = 2;
    double      weak_spot_x           = 0.5;
    double      weak_spot_y           = 0.5;
    double      checkpoint_minutes    = 10;
    LawOptions  material;
  };

  // Lists the panel's own keys first, then those of the law; all names are distinct.
  template <class Visitor> void visit_parameters(Options &o, Visitor &&visitor)
  {
    visitor("law", o.law, "-",
            {"cosserat_mohr_coulomb", "cosserat_drucker_prager", "mohr_coulomb", "drucker_prager", "linear_elastic"},
            "constitutive law; the two with Cosserat rotations have an internal length, the band of a local law that softens is "
            "set by the mesh");
    visitor("element", o.element, "-", {"auto", "q2", "q1_bbar"},
            "displacement: biquadratic with 3x3 points, or bilinear with mean dilation; auto: q2. Cosserat laws need q2 and take "
            "bilinear rotations");
    visitor("geometry", o.geometry, "-", {"updated", "small_strain"},
            "nodes move and stress turns with the material after every step, or small strain");
    visitor("platens", o.platens, "-", {"rough", "smooth"},
            "rough: both components follow the platen; smooth: only the vertical");
    visitor("platen_rotation", o.platen_rotation, "-", {"free", "held"},
            "Cosserat laws: rotations at the platens are free (no couple) or held at zero");
    visitor("initial_stress", o.initial_stress, "-", {"isotropic", "mapped"},
            "the pressure everywhere, or the prepared grain sample's stress cell by cell, then brought to equilibrium");
    visitor(
      "mesh", o.mesh, "-", {},
      "outline: of the prepared grain sample; rectangle: of rectangle_width and rectangle_height; else a .msh file with the "
      "physical lines lower_platen, upper_platen, left_side, right_side (and free)");
    visitor("rectangle_width", o.rectangle_width, "length", {0., 1e12}, "mesh = rectangle: its width");
    visitor("rectangle_height", o.rectangle_height, "length", {0., 1e12}, "mesh = rectangle: its height");
    visitor("platen_width", o.platen_width, "length", {0., 1e12},
            "mesh = rectangle: of the upper platen, a strip in the middle of the upper edge; 0: the whole edge");
    visitor("element_size", o.element_size, "mean diameters", {0.01, 1e3},
            "edge length of an element; at most the internal length for a band that the mesh does not set");
    visitor("refinement", o.refinement, "-", {"uniform", "adaptive"},
            "adaptive: elements are larger by 2^refinement_levels at first and divided where plastic strain gathers");
    visitor("refinement_levels", o.refinement_levels, "-", {1., 6.}, "adaptive: divisions down to element_size");
    visitor("refinement_threshold", o.refinement_threshold, "-", {1e-6, 1.},
            "adaptive: an element is divided whose plastic strain in a step exceeds this share of the largest");
    visitor("linear_solver", o.linear_solver, "-", {"auto", "direct", "amg"},
            "direct: UMFPACK on one process, MUMPS on several; amg: ML with GMRES; auto: by size");
    visitor("initial_step", o.initial_step, "axial strain", {1e-9, 1e6}, "first load step");
    visitor("max_step", o.max_step, "axial strain", {1e-9, 1e6}, "largest load step");
    visitor("min_step", o.min_step, "axial strain", {1e-12, 1e6},
            "smallest load step; below it the run stops and says how far it got");
    visitor("tolerance", o.tolerance, "-", {1e-12, 1e-1}, "unbalanced nodal force relative to the reaction forces");
    visitor("max_newton_iterations", o.max_newton_iterations, "-", {1., 1000.}, "Newton iterations before a step is halved");
    visitor(
      "weak_spot_strain", o.weak_spot_strain, "-", {0., 10.},
      "hardening variable at the start in the middle of a weak spot, for samples that would else stay homogeneous; 0: none");
    visitor("weak_spot_radius", o.weak_spot_radius, "mean diameters", {1e-6, 1e6}, "of the weak spot, a Gaussian's deviation");
    visitor("weak_spot_x", o.weak_spot_x, "widths", {0., 1.}, "place of the weak spot");
    visitor("weak_spot_y", o.weak_spot_y, "heights", {0., 1.}, "place of the weak spot");
    visitor("checkpoint_minutes", o.checkpoint_minutes, "min", {0., 1e6},
            "wall-clock time between checkpoints; 0: after every step");
    visit_parameters(o.material, visitor);
  }

  // One accepted load step; counters and seconds are cumulative. Stress positive in compression, forces act on the sample.
  struct HistoryRow
  {
    int             step               = 0;
    double          axial_strain       = 0;                       // progress: platen descent / initial height
    double          stress_ratio       = 0;                       // t/s of the mean stress
    double          volumetric_strain  = 0;                       // 1 - V/V0, dilation negative
    Eigen::Matrix3d mean_stress        = Eigen::Matrix3d::Zero(); // [pressure]
    Eigen::Vector2d lower_platen_force = Eigen::Vector2d::Zero(); // [pressure * length]
    Eigen::Vector2d upper_platen_force = Eigen::Vector2d::Zero();
    int             n_cells = 0, n_unknowns = 0;
    int             newton_iterations = 0, linear_iterations = 0, factorisations = 0, cut_backs = 0;
    double          plastic_share                 = 0; // of the area, yielding in this step
    double          unreliable_share              = 0; // of the area, where the law calls its answer unreliable
    double          share_zz_not_intermediate     = 0; // of the area
    double          viscous_share                 = 0; // overstress / shear strength of the law, mean over the yielding area
    double          max_equivalent_plastic_strain = 0;
    double          dissipation                   = 0; // plastic work since the start [pressure * length^2]
    double          least_acoustic_determinant    = 1; // relative to the elastic one
    double          localisation_angle            = 0; // where it is least [degrees from the horizontal]
    double          point_cpu_s = 0, assembly_cpu_s = 0, solve_cpu_s = 0, geometry_cpu_s = 0; // on the first process
  };

  enum class Status
  {
    finished,
    stopped_by_user,
    not_converged
  };

  struct Report
  {
    Status                status       = Status::finished;
    double                axial_strain = 0; // reached
    std::string           message;          // how it ended and, if early, why
    unsigned int          n_cells = 0, n_unknowns = 0;
    int                   steps = 0, cut_backs = 0, newton_iterations = 0;
    std::optional<double> localisation_strain;    // axial strain at which the acoustic tensor first had a negative determinant
    double                localisation_angle = 0; // of the line that could form there [degrees from the horizontal]
  };

  // All optional. With several processes, on_stage and on_step are called on the first one only and stop_requested on all.
  struct Callbacks
  {
    std::function<bool()>                   stop_requested; // asked before every step; true ends the run with stopped_by_user
    std::function<void(const Snapshot &)>   on_stage;       // at every stage, and where the run ends early
    std::function<void(const HistoryRow &)> on_step;        // after every accepted step, the initial state included (step 0)
    // Stress of every cell of the unloaded mesh, positive in compression, 2x2 in the plane; for initial_stress = mapped.
    std::function<std::vector<Eigen::Matrix2d>(const Snapshot &)> initial_stress;
    std::string                                                   checkpoint_file; // empty: none is written
    bool resume = false; // from checkpoint_file; rows and stages before it are not told again
  };

  // Throws std::invalid_argument naming key, value and what is allowed.
  void validate(const Options &options);

  // Run the panel on a mesh made by make_mesh or the user's own with the ids of BoundaryId. `mean_diameter` is the length that
  // keys in mean diameters refer to. Every stage is landed on exactly. MPI must have been initialised
  // (dealii::Utilities::MPI::MPI_InitFinalize); any number of processes may call it together, with the same arguments.
  // Throws std::invalid_argument for bad input and std::runtime_error for a file that cannot be used.
  [[nodiscard]] Report run(const std::string &msh_file,
                           double             mean_diameter,
                           const Loading     &loading,
                           const Options     &options,
                           const Callbacks   &callbacks = {});
} // namespace diptych::continuum
