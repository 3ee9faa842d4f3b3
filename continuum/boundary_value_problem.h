// diptych: equilibrium of the sample, residual and consistent tangent on trial states
// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <string>
#include <vector>

#include <deal.II/lac/trilinos_sparse_matrix.h>
#include <deal.II/lac/trilinos_vector.h>

#include "continuum/discretisation.h"
#include "continuum/laws/any_law.h"
#include "continuum/panel.h"

namespace diptych::continuum
{
  using DistributedVector = dealii::TrilinosWrappers::MPI::Vector;

  // Out-of-balance force of a trial state: Euclidean norms over all nodes [pressure * length].
  struct Imbalance
  {
    double       residual = 0; // free components
    double       scale    = 0; // reactions of the prescribed components: what the residual is small against
    unsigned int n_failed = 0; // material points whose law gave up

    double relative() const { return residual / scale; }
  };

  // sum over cells of int B^T sigma dA = lateral load + reactions, small strain. The committed state changes only in
  // commit(); everything else works on one trial state, which any later evaluate() overwrites.
  class BoundaryValueProblem
  {
  public:
    BoundaryValueProblem(const std::string &msh_file, const Loading &loading, const Law &law);

    DistributedVector zero_vector() const;

    // Displacement increment that moves the platens by `d_axial_strain` and nothing else.
    DistributedVector platen_increment(double d_axial_strain) const;

    // Lateral load at an axial strain; kept through the iterations of a step. `share` < 1 mixes it with the load that the
    // initial stress balances by itself, which lets a wavy outline find equilibrium gradually.
    void set_lateral_load(double axial_strain, double share = 1);

    // Trial state: committed + increment, the law called at every point.
    Imbalance evaluate(const DistributedVector &increment);

    // Right-hand side -(residual + K * increment) with the tangents of the last evaluate(): first predictor.
    DistributedVector linearised_residual(const DistributedVector &increment) const;

    // -(residual) of the trial state, zero on prescribed components.
    const DistributedVector &negative_residual() const { return rhs; }

    // Consistent tangent of the trial state.
    const dealii::TrilinosWrappers::SparseMatrix &assemble_tangent();

    // The trial state becomes the committed one.
    void commit(double axial_strain);

    const Discretisation             &discretisation() const { return mesh; }
    const std::vector<MaterialState> &points() const { return committed; }                    // points_per_cell per cell
    const std::vector<double>        &displacement() const { return committed_displacement; } // relevant dofs
    double                            axial_strain() const { return committed_axial_strain; }
    Eigen::Vector2d                   platen_force(bool upper) const { return committed_platen_force[upper]; } // on the sample
    double yielding_share() const { return committed_yielding_share; } // of the initial area, in the last step
    double assembly_cpu_s() const { return cpu_s; }

  private:
    std::vector<double>     relevant_values(const DistributedVector &vector) const;
    std::vector<double>     internal_force() const;
    DistributedVector       assembled(const std::vector<double> &local) const;
    Eigen::Vector2d         trial_platen_force(bool upper) const;
    double                  trial_yielding_share() const;
    template <class L> void update_points(const L &law, const std::vector<double> &increment);

    Discretisation                         mesh;
    Law                                    law;
    double                                 pressure;
    Eigen::Vector2d                        platen_travel;
    std::vector<MaterialState>             committed;
    std::vector<MaterialUpdate>            trial;
    std::vector<double>                    committed_displacement, trial_increment; // relevant dofs
    std::vector<double>                    external, initial_internal_force;        // relevant dofs, this process's part
    DistributedVector                      nodal_force, rhs; // internal - external; its negative on free dofs
    dealii::TrilinosWrappers::SparseMatrix matrix;
    double                                 committed_axial_strain = 0, committed_yielding_share = 0;
    std::array<Eigen::Vector2d, 2> committed_platen_force{Eigen::Vector2d::Zero(), Eigen::Vector2d::Zero()}; // lower, upper
    double                         cpu_s = 0;
  };
} // namespace diptych::continuum
