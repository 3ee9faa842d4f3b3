// diptych: the continuum panel, a sample on a mesh loaded through a list of stages
// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include <mpi.h>

#include "continuum/history.h"
#include "continuum/mesh/quad_mesh.h"
#include "continuum/options.h"
#include "continuum/panel/checkpoint.h"
#include "continuum/snapshot.h"
#include "continuum/stopping.h"

namespace diptych::continuum
{
  enum class Status
  {
    finished,
    stopped_by_user,
    not_converged
  };

  struct Report
  {
    Status                status       = Status::finished;
    double                progress     = 0;                   // reached, of what the loading walks along
    double                axial_strain = 0, shear_strain = 0; // reached
    std::string           message;                            // empty when finished
    unsigned int          n_cells = 0, n_unknowns = 0;
    int                   steps = 0, cut_backs = 0, newton_iterations = 0;
    std::optional<double> localisation_progress;  // at which the acoustic tensor first had a negative determinant
    double                localisation_angle = 0; // of the line that could form there [degrees from the horizontal]
  };

  // All optional. On several processes all of them call check_stop, stop_requested and before_step; the first alone calls the
  // others.
  struct Hooks
  {
    CheckStop             check_stop;     // called between phases of the constructor; throws on all processes or on none
    std::function<bool()> stop_requested; // asked before every step and linear solve
    std::function<void()> before_step;    // where a checkpoint may be taken
    std::function<void(const std::string &phase, double fraction)> on_progress;
    std::function<void(const HistoryRow &)> on_row; // of every accepted step and of the state at rest (step 0)
  };

  // One sample, from rest to the end of its loading. Any number of panels may live in one process. MPI must have been initialised
  // (dealii::Utilities::MPI::MPI_InitFinalize); all functions are collective over the communicator, with the same arguments.
  class Panel
  {
  public:
    // `units`: what keys of `options` count in. Throws std::invalid_argument on a mesh, a loading or options that are wrong or
    // contradict each other, and what hooks.check_stop throws.
    Panel(const QuadMesh &mesh,
          const Units    &units,
          const Loading  &loading,
          const Options  &options,
          Hooks           hooks        = {},
          MPI_Comm        communicator = MPI_COMM_WORLD);
    ~Panel();
    Panel(Panel &&) noexcept;
    Panel &operator=(Panel &&) noexcept;

    // Before prepare(), in the place of the isotropic stress: one tensor for each cell of snapshot(), positive in compression
    // [pressure]. The first process's is taken.
    void set_initial_stress(const std::vector<Eigen::Matrix2d> &stress);

    // The same for solid_fraction_start = auto: one number for each cell [-].
    void set_initial_solid_fraction(const std::vector<double> &solid_fraction);

    // Once: finds equilibrium at rest, or takes up a loading where it was left, on any number of processes: the first
    // one's is taken. Throws std::invalid_argument for a checkpoint of another mesh.
    [[nodiscard]] Status prepare();
    void                 resume(const Checkpoint &checkpoint);

    // Loads up to stage 1, 2, ... number of stages. A step that does not converge is halved; where that does not help, the panel
    // stays where it is and the report says why. One that is stopped on request between two Newton iterations leaves it as it was
    // before that step; asked again, the panel goes on from there, to the bits of one that was not stopped.
    [[nodiscard]] Status advance_to(int stage);

    // Of the last accepted step. Complete on the first process only.
    Snapshot snapshot() const;

    // On one process a panel that goes on from it gives the same bits as one that was never interrupted. Complete on the first
    // process only.
    Checkpoint    checkpoint() const;
    const Report &report() const;
    int           stage() const; // how many are reached

  private:
    class Course;
    std::unique_ptr<Course> course;
  };
} // namespace diptych::continuum
