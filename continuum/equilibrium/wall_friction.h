// diptych: friction of the sample along platens and rigid side walls
// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <vector>

#include "continuum/elements/discretisation.h"
#include "continuum/elements/element_kernels.h"
#include "continuum/equilibrium/boundary_conditions.h"

namespace diptych::continuum
{
  // The traction opposes the slip of a step: tau = friction sigma_n tanh(slip / scale), scale = friction L |d progress| +
  // stick_slip. With v = slip / |d progress| it is friction sigma_n tanh(v / (friction L)): the slip of the step counts, not
  // that since the start, so a reversal of the slip reverses the traction. L = 0 is Coulomb's law, which holds up to a slip of
  // stick_slip in a step; so is every L at rest (d progress = 0). No traction where sigma_n <= 0. Acts at the nodes, with
  // their normal reaction in the same trial state.
  struct FrictionLaw
  {
    double friction    = 0; // largest tau / sigma_n [-]
    double slip_length = 0; // L [length]
    double stick_slip  = 0; // [length]
  };

  class WallFriction
  {
  public:
    // A step from one progress to another. The nodes are those of the present boundary conditions.
    void begin_step(const FrictionLaw &law, const std::vector<SlidingNode> &nodes, double from, double to);

    // Evaluates a trial state and adds its negative friction to `force`. `increment`, `reaction` (force of the walls on the
    // sample, summed over processes), `force`: on the relevant dofs.
    void add_force(const Discretisation      &mesh,
                   const std::vector<double> &increment,
                   const std::vector<double> &reaction,
                   std::vector<double>       &force);

    // Instead, for the first predictor: nothing has slipped yet, and friction resists slip elastically.
    void stick(const Discretisation &mesh, const std::vector<double> &reaction);
    void add_resistance(const std::vector<double> &increment, std::vector<double> &force) const;

    // Tangent by an element: the friction grows with the normal reaction. Elements with a hanging node miss its share.
    template <class Element> void add_to(ElementMatrix<Element> &K, const Cell &cell) const;

    // Tangent by the slip, at nodes of this process. The secant is safer while Newton's method is far from its solution: with the
    // tangent alone a sample that slides along all its walls has no stiffness at all.
    struct Stiffness
    {
      dealii::types::global_dof_index dof;
      unsigned int                    local;           // the same among the relevant dofs
      double                          tangent, secant; // d force / d slip, force / slip [pressure]
      double                          wall;            // displacement of the wall in this step [length]
    };
    const std::vector<Stiffness> &stiffness() const { return by_slip; }

    double work() const { return dissipated; } // in the trial state, at nodes of this process [pressure * length^2]

  private:
    template <class Visit> void each_pressed_node(const Discretisation &, const std::vector<double> &reaction, Visit &&) const;

    FrictionLaw                     law;
    const std::vector<SlidingNode> *nodes = nullptr;
    double                          from = 0, to = 0;
    double                          scale = 1;          // of the slip in this step [length]
    std::vector<double>             by_normal_reaction; // per relevant dof, on its axis; empty: no friction
    std::vector<Stiffness>          by_slip;
    double                          dissipated = 0;
  };

  template <class Element> void WallFriction::add_to(ElementMatrix<Element> &K, const Cell &cell) const
  {
    for (unsigned int i = 0; i < 2 * Element::n_nodes && !by_normal_reaction.empty(); ++i)
      if (const double factor = by_normal_reaction[cell.local[i]]; factor != 0)
        for (unsigned int j = 0; j < Element::n_dofs; ++j)
          K[i * row_length<Element> + j] += factor * K[(i ^ 1u) * row_length<Element> + j];
  }
} // namespace diptych::continuum
