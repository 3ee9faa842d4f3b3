// diptych: checks of the parameters of the constitutive laws
// SPDX-License-Identifier: LGPL-2.1-or-later
#include "continuum/laws/options.h"

#include <algorithm>
#include <cmath>

#include "continuum/require.h"

namespace diptych::continuum
{
  namespace
  {
    // The comparison is also false for NaN.
    void require_range(const std::string &key, const double value, const double low, const double high)
    {
      require_keys(value >= low && value <= high, {key}, key, " = ", value, " must lie in [", low, ", ", high, "]");
    }

    constexpr double steepest = 60, greatest = 1e12; // [degrees], any other unit

    // keys: the dilatancy angle, the friction angle, the cohesion
    void check_values(const std::string              &place,
                      const std::vector<std::string> &keys,
                      const double                    friction,
                      const double                    dilatancy,
                      const double                    cohesion)
    {
      require_keys(dilatancy <= friction, keys, "dilatancy angle ", dilatancy, ' ', place, " must not exceed the friction angle ",
                   friction, " (plastic work would be negative)");
      require_keys(friction > 0 || cohesion > 0, keys, "friction and cohesion are both zero ", place, ": one must be positive");
    }

    void check_peak(const LawOptions &o)
    {
      require_range("friction_angle_peak", o.friction_angle_peak, 0, steepest);
      require_range("dilatancy_angle_peak", o.dilatancy_angle_peak, 0, steepest);
      require_range("cohesion", o.cohesion, 0, greatest);
      check_values("at the peak", {"dilatancy_angle_peak", "friction_angle_peak", "cohesion"}, o.friction_angle_peak,
                   o.dilatancy_angle_peak, o.cohesion);
    }

    // All values decay with the same factor, so checking both ends is sufficient.
    void check_residual(const LawOptions &o)
    {
      const double cohesion = o.cohesion_residual.value_or(o.cohesion);
      require_range("friction_angle_residual", o.friction_angle_residual, 0, steepest);
      require_range("dilatancy_angle_residual", o.dilatancy_angle_residual, 0, steepest);
      require_range("cohesion_residual", cohesion, 0, greatest);
      require_range("softening_strain", o.softening_strain, 1e-6, 1e6);
      require_keys(o.friction_angle_residual <= o.friction_angle_peak, {"friction_angle_residual", "friction_angle_peak"},
                   "friction_angle_residual = ", o.friction_angle_residual,
                   " must not exceed friction_angle_peak = ", o.friction_angle_peak);
      require_keys(o.dilatancy_angle_residual <= o.dilatancy_angle_peak, {"dilatancy_angle_residual", "dilatancy_angle_peak"},
                   "dilatancy_angle_residual = ", o.dilatancy_angle_residual,
                   " must not exceed dilatancy_angle_peak = ", o.dilatancy_angle_peak);
      require_keys(cohesion <= o.cohesion, {"cohesion_residual", "cohesion"}, "cohesion_residual = ", cohesion,
                   " must not exceed cohesion = ", o.cohesion);
      check_values("after long shear", {"dilatancy_angle_residual", "friction_angle_residual", "cohesion_residual"},
                   o.friction_angle_residual, o.dilatancy_angle_residual, cohesion);
    }

    // phi - psi is a + b exp(-k/k_s) - c exp(-k/k_m), which has at most one stationary point. Checking that point and both ends
    // is sufficient.
    void check_mobilisation(const LawOptions &o)
    {
      require_range("friction_angle_start", o.friction_angle_start, 0, steepest);
      require_range("mobilisation_strain", o.mobilisation_strain, 1e-6, 1e6);
      require_keys(o.friction_angle_start <= o.friction_angle_peak, {"friction_angle_start", "friction_angle_peak"},
                   "friction_angle_start = ", o.friction_angle_start,
                   " must not exceed friction_angle_peak = ", o.friction_angle_peak);
      check_values("at the start", {"dilatancy_angle_peak", "friction_angle_start", "cohesion"}, o.friction_angle_start,
                   o.dilatancy_angle_peak, o.cohesion);
      const double b = o.friction_angle_peak - o.friction_angle_residual - o.dilatancy_angle_peak + o.dilatancy_angle_residual;
      const double c = o.friction_angle_peak - o.friction_angle_start;
      const double decay  = 1 / o.mobilisation_strain - 1 / o.softening_strain;
      const double strain = std::log(c * o.softening_strain / (b * o.mobilisation_strain)) / decay;
      if (!(b > 0 && c > 0 && std::isfinite(strain) && strain > 0))
        return;
      const double       softened = std::exp(-strain / o.softening_strain), lacks = c * std::exp(-strain / o.mobilisation_strain);
      std::ostringstream place;
      place << "at a hardening variable of " << strain;
      check_values(place.str(),
                   {"dilatancy_angle_peak", "friction_angle_peak", "dilatancy_angle_residual", "friction_angle_residual",
                    "friction_angle_start", "mobilisation_strain"},
                   o.friction_angle_residual + (o.friction_angle_peak - o.friction_angle_residual) * softened - lacks,
                   o.dilatancy_angle_residual + (o.dilatancy_angle_peak - o.dilatancy_angle_residual) * softened, 1);
    }

    // The densest and most mobilised state is either the initial one or the one that the initial density allows.
    void check_critical_state(const LawOptions &o)
    {
      require_range("critical_stress_ratio", o.critical_stress_ratio, 0.01, 0.9);
      require_range("critical_solid_fraction", o.critical_solid_fraction, 0.1, 1);
      require_range("strength_by_density", o.strength_by_density, 1e-6, 1e3);
      require_range("dilatancy_ratio", o.dilatancy_ratio, 0.05, 20);
      require_range("stress_ratio_start", o.stress_ratio_start, 0, 0.9);
      require_range("mobilisation_strain", o.mobilisation_strain, 1e-6, 1e6);
      require_range("cohesion", o.cohesion, 0, greatest);
      const double start = o.solid_fraction_start.value_or(o.critical_solid_fraction);
      require_range("solid_fraction_start", start, 0.1, 1);
      const double possible = o.critical_stress_ratio +
                              o.strength_by_density * o.critical_solid_fraction * std::log(start / o.critical_solid_fraction);
      for (const double ratio : {o.stress_ratio_start, possible})
        {
          const double sine = (ratio - o.critical_stress_ratio) / o.dilatancy_ratio;
          require_keys(sine <= std::max(ratio, 0.),
                       {"solid_fraction_start", "stress_ratio_start", "dilatancy_ratio", "critical_stress_ratio"},
                       "solid_fraction_start = ", start, ", stress_ratio_start = ", o.stress_ratio_start, ": at t/s = ", ratio,
                       " the sine of the dilatancy angle, ", sine,
                       ", exceeds t/s, so plastic work would be negative; increase dilatancy_ratio or critical_stress_ratio");
        }
    }

    void check_kinematic(const LawOptions &o)
    {
      require_range("elastic_stress_ratio", o.elastic_stress_ratio, 0.001, 0.9);
      require_keys(o.elastic_stress_ratio < o.critical_stress_ratio, {"elastic_stress_ratio", "critical_stress_ratio"},
                   "elastic_stress_ratio = ", o.elastic_stress_ratio,
                   " must be below critical_stress_ratio = ", o.critical_stress_ratio);
    }

    // Values are linear between the points, so checking the points is sufficient.
    void check_table(const LawOptions &o)
    {
      const std::size_t n = o.table_strain.size();
      require_keys(n > 0, {"table_strain", "hardening"}, "hardening = table needs table_strain, a list that ascends from 0");
      require_keys(o.table_friction_angle.size() == n && o.table_dilatancy_angle.size() == n && o.table_cohesion.size() == n,
                   {"table_strain", "table_friction_angle", "table_dilatancy_angle", "table_cohesion"},
                   "table_strain, table_friction_angle, table_dilatancy_angle, table_cohesion have ", n, ", ",
                   o.table_friction_angle.size(), ", ", o.table_dilatancy_angle.size(), ", ", o.table_cohesion.size(),
                   " values: they must be equally long");
      require_keys(o.table_strain[0] == 0, {"table_strain"}, "table_strain begins with ", o.table_strain[0],
                   ": it must ascend from 0");
      for (std::size_t k = 0; k < n; ++k)
        {
          require_range("table_strain", o.table_strain[k], 0, 1e6);
          require_keys(k == 0 || o.table_strain[k] > o.table_strain[k - 1], {"table_strain"},
                       "table_strain = ", o.table_strain[k], " must be above the value before it");
          require_range("table_friction_angle", o.table_friction_angle[k], 0, steepest);
          require_range("table_dilatancy_angle", o.table_dilatancy_angle[k], 0, steepest);
          require_range("table_cohesion", o.table_cohesion[k], 0, greatest);
          std::ostringstream place;
          place << "at table_strain = " << o.table_strain[k];
          check_values(place.str(), {"table_dilatancy_angle", "table_friction_angle", "table_cohesion"},
                       o.table_friction_angle[k], o.table_dilatancy_angle[k], o.table_cohesion[k]);
        }
    }
  } // namespace

  const LawParameter *LawParameters::find(const std::string &name) const
  {
    const auto found = std::find_if(list.begin(), list.end(), [&](const LawParameter &one) { return one.name == name; });
    return found == list.end() ? nullptr : &*found;
  }

  void LawParameters::set(const std::string &name, const double value)
  {
    for (LawParameter &one : list)
      if (one.name == name)
        {
          one.value = value;
          return;
        }
    list.emplace_back();
    list.back().name  = name;
    list.back().value = value;
  }

  LawOptions in_units(LawOptions o, const Units &units)
  {
    for (double *stress : {&o.elastic.youngs_modulus, &o.cohesion, &o.viscosity})
      *stress *= units.stress;
    if (o.cohesion_residual)
      *o.cohesion_residual *= units.stress;
    for (double &cohesion : o.table_cohesion)
      cohesion *= units.stress;
    o.internal_length *= units.length;
    return o;
  }

  std::vector<UnusedKey> unused_keys(const LawKind law, const LawOptions &o)
  {
    const LawTraits        is = traits(law);
    std::vector<UnusedKey> unused;
    const auto             unless = [&](const bool used, const std::string &because, const std::vector<const char *> &keys) {
      for (const char *key : keys)
        if (!used)
          unused.push_back({key, because});
    };
    const std::string               of_law = "law = " + name_of(law), of_hardening = "hardening = " + name_of(o.hardening);
    const std::vector<const char *> peak      = {"friction_angle_peak", "dilatancy_angle_peak", "cohesion"};
    const std::vector<const char *> residual  = {"friction_angle_residual", "dilatancy_angle_residual", "cohesion_residual",
                                                 "softening_strain"};
    const std::vector<const char *> start     = {"friction_angle_start"};
    const std::vector<const char *> mobilised = {"mobilisation_strain"};
    const std::vector<const char *> critical  = {"critical_stress_ratio", "critical_solid_fraction", "strength_by_density",
                                                 "dilatancy_ratio",       "stress_ratio_start",      "solid_fraction_start"};
    const std::vector<const char *> kinematic = {"elastic_stress_ratio"};
    const std::vector<const char *> table = {"table_strain", "table_friction_angle", "table_dilatancy_angle", "table_cohesion"};
    unless(law == LawKind::library, of_law, {"law_library"});
    for (const LawParameter &one : o.library.parameters.list)
      if (law != LawKind::library)
        unused.push_back({LawParameters::prefix + one.name, of_law});
    unless(law != LawKind::library, of_law, {"youngs_modulus", "poisson_ratio"});
    unless(is.has_length(), of_law, {"internal_length"});
    unless(is.is_cosserat, of_law, {"couple_shear_ratio"});
    unless(is.is_gradient, of_law, {"nonlocal_weight"});
    unless(is.is_plastic, of_law, {"hardening", "viscosity"});
    unless(is.is_plastic, of_law, peak);
    unless(is.is_plastic, of_law, residual);
    unless(is.is_plastic, of_law, start);
    unless(is.is_plastic, of_law, mobilised);
    unless(is.is_plastic, of_law, critical);
    unless(is.is_plastic, of_law, kinematic);
    unless(is.is_plastic, of_law, table);
    if (is.is_plastic)
      {
        const bool has_state = follows_solid_fraction(o.hardening);
        unless(o.hardening != HardeningKind::table && !has_state, of_hardening, {"friction_angle_peak", "dilatancy_angle_peak"});
        unless(o.hardening != HardeningKind::table, of_hardening, {"cohesion"});
        unless(o.hardening == HardeningKind::exponential || o.hardening == HardeningKind::mobilisation, of_hardening, residual);
        unless(o.hardening == HardeningKind::mobilisation, of_hardening, start);
        unless(o.hardening == HardeningKind::mobilisation || has_state, of_hardening, mobilised);
        unless(has_state, of_hardening, critical);
        unless(o.hardening == HardeningKind::kinematic, of_hardening, kinematic);
        unless(o.hardening == HardeningKind::table, of_hardening, table);
      }
    return unused;
  }

  void validate(const ElasticOptions &options)
  {
    require_range("youngs_modulus", options.youngs_modulus, 1e-3, greatest);
    require_range("poisson_ratio", options.poisson_ratio, 0, 0.49);
  }

  void validate(const LawOptions &o)
  {
    validate(o.elastic);
    if (o.hardening == HardeningKind::table)
      check_table(o);
    else if (follows_solid_fraction(o.hardening))
      check_critical_state(o);
    else
      check_peak(o);
    if (o.hardening == HardeningKind::exponential || o.hardening == HardeningKind::mobilisation)
      check_residual(o);
    if (o.hardening == HardeningKind::mobilisation)
      check_mobilisation(o);
    if (o.hardening == HardeningKind::kinematic)
      check_kinematic(o);
    require_range("viscosity", o.viscosity, 0, greatest);
    require_range("internal_length", o.internal_length, 1e-6, 1e6);
    require_range("couple_shear_ratio", o.couple_shear_ratio, 1e-6, 1e6);
    require_range("nonlocal_weight", o.nonlocal_weight, 1, 10);
  }

  void validate(const LawKind law, const LawOptions &o)
  {
    validate(o);
    require_keys(law != LawKind::mohr_coulomb || o.hardening != HardeningKind::kinematic, {"law", "hardening"},
                 "law = mohr_coulomb with hardening = kinematic: take drucker_prager, or a law with rotations");
    require_keys(!traits(law).is_gradient || !follows_solid_fraction(o.hardening), {"law", "hardening"}, "law = ", name_of(law),
                 " with hardening = ", name_of(o.hardening), ": take another hardening, or a law with rotations");
  }
} // namespace diptych::continuum
