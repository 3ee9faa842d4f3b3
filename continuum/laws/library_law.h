// diptych: a law of the user from a shared library
// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <limits>
#include <string>
#include <vector>

#include "continuum/laws/elasticity.h"
#include "continuum/laws/hardening.h"
#include "continuum/laws/law_library.h"

namespace diptych::continuum
{
  // Calls the functions of diptych_law.h. A NaN in an answer makes it `failed`; an exception ends the process as a crash does.
  class LibraryLaw
  {
  public:
    // Completes the options. Throws WrongKeys like complete(), and if the law fails at the isotropic stress -units.stress
    // without strain: its tangent there takes the place of the elastic one.
    LibraryLaw(LibraryOptions options, const Units &units);

    // Members as in LinearElastic. update() also adds plastic strain and dissipation.
    MaterialUpdate update(const MaterialState &s0, const Strain &d_strain, double d_time) const;
    double         yield_function(const MaterialState &) const { return -std::numeric_limits<double>::infinity(); }
    double         shear_strength(const MaterialState &) const { return std::numeric_limits<double>::infinity(); }

    const Hardening     *hardening() const { return nullptr; }
    const ElasticModuli &moduli() const { return moduli_; } // only the shear modulus at the start; the others are zero
    const Tangent       &elastic_tangent() const { return elastic; }

    // Sets the state variables of a point with its initial stress.
    void start(MaterialState &state) const;

    // Rotates the tensors among the state variables with the material, by an angle.
    void turn_variables(MaterialState &state, double angle) const;

    const LawLibrary &library() const { return *opened; }
    unsigned int      n_components() const { return unsigned(opened->law->n_components); }

    // Why update() fails with these arguments: it calls the library again. `where` names the point, such as "element 3, point 1
    // (x = 1, y = 2)"; it may be empty.
    struct Failure
    {
      std::string text;
      bool        is_not_finite = false; // the library gave an answer
    };
    Failure failure(const MaterialState &s0, const Strain &d_strain, double d_time, const std::string &where = "") const;

  private:
    diptych_verdict call(const MaterialState &s0, const Strain &d_strain, double d_time, MaterialUpdate &answer) const noexcept;

    const LawLibrary   *opened = nullptr;
    std::string         path;
    std::vector<double> parameters; // converted to stresses and lengths
    ElasticModuli       moduli_;
    Tangent             elastic;
  };
} // namespace diptych::continuum
