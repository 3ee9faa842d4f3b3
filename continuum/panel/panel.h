// diptych: the continuum panel, a sample on a mesh loaded through a list of stages
// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <functional>
#include <memory>
#include <string>
#include <vector>

#include <mpi.h>

#include "continuum/history.h"
#include "continuum/mesh/quad_mesh.h"
#include "continuum/options.h"
#include "continuum/panel/checkpoint.h"
#include "continuum/report.h"
#include "continuum/snapshot.h"
#include "continuum/stopping.h"

namespace diptych::continuum
{
  // All optional. On several processes all of them call check_stop, stop_requested and before_step; the first alone calls the
  // others.
  struct Hooks
  {
    CheckStop             check_stop;     // called between phases of the constructor; throws on all processes or on none
    std::function<bool()> stop_requested; // asked before every step and linear solve
    std::function<void()> before_step;    // called when a checkpoint may be written
    std::function<void(const std::string &phase, double fraction)> on_progress;
    std::function<void(const HistoryRow &)> on_row; // for every accepted step and the state at rest (step 0)
  };

  // One sample, from rest to the end of its loading. A process may hold any number of panels. MPI must be initialised
  // (dealii::Utilities::MPI::MPI_InitFinalize). All functions are collective over the communicator and take the same arguments.
  class Panel
  {
  public:
    // `units`: pressure and length by which the values of `options` are multiplied. Throws std::invalid_argument if mesh, loading
    // or options are wrong or contradict each other. Passes on exceptions of hooks.check_stop.
    Panel(const QuadMesh &mesh,
          const Units    &units,
          const Loading  &loading,
          const Options  &options,
          Hooks           hooks        = {},
          MPI_Comm        communicator = MPI_COMM_WORLD);
    ~Panel();
    Panel(Panel &&) noexcept;
    Panel &operator=(Panel &&) noexcept;

    // To be called before prepare(). Replaces the isotropic stress by one tensor per cell of snapshot(), positive in
    // compression [pressure]. The panel uses the tensors of the first process.
    void set_initial_stress(const std::vector<Eigen::Matrix2d> &stress);

    // As set_initial_stress(), for solid_fraction_start = auto, with one number per cell [-].
    void set_initial_solid_fraction(const std::vector<double> &solid_fraction);

    // To be called once. `prepare()` finds equilibrium at rest. On any number of processes, resume() continues from the
    // checkpoint of the first one. Throws std::invalid_argument if it belongs to another mesh.
    [[nodiscard]] Status prepare();
    void                 resume(const Checkpoint &checkpoint);

    // Loads up to stage 1, 2, ... number of stages. A step that does not converge is halved. If that does not help, the panel
    // keeps its last accepted state, and the report gives the reason. A later call continues with the same bits, also after a
    // stop.
    [[nodiscard]] Status advance_to(int stage);

    // State of the last accepted step. Complete only on the first process.
    Snapshot snapshot() const;

    // On one process a panel resumed from it gives the same bits as an uninterrupted one. Complete only on the first process.
    Checkpoint    checkpoint() const;
    const Report &report() const;
    int           stage() const; // number of stages reached

  private:
    class Course;
    std::unique_ptr<Course> course;
  };
} // namespace diptych::continuum
