// diptych: input and output of every constitutive law
// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <cmath>
#include <variant>
#include <vector>

#include <deal.II/base/tensor.h>

#include "continuum/laws/verdict.h"

namespace diptych::continuum
{
  // Strain and stress of a point in plane strain as work-conjugate vectors, tension positive. A classical law reads and fills
  // the first three components, a Cosserat law all six.
  //   strain: e_xx, e_yy, gamma_xy = 2 e_xy, relative rotation chi = (du_y/dx - du_x/dy) - 2 omega, d omega/dx, d omega/dy
  //   stress: s_xx, s_yy, symmetric part of s_xy, skew part a, couple stresses m_x, m_y [pressure * length]
  // With row = component of the force and column = normal of the face, s_xy = symmetric - a and s_yx = symmetric + a.
  // A gradient law (gradient_law.h) uses the last three components for its nonlocal hardening variable kbar:
  //   strain: increments of kbar and of d kbar/dx, d kbar/dy;   stress: s (kbar - kappa), s l^2 d kbar/dx, s l^2 d kbar/dy.
  enum Component : unsigned int
  {
    xx,
    yy,
    xy,
    relative_rotation, // in a stress: its skew part
    curvature_x,       // in a stress: couple stress
    curvature_y,
    n_components,
    nonlocal   = relative_rotation,
    nonlocal_x = curvature_x,
    nonlocal_y = curvature_y
  };
  constexpr unsigned int n_classical = 3; // components of a law without couple stress

  using Strain  = dealii::Tensor<1, n_components>;
  using Stress  = dealii::Tensor<1, n_components>;
  using Tangent = dealii::Tensor<2, n_components>; // d stress / d strain increment; zero beyond the law's components

  // Radius of Mohr's circle in the plane.
  inline double shear_radius(const Stress &s)
  {
    return std::hypot((s[xx] - s[yy]) / 2, s[xy]);
  }

  // The branch of the law that gave the answer. `edge`: two yield planes are active, sigma_zz is an outer principal stress.
  enum class Regime
  {
    elastic,
    plastic,
    edge,
    apex
  };

  // Plastic strain of a point. The shear is the engineering one, 2 e_xy.
  struct PlasticStrain
  {
    double xx = 0, yy = 0, zz = 0, xy = 0;
  };

  // Further state variables of some kinds of laws. Those of the program's laws are zero at the start of the loading.
  struct CriticalState // hardening = critical_state
  {
    double stress_ratio_gain = 0; // increase of the mobilised t/s [-]
    double densification     = 0; // ln(solid fraction / initial one), from plastic strain [-]
  };
  struct KinematicState : CriticalState // hardening = kinematic
  {
    Stress back_stress_ratio; // axis of the cone, a deviatoric stress over the pressure [-]
  };
  struct NonlocalState // gradient laws
  {
    double plastic_strain = 0; // kbar, the nonlocal hardening variable [-]
  };
  using LibraryState = std::vector<double>; // state variables of a law from a library

  // Committed state of one material point.
  struct MaterialState
  {
    Stress        stress;
    double        stress_zz                 = 0; // [pressure]
    double        equivalent_plastic_strain = 0; // hardening variable: integral of the plastic d(eps_1 - eps_3) [-]
    double        overstress                = 0; // excess of the yield function that viscosity carries [pressure]
    PlasticStrain plastic_strain;                // updated by add_plastic_flow(), not by update(); law = library: by update()
    double        dissipation = 0;               // plastic work per initial area [pressure]; likewise

    std::variant<std::monostate, CriticalState, KinematicState, NonlocalState, LibraryState> own;
  };

  // The state variables of one kind of law; zeros if the state has none.
  template <class Part> const Part &part_of(const MaterialState &state)
  {
    static const Part none{};
    const Part       *held = std::get_if<Part>(&state.own);
    return held ? *held : none;
  }
  // The state variables of one kind of law, to be written. A state without them gets zeros.
  template <class Part> Part &own_part(MaterialState &state)
  {
    if (!std::holds_alternative<Part>(state.own))
      state.own.emplace<Part>();
    return *std::get_if<Part>(&state.own);
  }

  struct MaterialUpdate
  {
    MaterialState state;
    Tangent       tangent;
    Regime        regime  = Regime::elastic;
    Verdict       verdict = Verdict::reliable;
  };
} // namespace diptych::continuum
