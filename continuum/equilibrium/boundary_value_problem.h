// diptych: equilibrium of the sample: residual and consistent tangent on trial states
// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <array>
#include <memory>
#include <vector>

#include "continuum/equilibrium/boundary_conditions.h"
#include "continuum/elements/discretisation.h"
#include "continuum/laws/any_law.h"
#include "continuum/laws/localisation.h"
#include "continuum/elements/nodal_vectors.h"
#include "continuum/options.h"
#include "continuum/equilibrium/tangent_matrix.h"
#include "continuum/equilibrium/wall_friction.h"

namespace diptych::continuum
{
  // Out-of-balance force of a trial state: Euclidean norms over all nodes [pressure * length].
  struct Imbalance
  {
    double       residual   = 0; // free components
    double       scale      = 0; // platen forces on their nodes, the reference for the residual
    unsigned int n_failed   = 0; // material points at which the law failed
    unsigned int n_inverted = 0; // geometry = updated: points whose surroundings are turned inside out

    double relative() const { return residual > 0 ? residual / scale : 0.; }
  };

  // CPU time by phase on this process [s].
  struct PhaseSeconds
  {
    double points = 0, assembly = 0, geometry = 0;
  };

  // State at the end of an accepted step. Displacement and rotation have one entry per locally relevant dof, the points one per
  // point of each cell of this process.
  struct CommittedState
  {
    double                         progress = 0;
    std::vector<double>            displacement; // and rotation
    std::vector<MaterialState>     points;
    std::vector<Localisation>      localisation;
    std::array<Eigen::Vector2d, 2> platen_force{Eigen::Vector2d::Zero(), Eigen::Vector2d::Zero()}; // lower, upper; on the sample
    double                         friction_work = 0; // dissipated along the walls since the start [pressure * length^2]
  };

  // sum over cells of int B^T sigma dA = side pressure + weight + reactions. `geometry = updated` states it on the shape at the
  // end of the trial step and integrates over that of the last accepted step (elements/increment.h); `small_strain` on the
  // initial shape. Only commit() changes the committed state; other functions work on one trial state, which evaluate()
  // overwrites.
  class BoundaryValueProblem
  {
  public:
    BoundaryValueProblem(const QuadMesh  &mesh,
                         const Units     &units,
                         const Loading   &loading,
                         const Options   &options,
                         MPI_Comm         communicator = MPI_COMM_WORLD,
                         const CheckStop &check_stop   = {}); // called between phases

    // Replaces the isotropic initial stress: one tensor per cell of this process, compression positive.
    void set_initial_stress(const std::vector<Eigen::Matrix2d> &stress);

    // For a critical-state law: one number per cell of this process.
    void set_initial_solid_fraction(const std::vector<double> &solid_fraction);

    DistributedVector zero_vector() const { return continuum::zero_vector(mesh); }

    // Sets loads and platen motion of the step from the committed progress to `to`. `share` < 1 mixes the loads with those that
    // balance the state at the last reset_balance(), so that equilibrium can be found gradually.
    void begin_step(double to, double share = 1);

    // Changes an increment so that it satisfies the platen motion and the ties of the step.
    void impose(DistributedVector &increment) const;

    // Trial state: committed state + increment. Calls the law at every point.
    Imbalance evaluate(const DistributedVector &increment);

    // Right-hand side -(residual + K * increment) of the committed state, for the first predictor. Walls hold the nodes that
    // slide along them. assemble_tangent() then gives K.
    DistributedVector linearised_residual(const DistributedVector &increment);

    // -(residual) of the trial state, zero on constrained components.
    const DistributedVector &negative_residual() const { return rhs; }

    // Consistent tangent of the trial state. Prescribed components are eliminated. `caution` 0 to 1 replaces that share of the
    // tangent of friction by its secant.
    const dealii::TrilinosWrappers::SparseMatrix &assemble_tangent(double caution = 0);
    const dealii::TrilinosWrappers::SparseMatrix &tangent_matrix() const { return tangent.matrix(); } // as last assembled
    const dealii::AffineConstraints<double>      &correction_constraints() const { return conditions->correction(); }

    // A failure of a law from a library in the trial state, on any process; empty for other laws. Collective.
    std::string law_failure() const;

    // Whether the trial state inverts an element. Collective.
    bool is_folded() const;

    // Makes the trial state the committed one: adds plastic flow, rotates stress with the material and moves the nodes.
    void commit();

    // Makes the internal forces of the present state the loads of share 0.
    void reset_balance();

    // After a change of the mesh: new unknowns, then the state carried over by the caller.
    void rebuild(const CheckStop &check_stop = {});
    void adopt(CommittedState state);

    // Increases whenever unknowns or constraints change, that is, when matrices get a new pattern.
    int version() const { return structure_version; }

    const Discretisation &discretisation() const { return mesh; }
    Discretisation       &discretisation() { return mesh; }
    bool                  moves() const { return options.geometry == Kinematics::updated; } // geometry() follows the displacement
    const Geometry       &geometry() const { return current; } // shape on which the committed state is in equilibrium
    const Geometry       &moved_geometry() const { return moves() ? current : moved; } // shape after the committed displacement
    const Law            &law() const { return material; }
    const CommittedState &committed() const { return state; }
    const std::vector<MaterialUpdate> &last_update() const { return trial; } // of the last evaluate()
    const std::vector<double>         &last_flow() const { return flow; } // growth of the hardening variable in the accepted step
    // Per point: whether the accepted step weakened it while its plastic flow contracted.
    const std::vector<char> &last_instability() const { return unstable; }
    double                   progress() const { return state.progress; }
    const Eigen::Vector2d   &platen_force(bool upper) const { return state.platen_force[upper]; } // on the sample
    Eigen::Vector2d          platen_travel(bool upper) const;               // since the start [length]; collective
    double                   initial_area() const { return area_at_start; } // of the whole sample [length^2]
    const PhaseSeconds      &seconds() const { return phase; }
    void                     go_on_counting(const PhaseSeconds &before) { phase = before; }

    // Forces of the platens on the sample in the last step, on the relevant dofs; 0 off the platens. Collective.
    std::vector<double> platen_node_forces() const { return conditions->platen_forces(mesh, relevant_values(nodal_force)); }

    std::vector<double> relevant_values(const DistributedVector &vector) const
    {
      return continuum::relevant_values(mesh, vector);
    }
    // Inverse of relevant_values().
    DistributedVector owned_values(const std::vector<double> &relevant) const { return continuum::owned_values(mesh, relevant); }

  private:
    void                                   set_conditions(const SideContact &contact, const CheckStop &check_stop = {});
    void                                   move_nodes();
    std::array<PlatenPlane, 2>             platen_planes() const;
    void                                   find_loads();
    std::vector<double>                    trial_displacement() const;
    double                                 side_pressure() const;
    Eigen::Vector2d                        trial_platen_force(bool upper) const;
    double                                 platen_scale() const;
    template <class L, class Element> void update_points(const L &law, Element, std::vector<double> &force);
    PiolaTangent                           point_tangent(std::size_t point) const;

    Options                             options;
    Loading                             loading;
    Units                               units;
    double                              area_at_start = 0;
    Law                                 material;
    Discretisation                      mesh;
    std::unique_ptr<BoundaryConditions> conditions;
    SideContact                         in_side_contact;
    int                                 structure_version = 0;
    dealii::AffineConstraints<double>   step_constraints;
    Geometry                            current; // shape for equilibrium
    Geometry                            moved;   // small strain: shape after the committed displacement
    TangentMatrix                       tangent;
    WallFriction                        friction;

    CommittedState              state;
    double                      step_end = 0, step_share = 1;
    std::vector<Increment>      increments; // per point
    std::vector<MaterialUpdate> trial;
    std::vector<double>         trial_increment, internal, external, balanced_force,
      weight;                             // relevant dofs; forces: part of this process
    DistributedVector   applied;          // forces on free platens and walls in the present step
    DistributedVector   nodal_force, rhs; // internal - external, uncondensed; negative residual
    std::vector<double> flow;             // per point
    std::vector<char>   unstable;         // per point
    PhaseSeconds        phase;
  };
} // namespace diptych::continuum
