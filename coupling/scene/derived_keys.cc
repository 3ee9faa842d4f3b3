// diptych: keys whose value `auto` follows from other keys of the scene
// SPDX-License-Identifier: LGPL-2.1-or-later
#include "coupling/scene/derived_keys.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>
#include <sstream>
#include <tuple>
#include <vector>

#include "discrete/files/csv_file.h"

namespace diptych::coupling
{
  namespace
  {
    using Given = std::set<std::string>;

    // The law of dense samples with these frictions between the grains, from cells without edges, and the friction along flat
    // platens on which they roll. The data hardly determine the modulus; its values are smoothed.
    struct CalibratedLaw
    {
      double friction;         // discrete/friction [-]
      double rolling_friction; // discrete/rolling_friction [-]
      double peak;             // friction angle if fully mobilised [degrees]
      double start;            // friction angle at the start / peak
      double residual;         // residual friction angle / peak
      double dilatancy;        // dilatancy angle / friction angle at the start
      double youngs_modulus;   // [loading/pressure]
      double platens;          // platen_friction [-]
      double slip_length;      // platen_slip_length [mean diameters]
    };

    constexpr std::array<std::array<CalibratedLaw, 6>, 5> calibrated = {
      {{{{0.2, 0, 19.4, 0.725, 0.678, 0.648, 4000, 0.12, 22},
         {0.3, 0, 21.9, 0.782, 0.703, 0.672, 5000, 0.15, 15},
         {0.4, 0, 23.4, 0.84, 0.656, 0.693, 6500, 0.17, 13},
         {0.5, 0, 24.9, 0.876, 0.603, 0.702, 8500, 0.185, 9},
         {0.6, 0, 26.2, 0.89, 0.551, 0.71, 10000, 0.22, 9.5},
         {0.8, 0, 27.3, 0.93, 0.547, 0.69, 15000, 0.23, 12}}},
       {{{0.2, 0.05, 25.5, 0.744, 0.724, 0.61, 3000, 0.15, 7.2},
         {0.3, 0.05, 28.5, 0.803, 0.75, 0.63, 3600, 0.17, 5.5},
         {0.4, 0.05, 31.1, 0.801, 0.602, 0.697, 4300, 0.19, 4.5},
         {0.5, 0.05, 32.5, 0.834, 0.618, 0.723, 5200, 0.21, 4.3},
         {0.6, 0.05, 34, 0.874, 0.531, 0.709, 6600, 0.22, 4},
         {0.8, 0.05, 36, 0.895, 0.545, 0.737, 8800, 0.26, 4.3}}},
       {{{0.2, 0.1, 27.8, 0.763, 0.792, 0.565, 3200, 0.18, 3.8},
         {0.3, 0.1, 32.1, 0.802, 0.726, 0.598, 3500, 0.2, 3.6},
         {0.4, 0.1, 34.8, 0.824, 0.664, 0.662, 4000, 0.21, 3.4},
         {0.5, 0.1, 36.7, 0.867, 0.617, 0.685, 4500, 0.225, 3.3},
         {0.6, 0.1, 38.1, 0.913, 0.57, 0.68, 5500, 0.235, 3.2},
         {0.8, 0.1, 40.6, 0.919, 0.546, 0.719, 7200, 0.27, 3}}},
       {{{0.2, 0.2, 29.5, 0.769, 0.783, 0.537, 3300, 0.22, 1.9},
         {0.3, 0.2, 35.3, 0.845, 0.81, 0.525, 4000, 0.245, 2},
         {0.4, 0.2, 39.5, 0.844, 0.715, 0.604, 4600, 0.26, 2.2},
         {0.5, 0.2, 41.8, 0.89, 0.579, 0.626, 5500, 0.26, 2.3},
         {0.6, 0.2, 43.6, 0.92, 0.587, 0.651, 6200, 0.27, 2.3},
         {0.8, 0.2, 46.7, 0.939, 0.574, 0.702, 8400, 0.29, 2.5}}},
       {{{0.2, 0.3, 30.2, 0.755, 0.763, 0.542, 3400, 0.25, 1.7},
         {0.3, 0.3, 37.1, 0.828, 0.826, 0.519, 4200, 0.28, 1.8},
         {0.4, 0.3, 42.1, 0.857, 0.765, 0.564, 5300, 0.3, 2},
         {0.5, 0.3, 45.3, 0.881, 0.599, 0.611, 6300, 0.31, 2.2},
         {0.6, 0.3, 47.5, 0.909, 0.528, 0.645, 7300, 0.32, 2.3},
         {0.8, 0.3, 52.1, 0.901, 0.45, 0.709, 10000, 0.34, 2.6}}}}};

    using discrete::tidy;

    // The law at a value of one key, in laws sorted by it: linear between two neighbours, constant beyond the ends.
    template <std::size_t n>
    CalibratedLaw between(const std::array<CalibratedLaw, n> &laws, double CalibratedLaw::*const key, const double at)
    {
      using Law        = CalibratedLaw;
      const auto upper = std::upper_bound(laws.begin(), laws.end(), at,
                                          [&](const double x, const Law &law) { return x < law.*key; });
      if (upper == laws.begin() || upper == laws.end())
        return upper == laws.end() ? laws.back() : laws.front();
      const Law   &a = *(upper - 1), &b = *upper;
      const double w = (at - a.*key) / (b.*key - a.*key);
      Law          law;
      for (double Law::*const value : {&Law::friction, &Law::rolling_friction, &Law::peak, &Law::start, &Law::residual,
                                       &Law::dilatancy, &Law::youngs_modulus, &Law::platens, &Law::slip_length})
        law.*value = tidy((1 - w) * a.*value + w * b.*value);
      return law;
    }

    CalibratedLaw fitting(const Scene &scene)
    {
      std::array<CalibratedLaw, calibrated.size()> laws;
      std::transform(calibrated.begin(), calibrated.end(), laws.begin(),
                     [&](const auto &row) { return between(row, &CalibratedLaw::friction, scene.discrete.law.friction); });
      return between(laws, &CalibratedLaw::rolling_friction, scene.discrete.law.rolling_friction);
    }

    // benchmarks/studies/grains_inertia: 1e-3 is slow enough up to 2000 grains and 4e-4 for 4000. Beyond, the ratio of the
    // platen's speed to that of waves stays the same.
    double slow_enough(const double n_grains)
    {
      if (n_grains <= 4000)
        return tidy(1e-3 * std::pow(std::max(1., n_grains / 2000), std::log(0.4) / std::log(2.)));
      return tidy(4e-4 * std::sqrt(4000 / n_grains));
    }

    // Equal stages of about `usual` up to the end, at most 40.
    double stage_length(const double end, const double usual)
    {
      return tidy(end / std::clamp(std::round(end / usual), 1., 40.));
    }

    // 0, a quarter, half and the whole of the loading, at stages.
    std::vector<double> window_edges(const LoadingOptions &o)
    {
      const bool                 time     = o.mode == discrete::LoadingMode::time;
      const double               interval = time ? o.stage_time : o.stage_strain;
      const std::vector<double> &list     = o.stages;
      const double count = list.empty() ? std::round((time ? o.duration : o.axial_strain) / interval) : double(list.size());
      std::vector<double> edges = {0};
      for (const double share : {0.25, 0.5, 1.})
        if (const double k = std::round(share * count); k > 0)
          if (const double end = list.empty() ? tidy(k * interval) : list[std::size_t(k) - 1]; end > edges.back())
            edges.push_back(end);
      return edges;
    }

    // Elements of one internal length give the width of the band within 4 %.
    double element_size(const continuum::Options &o)
    {
      return continuum::traits(o.law).has_length() ? std::min(o.material.internal_length, 3.) : 2;
    }

    // The largest step of the calibrations of the default law. With 0.005 one sample had the same peak and 1.2 % less dilation.
    double largest_step(const LoadingOptions &o)
    {
      return o.mode == discrete::LoadingMode::time ? tidy(o.duration / 32) : std::min(1.25e-3, tidy(o.axial_strain / 8));
    }

    // Whether the scene sets a key that its law uses, or the law itself.
    bool has_own_law(const continuum::Options &o, Given given)
    {
      for (const continuum::UnusedKey &unused : continuum::unused_keys(o))
        given.erase("continuum/" + unused.key);
      std::vector<std::string> keys = continuum::keys_of(o.material);
      keys.push_back("law");
      return std::any_of(keys.begin(), keys.end(), [&](const std::string &key) { return given.count("continuum/" + key) > 0; });
    }

    // Glued grains, and those that cannot roll, hold the sample like rough platens do. Along a strain only, and not in shear, for
    // which the interface was not measured.
    continuum::Platens platens_like_the_grains(const Scene &scene)
    {
      const discrete::ContactLawOptions &law = scene.discrete.law;
      if (scene.loading.mode != discrete::LoadingMode::descent || scene.sample.rough_platens || law.platen_rolling_friction > 0 ||
          scene.discrete.method.method == discrete::Method::imported ||
          scene.continuum.mesh.kind != continuum::MeshOption::Kind::outline)
        return continuum::Platens::rough;
      return law.platen_friction == 0 ? continuum::Platens::smooth : continuum::Platens::frictional;
    }

    // True if the default law was calibrated on grains of this preparation, grading, method, sides and loading.
    bool default_law_is_of_such_a_test(const Scene &scene)
    {
      const discrete::SampleOptions &o = scene.sample;
      return o.file.empty() && o.preparation_friction == 0 && o.target_solid_fraction == 0 &&
             o.radius_distribution == discrete::RadiusKind::uniform_by_number &&
             scene.discrete.method.method == discrete::Method::nscd &&
             scene.discrete.lateral.lateral != discrete::Lateral::none &&
             (scene.loading.mode == discrete::LoadingMode::descent || scene.loading.mode == discrete::LoadingMode::path) &&
             scene.continuum.mesh.kind == continuum::MeshOption::Kind::outline;
    }

    // The first number beyond the range of the calibrations of the default law, with this range; empty if there is none.
    std::string beyond_calibrations(const Scene &scene)
    {
      const discrete::SampleOptions &o    = scene.sample;
      const auto                    &laws = calibrated[0];
      struct Range
      {
        const char *key;
        double      value, low, high;
      };
      for (const auto &[key, value, low, high] :
           {Range{"discrete/friction", scene.discrete.law.friction, laws.front().friction, laws.back().friction},
            Range{"discrete/rolling_friction", scene.discrete.law.rolling_friction, 0, calibrated.back()[0].rolling_friction},
            Range{"sample/grains", discrete::expected_grains(o), 1000, 2500},
            Range{"sample/radius_min", o.radius_min, 0.25, 0.35}, Range{"sample/width_over_height", o.width_over_height, 0.5, 1},
            Range{"loading/inertial_number", inertial_number(scene), 0, largest_quasi_static},
            Range{"continuum/element_size", scene.continuum.element_size, 0, 2 * scene.continuum.material.internal_length}})
        if (!(value >= low && value <= high))
          {
            std::ostringstream text;
            text << key << ' ' << value << " lies outside the calibrated " << low << " to " << high;
            return text.str();
          }
      return "";
    }

    // Empty if the scene sets the law.
    std::string origin(const Scene &scene, const Given &given)
    {
      if (has_own_law(scene.continuum, given))
        return "";
      const bool        is_such = default_law_is_of_such_a_test(scene);
      const std::string beyond  = is_such ? beyond_calibrations(scene) : "";
      if (is_such && beyond.empty())
        return "defaults, calibrated on dense samples of 1500 discs with friction 0.2 to 0.8 (benchmarks/calibration/defaults)";
      return "defaults, not fitted to these grains" + (beyond.empty() ? "" : ": " + beyond) + "; diptych calibrate fits them";
    }

    struct DerivedKey
    {
      const char *name;
      const char *rule; // words for `explain`
      void (*derive)(Scene &scene, const Given &given);
    };

    continuum::LawOptions &law(Scene &scene)
    {
      return scene.continuum.material;
    }

    constexpr char by_friction[] = "from calibrations on dense samples, by discrete/friction and discrete/rolling_friction";

    // The rule of a key needs only keys that stand before it.
    const DerivedKey derived_keys[] = {
      {"loading/inertial_number", "1e-3 up to 2000 grains, 4e-4 for 4000, then lower with the square root of their number",
       [](Scene &s, const Given &) { s.loading.inertial_number = slow_enough(discrete::expected_grains(s.sample)); }},
      {"loading/axial_strain", "0.04; mode path with a table: the last progress of the table",
       [](Scene &s, const Given &) {
         if (s.loading.mode == discrete::LoadingMode::path && s.loading.path.names_a_file())
           s.loading.axial_strain = cell_path(s.loading.path, {s.loading.pressure}).progress.back();
       }},
      {"loading/stage_strain", "about 0.005, so that the end is a stage; at most 40 stages",
       [](Scene &s, const Given &) { s.loading.stage_strain = stage_length(s.loading.axial_strain, 0.005); }},
      {"loading/stage_time", "about 1, so that the end is a stage; at most 40 stages",
       [](Scene &s, const Given &) { s.loading.stage_time = stage_length(s.loading.duration, 1); }},
      {"continuum/platens",
       "rough; in compression of grains with an outline: smooth for discrete/platen_friction = 0, else frictional if"
       " discrete/platen_rolling_friction = 0",
       [](Scene &s, const Given &) { s.continuum.platens = platens_like_the_grains(s); }},
      {"continuum/platen_friction", "from samples, by both frictions of the grains; at most discrete/platen_friction",
       [](Scene &s, const Given &) {
         s.continuum.platen_friction = std::min(fitting(s).platens, s.discrete.law.platen_friction);
       }},
      {"continuum/platen_slip_length", by_friction,
       [](Scene &s, const Given &) { s.continuum.platen_slip_length = fitting(s).slip_length; }},
      {"continuum/hardening", "mobilisation",
       [](Scene &s, const Given &) { law(s).hardening = continuum::kind_of<continuum::MobilisationHardening>; }},
      {"continuum/youngs_modulus", by_friction,
       [](Scene &s, const Given &) { law(s).elastic.youngs_modulus = fitting(s).youngs_modulus; }},
      {"continuum/friction_angle_peak", by_friction,
       [](Scene &s, const Given &) { law(s).friction_angle_peak = fitting(s).peak; }},
      {"continuum/friction_angle_start", "a share of the peak angle, by both frictions of the grains",
       [](Scene &s, const Given &) { law(s).friction_angle_start = tidy(fitting(s).start * law(s).friction_angle_peak); }},
      {"continuum/friction_angle_residual", "a share of the peak angle, by both frictions of the grains",
       [](Scene &s, const Given &) { law(s).friction_angle_residual = tidy(fitting(s).residual * law(s).friction_angle_peak); }},
      {"continuum/dilatancy_angle_peak", "a share of friction_angle_start, by both frictions of the grains",
       [](Scene &s, const Given &) {
         law(s).dilatancy_angle_peak = tidy(fitting(s).dilatancy *
                                            std::min(law(s).friction_angle_start, law(s).friction_angle_peak));
       }},
      {"continuum/mobilisation_strain", "0.007", [](Scene &s, const Given &) { law(s).mobilisation_strain = 0.007; }},
      {"continuum/softening_strain", "0.3", [](Scene &s, const Given &) { law(s).softening_strain = 0.3; }},
      {"continuum/internal_length", "2", [](Scene &s, const Given &) { law(s).internal_length = 2; }},
      {"continuum/element_size", "the internal length, at most 3; 2 without one",
       [](Scene &s, const Given &) { s.continuum.element_size = element_size(s.continuum); }},
      {"continuum/min_step", "1e-5, at most the other steps that are given",
       [](Scene &s, const Given &given) {
         s.continuum.min_step = 1e-5;
         for (const auto &[key, step] : {std::pair("continuum/initial_step", s.continuum.initial_step),
                                         std::pair("continuum/max_step", s.continuum.max_step)})
           if (given.count(key) > 0)
             s.continuum.min_step = std::min(s.continuum.min_step, step);
       }},
      {"continuum/max_step", "0.00125 of strain, at most an eighth of the loading (mode time: duration / 32)",
       [](Scene &s, const Given &given) {
         const double first   = given.count("continuum/initial_step") > 0 ? s.continuum.initial_step : 0;
         s.continuum.max_step = std::max({largest_step(s.loading), s.continuum.min_step, first});
       }},
      {"continuum/initial_step", "0.001, at most max_step, at least min_step",
       [](Scene &s, const Given &) {
         s.continuum.initial_step = std::max(std::min(1e-3, s.continuum.max_step), s.continuum.min_step);
       }},
      {"comparison/window_edges", "0, a quarter, half and the end of the loading, at stages",
       [](Scene &s, const Given &) { s.comparison.window_edges = window_edges(s.loading); }},
      {"comparison/coarse_element_size", "twice continuum/element_size",
       [](Scene &s, const Given &) { s.comparison.coarse_element_size = std::clamp(2 * s.continuum.element_size, 0.1, 100.); }},
      {"comparison/parameters_from",
       "the origin of the default law, and its range where the grains lie outside; another law: nothing",
       [](Scene &s, const Given &given) { s.comparison.parameters_from = origin(s, given); }}};

    // Accuracy of the strength at kn/P = 1e4: explicit springs, and implicit ones with the step of that accuracy
    // (benchmarks/rigid_limit). From 4000 grains on the implicit ones cost two thirds of contact dynamics, or less.
    constexpr double accuracy_of_springs = 0.01, accuracy_of_compliant = 0.02, grains_for_compliant = 4000;

    // Reason why springs cannot replace contact dynamics in this scene, if there is one.
    std::optional<std::string> obstacle_to_springs(const Scene &scene)
    {
      const discrete::Options &o = scene.discrete;
      if (!scene.sample.file.empty())
        return "the number of grains in sample/file is unknown before the run";
      if (scene.loading.mode == discrete::LoadingMode::time || !(scene.loading.pressure > 0))
        return "the cost of springs was measured under pressure and along a strain";
      if (o.law.normal_restitution != 0 || o.law.tangential_restitution != 0 || o.method.store_problems)
        return "springs have neither restitution coefficients nor contact problems to store";
      return {};
    }

    // The method that `auto` chooses, and why.
    std::pair<discrete::Method, std::string> best_method(const Scene &scene)
    {
      using discrete::Method;
      const double accuracy = scene.discrete.accuracy.accuracy;
      if (has_no_pressure(discrete_loading(scene.loading)))
        return {Method::compliant, "loading/path prescribes exx and eyy, and rigid grains have no stress of their own then"};
      if (accuracy < accuracy_of_springs)
        return {Method::nscd, "springs are right to " + discrete::exact_text(accuracy_of_springs) + " only"};
      if (const auto obstacle = obstacle_to_springs(scene))
        return {Method::nscd, *obstacle};
      if (accuracy >= accuracy_of_compliant && discrete::expected_grains(scene.sample) >= grains_for_compliant)
        return {Method::compliant, "from 4000 grains on it is the cheapest method that is right to 0.02"};
      const double cost = cost_over_springs(scene, accuracy);
      return {cost > 1 ? Method::penalty : Method::nscd, "contact dynamics is expected to take " +
                                                           discrete::exact_text(std::round(100 * cost) / 100) +
                                                           " of the CPU time of explicit springs"};
    }

    void choose_method(Scene &scene, const Given &given)
    {
      using discrete::Method;
      discrete::Options &o       = scene.discrete;
      const bool         is_auto = o.method.method == Method::automatic;
      if (is_auto)
        std::tie(o.method.method, scene.method_reason) = best_method(scene);
      const bool chose_penalty = is_auto && o.method.method == Method::penalty;
      if ((chose_penalty || o.method.method == Method::compliant) && given.count("discrete/penalty_stiffness") == 0)
        o.penalty.stiffness = 1e4;
      if (chose_penalty && given.count("discrete/penalty_step_fraction") == 0)
        o.penalty.step_fraction = 0.5;
    }

    const DerivedKey *find(const std::string &key)
    {
      const auto found = std::find_if(std::begin(derived_keys), std::end(derived_keys),
                                      [&](const DerivedKey &one) { return key == one.name; });
      return found == std::end(derived_keys) ? nullptr : found;
    }
  } // namespace

  bool is_derived(const std::string &key)
  {
    return find(key) != nullptr;
  }

  std::string rule_of(const std::string &key)
  {
    return find(key)->rule;
  }

  double cost_over_springs(const Scene &scene, const double accuracy)
  {
    if (obstacle_to_springs(scene))
      return 0;
    // Explicit springs also take up the pressure before the loading.
    const double loading = scene.loading.axial_strain / inertial_number(scene);
    return loading / (loading + scene.discrete.penalty.preload) * 0.35 *
           std::pow(discrete::expected_grains(scene.sample) / 4000, 0.2) * std::pow(1e-3 / inertial_number(scene), 0.15) *
           std::pow(0.02 / accuracy, 1.5);
  }

  void derive_keys(Scene &scene, const Given &given)
  {
    for (const DerivedKey &key : derived_keys)
      if (given.count(key.name) == 0)
        key.derive(scene, given);
    choose_method(scene, given);
  }
} // namespace diptych::coupling
