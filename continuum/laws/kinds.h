// diptych: the constitutive laws and hardenings that a scene can choose, and what a law is
// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include "continuum/choices.h"

namespace diptych::continuum
{
  enum class LawKind
  {
    cosserat_mohr_coulomb,
    cosserat_drucker_prager,
    gradient_mohr_coulomb,
    gradient_drucker_prager,
    mohr_coulomb,
    drucker_prager,
    linear_elastic,
    library // of the user
  };

  constexpr auto choices(LawKind)
  {
    return std::array{std::pair{LawKind::cosserat_mohr_coulomb, "cosserat_mohr_coulomb"},
                      std::pair{LawKind::cosserat_drucker_prager, "cosserat_drucker_prager"},
                      std::pair{LawKind::gradient_mohr_coulomb, "gradient_mohr_coulomb"},
                      std::pair{LawKind::gradient_drucker_prager, "gradient_drucker_prager"},
                      std::pair{LawKind::mohr_coulomb, "mohr_coulomb"},
                      std::pair{LawKind::drucker_prager, "drucker_prager"},
                      std::pair{LawKind::linear_elastic, "linear_elastic"},
                      std::pair{LawKind::library, "library"}};
  }

  enum class ConeShape
  {
    mohr_coulomb,  // in the plane: |q| = (sigma_1 - sigma_2)/2, s = -(sigma_1 + sigma_2)/2
    drucker_prager // |q| = sqrt(J2), s = -I1/3
  };

  // A law of the program is one choice of each. Those of a library follow from its description (is_cosserat() in
  // continuum/options.h).
  struct LawTraits
  {
    bool      is_plastic  = false; // has strength, hardening and viscosity
    bool      is_cosserat = false; // has rotations, couple stress and hence an internal length
    bool      is_gradient = false; // has a nonlocal hardening variable and hence an internal length
    ConeShape shape       = ConeShape::drucker_prager;

    constexpr bool has_length() const { return is_cosserat || is_gradient; }
    // Ignores sigma_zz: exact only if that is the intermediate principal stress.
    constexpr bool stays_in_plane() const { return has_length() && shape == ConeShape::mohr_coulomb; }
    // Returns in principal space, also to the edges between yield planes.
    constexpr bool has_edges() const { return is_plastic && !has_length() && shape == ConeShape::mohr_coulomb; }
  };
  constexpr LawTraits traits(const LawKind law)
  {
    using K                = LawKind;
    const bool is_cosserat = law == K::cosserat_mohr_coulomb || law == K::cosserat_drucker_prager;
    const bool is_gradient = law == K::gradient_mohr_coulomb || law == K::gradient_drucker_prager;
    const bool has_planes  = law == K::cosserat_mohr_coulomb || law == K::gradient_mohr_coulomb || law == K::mohr_coulomb;
    return {law != K::linear_elastic && law != K::library, is_cosserat, is_gradient,
            has_planes ? ConeShape::mohr_coulomb : ConeShape::drucker_prager};
  }

  // Place in the list Hardenings (options.h): each hardening is a type in a file of its own.
  enum class HardeningKind : unsigned int
  {
  };
} // namespace diptych::continuum
