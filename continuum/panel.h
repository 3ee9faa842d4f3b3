// diptych: the continuum panel from mesh and loading to snapshots and history
// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <functional>
#include <string>
#include <vector>

#include <Eigen/Core>

#include "continuum/laws/mohr_coulomb.h"
#include "continuum/snapshot.h"

namespace diptych::continuum
{
  // What is done to the sample: the lower platen is fixed, the upper one moves on a straight line, both sides carry a
  // pressure that acts horizontally per unit of current height.
  struct Loading
  {
    double              pressure            = 1;                       // lateral, and initial isotropic stress [pressure]
    Eigen::Vector2d     upper_platen_travel = Eigen::Vector2d::Zero(); // displacement per unit axial strain: (H, -H) [length]
    std::vector<double> stages;            // axial strains of the snapshots, ascending; the last is the end
    std::string         platens = "rough"; // rough: both components prescribed; smooth: only the vertical one
  };

  struct Options
  {
    std::string        law          = "mohr_coulomb";
    double             element_size = 2;    // [mean diameters]; used by whoever makes the mesh, not by run()
    double             initial_step = 1e-3; // axial strain
    double             max_step     = 5e-3; // axial strain; more smears the peak
    double             min_step     = 1e-5; // axial strain; below it the run gives up and says so
    double             tolerance    = 1e-5; // residual relative to the reaction forces; looser saves one iteration a step at most
    int                max_newton_iterations = 20;
    MohrCoulombOptions mohr_coulomb; // linear_elastic takes its elastic part
  };

  // Lists the panel's own keys first, then those of the law; all names are distinct.
  template <class Visitor> void visit_parameters(Options &o, Visitor &&visitor)
  {
    visitor("law", o.law, "", {"mohr_coulomb", "linear_elastic"}, "constitutive law");
    visitor("element_size", o.element_size, "d", {0.05, 1e3},
            "edge length of an element; a local law's band is 2-4 elements wide");
    visitor("initial_step", o.initial_step, "axial strain", {1e-9, 1.}, "first load step");
    visitor("max_step", o.max_step, "axial strain", {1e-9, 1.}, "largest load step");
    visitor("min_step", o.min_step, "axial strain", {1e-12, 1.},
            "smallest load step; below it the run stops and says how far it got");
    visitor("tolerance", o.tolerance, "-", {1e-12, 1e-1}, "unbalanced nodal force relative to the reaction forces");
    visitor("max_newton_iterations", o.max_newton_iterations, "", {1., 1000.}, "Newton iterations before a step is halved");
    visit_parameters(o.mohr_coulomb, visitor);
  }

  // One accepted load step; counters and seconds are cumulative. Stress positive in compression, forces act on the sample.
  struct HistoryRow
  {
    int             step               = 0;
    double          axial_strain       = 0;                       // platen descent / initial height
    double          stress_ratio       = 0;                       // t/s of the mean stress
    double          volumetric_strain  = 0;                       // 1 - V/V0, dilation negative
    Eigen::Matrix3d mean_stress        = Eigen::Matrix3d::Zero(); // [pressure]
    Eigen::Vector2d lower_platen_force = Eigen::Vector2d::Zero(); // [pressure * length]
    Eigen::Vector2d upper_platen_force = Eigen::Vector2d::Zero();
    int             newton_iterations = 0, linear_iterations = 0, factorisations = 0, cut_backs = 0;
    double          plastic_share                 = 0; // of the area, yielding in this step
    double          share_zz_not_intermediate     = 0; // of the area
    double          max_equivalent_plastic_strain = 0;
    double          assembly_cpu_s = 0, solve_cpu_s = 0;
  };

  enum class Status
  {
    finished,
    stopped_by_user,
    not_converged
  };

  struct Report
  {
    Status       status       = Status::finished;
    double       axial_strain = 0; // reached
    std::string  message;          // how it ended and, if early, why
    unsigned int n_cells = 0, n_unknowns = 0;
    int          steps = 0, cut_backs = 0, newton_iterations = 0;
  };

  // All optional.
  struct Callbacks
  {
    std::function<bool()>                   stop_requested; // asked before every step; true ends the run with stopped_by_user
    std::function<void(const Snapshot &)>   on_stage;       // at every stage, and where the run ends early
    std::function<void(const HistoryRow &)> on_step;        // after every accepted step, the initial state included (step 0)
  };

  // Throws std::invalid_argument naming key, value and what is allowed.
  void validate(const Loading &loading);
  void validate(const Options &options);

  // Run the panel on a mesh made by make_mesh or the user's own with the ids of BoundaryId. Every stage is landed on
  // exactly. MPI must have been initialised (dealii::Utilities::MPI::MPI_InitFinalize), with one process.
  // Throws std::invalid_argument for bad input and std::runtime_error for a mesh file that cannot be used.
  [[nodiscard]] Report run(const std::string &msh_file,
                           const Loading     &loading,
                           const Options     &options,
                           const Callbacks   &callbacks = {});
} // namespace diptych::continuum
