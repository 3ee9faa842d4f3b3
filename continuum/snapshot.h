// diptych: state of the continuum panel at one instant
// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <array>
#include <string>
#include <vector>

#include <Eigen/Core>

#include "continuum/loading.h"

namespace diptych::continuum
{
  // Outline of the sample between two platens. Both sides run upward. Their first points lie on the lower platen, their last
  // points on the upper one. The bottom edge is therefore left.front()-right.front(). [length]
  struct Outline
  {
    std::vector<Eigen::Vector2d> left, right;
  };

  // Area means over one cell. Tensors are positive in compression: row 0 = (xx, xy, 0), row 1 = (yx, yy, 0), row 2 = (0, 0,
  // zz). The row is the component of the force, the column the normal of the face. A Cosserat stress is not symmetric.
  struct CellState
  {
    Eigen::Matrix3d stress                    = Eigen::Matrix3d::Zero(); // [pressure]
    Eigen::Matrix3d strain                    = Eigen::Matrix3d::Zero(); // total, linearised on the initial shape [-]
    Eigen::Matrix3d plastic_strain            = Eigen::Matrix3d::Zero(); // sum of increments [-]
    Eigen::Vector2d couple_stress             = Eigen::Vector2d::Zero(); // m_x, m_y, mechanics sign [pressure * length]
    double          area                      = 0;                       // current area [length^2]
    double          equivalent_plastic_strain = 0;                       // integral of d(eps_1 - eps_3) plastic [-]
    double          dissipation               = 0;                       // plastic work per area since the start [pressure]
    double          overstress                = 0; // part of the yield function that viscosity carries [pressure]
    double          share_zz_not_intermediate = 0; // share of the points where sigma_zz is an outer principal stress
    double          acoustic_determinant      = 1; // least det(n C n) over all n and points, relative to the elastic one
    double          localisation_angle        = 0; // of the band that could form, from the horizontal [degrees], (-90, 90]
    double          friction_angle            = 0; // mobilised or remaining friction of the law [degrees]; elastic: 0
    double          solid_fraction            = 0; // hardening = critical_state, kinematic [-]; else 0
    double          nonlocal_plastic_strain   = 0; // gradient laws: nonlocal hardening variable [-]; else 0
  };

  // A state variable of a law from a library.
  struct LawVariable
  {
    std::string         name, unit, meaning; // "law.NAME", as in the results
    std::vector<double> of_cells;            // n_cells, area means
  };

  // One instant of the continuum panel as plain values. The nodes are all support points of the displacement.
  struct Snapshot
  {
    double          progress         = 0; // loading variable
    double          axial_strain     = 0; // descent of the upper platen / initial height
    double          shear_strain     = 0; // its travel to the right / initial height
    double          time             = 0; // since the start
    LoadingVariable loading_variable = LoadingVariable::axial_strain;

    std::vector<Eigen::Vector2d> position;     // current = initial + displacement [length], n_nodes
    std::vector<Eigen::Vector2d> displacement; // since the start [length], n_nodes
    std::vector<double>          rotation;     // Cosserat: omega, anticlockwise since the start [radians], n_nodes; else empty
    std::vector<double>          weight;       // lumped area of a node (sums to the current area)
    std::vector<Eigen::Vector2d> platen_force; // of a platen on a node in the last step, 0 elsewhere [pressure * length], n_nodes

    // Node indices of a cell: four corners counter-clockwise, then the midpoints of edges 0-1, 1-2, 2-3, 3-0, then the centre,
    // as in VTK's biquadratic quad. Nine nodes are interpolated for four-node elements, too.
    std::vector<std::array<unsigned int, 9>> cells;
    std::vector<CellState>                   cell_state; // n_cells
    std::vector<LawVariable>                 variables;  // of a law from a library

    Eigen::Vector2d lower_platen_force = Eigen::Vector2d::Zero(); // force on the sample [pressure * length]
    Eigen::Vector2d upper_platen_force = Eigen::Vector2d::Zero();
    Eigen::Matrix3d mean_stress        = Eigen::Matrix3d::Zero(); // area mean, positive in compression
    double          area               = 0;                       // of the sample, current
  };
} // namespace diptych::continuum
