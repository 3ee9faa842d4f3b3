// diptych: states, strains and options that the tests of the laws share
// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include "continuum/laws/law_checks.h"
#include "tests/common.h"

namespace diptych::continuum::tests
{
  using namespace diptych::continuum;

  constexpr double    degree = M_PI / 180;
  inline const double E      = ElasticOptions().youngs_modulus; // [P], the scale of tangents

  inline double sine(const double degrees)
  {
    return std::sin(degrees * degree);
  }

  // Tension positive; couple stresses and skew stress are zero.
  inline MaterialState state_of(const double sxx, const double syy, const double szz, const double kappa = 0)
  {
    MaterialState state;
    state.stress[xx]                = sxx;
    state.stress[yy]                = syy;
    state.stress_zz                 = szz;
    state.equivalent_plastic_strain = kappa;
    state.own                       = NonlocalState{kappa}; // only gradient laws read it
    return state;
  }

  inline Strain strain_of(const double exx, const double eyy, const double gamma = 0)
  {
    Strain e;
    e[xx] = exx, e[yy] = eyy, e[xy] = gamma;
    return e;
  }

  inline LawOptions constant(const double friction, const double dilatancy, const double cohesion)
  {
    LawOptions o;
    o.hardening            = kind_of<ConstantHardening>;
    o.friction_angle_peak  = friction;
    o.dilatancy_angle_peak = dilatancy;
    o.cohesion             = cohesion;
    return o;
  }

  // A critical-state law with a mobilised t/s of `start` at the start.
  inline LawOptions critical(const double solid_fraction, const double start)
  {
    LawOptions o;
    o.hardening            = kind_of<CriticalStateHardening>;
    o.solid_fraction_start = solid_fraction;
    o.stress_ratio_start   = start;
    o.mobilisation_strain  = 0.02;
    return o;
  }

  // Every kind of hardening, with enough cohesion that random strains reach every regime.
  inline std::map<std::string, LawOptions> hardenings()
  {
    std::map<std::string, LawOptions> all;
    all["constant"] = constant(20.5, 12, 0.1);
    LawOptions o;
    o.cohesion = 0.1, o.cohesion_residual = 0.02, o.softening_strain = 0.05;
    all["exponential"]     = o;
    o.hardening            = kind_of<MobilisationHardening>;
    o.friction_angle_start = 13, o.mobilisation_strain = 0.01;
    all["mobilisation"] = o;
    LawOptions dense;
    dense.hardening = kind_of<CriticalStateHardening>, dense.cohesion = 0.1, dense.solid_fraction_start = 0.85;
    all["critical state, dense"] = dense;
    dense.solid_fraction_start   = 0.80; // contracts
    all["critical state, loose"] = dense;
    o.hardening                  = kind_of<TableHardening>;
    o.table_strain               = {0, 0.02, 0.1};
    o.table_friction_angle       = {15, 30, 22};
    o.table_dilatancy_angle      = {0, 12, 2};
    o.table_cohesion             = {0.1, 0.08, 0.02};
    all["table"]                 = o;
    for (const std::string name : {"constant", "exponential", "mobilisation", "table"})
      {
        all[name + ", viscous"]           = all[name];
        all[name + ", viscous"].viscosity = 0.05;
      }
    return all;
  }

  inline std::vector<LawKind> all_laws()
  {
    std::vector<LawKind> laws;
    for (const auto &[law, name] : choices(LawKind()))
      if (law != LawKind::library) // tests/program/law_library_test.py
        laws.push_back(law);
    return laws;
  }

  inline bool is_mohr_coulomb(const LawKind law)
  {
    return law == LawKind::mohr_coulomb || law == LawKind::cosserat_mohr_coulomb || law == LawKind::gradient_mohr_coulomb;
  }

  inline const std::vector<LawKind> plastic_laws = {LawKind::mohr_coulomb,          LawKind::drucker_prager,
                                                    LawKind::cosserat_mohr_coulomb, LawKind::cosserat_drucker_prager,
                                                    LawKind::gradient_mohr_coulomb, LawKind::gradient_drucker_prager};

  // Gradient laws reject critical_state.
  inline bool accepts(const LawKind law, const LawOptions &options)
  {
    return !traits(law).is_gradient || options.hardening != kind_of<CriticalStateHardening>;
  }

  inline MaterialUpdate update(const Law &law, const MaterialState &s0, const Strain &e, const double d_time = 1e-3)
  {
    return std::visit([&](const auto &one) { return one.update(s0, e, d_time); }, law);
  }

  inline const ElasticModuli &moduli_of(const Law &law)
  {
    return std::visit([](const auto &one) -> const ElasticModuli & { return one.moduli(); }, law);
  }

  inline double yield_function(const Law &law, const MaterialState &state)
  {
    return std::visit([&](const auto &one) { return one.yield_function(state); }, law);
  }
} // namespace diptych::continuum::tests
