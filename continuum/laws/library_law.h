// diptych: a law of the user from a shared library
// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <functional>
#include <limits>
#include <string>
#include <vector>

#include "continuum/laws/elasticity.h"
#include "continuum/laws/hardening.h"
#include "continuum/laws/law_library.h"

namespace diptych::continuum
{
  // Calls the functions of diptych_law.h. A NaN, a crash or an exception in them makes the answer `failed`.
  class LibraryLaw
  {
  public:
    // Completes options.library. Throws WrongKeys like complete(), and if the law fails at the isotropic stress -units.stress
    // without strain: its tangent there takes the place of the elastic one.
    explicit LibraryLaw(const LawOptions &options, const Units &units = {});

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

    // The last failure since forget_failure(). `is_broken`: the first crash or exception, after which no smaller step helps; it
    // is not forgotten.
    struct Failure
    {
      std::string text;
      bool        is_broken = false;
    };
    const Failure &failure() const { return last_failure; }

    // The first answer with a number that is not finite; empty if there was none.
    const std::string &first_not_finite() const { return not_finite; }
    void               forget_failure() const
    {
      if (!last_failure.is_broken)
        last_failure = {};
    }

    // Names the point of the present call in a failure, such as "element 3, point 1 (x = 1, y = 2)"; may be empty.
    mutable std::function<std::string()> where;

  private:
    struct Reply;
    Reply call(const MaterialState &s0, const Strain &d_strain, double d_time) const;
    void  take(const Reply &reply, MaterialUpdate &answer) const;
    void  note(const std::string &what, bool is_broken, const MaterialState &s0, const Strain &d_strain) const;

    const LawLibrary   *opened = nullptr;
    std::string         path;
    std::vector<double> parameters; // converted to stresses and lengths
    ElasticModuli       moduli_;
    Tangent             elastic;
    mutable Failure     last_failure;
    mutable std::string not_finite;
  };
} // namespace diptych::continuum
