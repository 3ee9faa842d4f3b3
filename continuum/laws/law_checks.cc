// diptych: checks that every constitutive law must pass, one of the user too
// SPDX-License-Identifier: LGPL-2.1-or-later
#include "continuum/laws/law_checks.h"

#include <algorithm>
#include <cmath>
#include <random>
#include <sstream>

#include "continuum/laws/plastic_flow.h"
#include "continuum/laws/rotation.h"

namespace diptych::continuum
{
  namespace
  {
    constexpr double turn_angle = 0.7, d_time = 1e-3;

    MaterialUpdate answer_of(const Law &law, const MaterialState &s0, const Strain &e)
    {
      return std::visit([&](const auto &one) { return one.update(s0, e, d_time); }, law);
    }

    Tangent stiffness_of(const Law &law)
    {
      return std::visit([](const auto &one) { return one.elastic_tangent(); }, law);
    }

    // Positive also for the components that a classical law lacks.
    double unit_of(const Tangent &stiffness, const unsigned int i)
    {
      return std::sqrt(stiffness[i][i] > 0 ? stiffness[i][i] : stiffness[xx][xx]);
    }

    Tangent central_difference(const Law &law, const MaterialState &s0, const Strain &e, const double step)
    {
      Tangent difference;
      for (unsigned int k = 0; k < n_components; ++k)
        {
          Strain up = e, down = e;
          up[k] += step;
          down[k] -= step;
          const Stress column = (answer_of(law, s0, up).state.stress - answer_of(law, s0, down).state.stress) / (2 * step);
          for (unsigned int i = 0; i < n_components; ++i)
            difference[i][k] = column[i];
        }
      return difference;
    }

    struct LargestEntry
    {
      unsigned int i = 0, k = 0;
      double       size = 0;
    };

    LargestEntry largest_entry(const Tangent &t, const Tangent &stiffness)
    {
      LargestEntry largest;
      for (unsigned int i = 0; i < n_components; ++i)
        for (unsigned int k = 0; k < n_components; ++k)
          if (const double size = std::abs(t[i][k]) / (unit_of(stiffness, i) * unit_of(stiffness, k)); size > largest.size)
            largest = {i, k, size};
      return largest;
    }

    // "; d s_xx / d e_yy = 2, but differences give -2: the sign is turned", for the entry with the largest error.
    std::string text_of_error(const Tangent &tangent, const Tangent &difference, const Tangent &stiffness)
    {
      const char *strain[]     = {"e_xx", "e_yy", "gamma_xy", "rotation", "curvature_x", "curvature_y"},
                 *stress[]     = {"s_xx", "s_yy", "s_xy", "skew part", "m_x", "m_y"};
      const LargestEntry e     = largest_entry(tangent - difference, stiffness);
      const double       given = tangent[e.i][e.k], right = difference[e.i][e.k];
      std::ostringstream text;
      text << "; d " << stress[e.i] << " / d " << strain[e.k] << " = " << given << ", but differences give " << right;
      if (std::abs(given + right) < 1e-3 * std::abs(given))
        text << ": a sign is turned; tension is positive, in stress and in strain";
      return text.str();
    }

    bool same_regime_around(const Law &law, const MaterialState &s0, const Strain &e, const double step)
    {
      const Regime regime = answer_of(law, s0, e).regime;
      for (unsigned int k = 0; k < n_components; ++k)
        for (const double sign : {-1., 1.})
          {
            Strain beside = e;
            beside[k] += sign * step;
            if (answer_of(law, s0, beside).regime != regime)
              return false;
          }
      return true;
    }

    bool same_bits(const MaterialUpdate &a, const MaterialUpdate &b)
    {
      return a.state.stress == b.state.stress && a.tangent == b.tangent && a.state.stress_zz == b.state.stress_zz &&
             a.state.equivalent_plastic_strain == b.state.equivalent_plastic_strain &&
             part_of<LibraryState>(a.state) == part_of<LibraryState>(b.state) && a.regime == b.regime && a.verdict == b.verdict;
    }

    MaterialState turned_state(const Law &law, MaterialState state)
    {
      state.stress = turned(state.stress, turn_angle, 1);
      if (auto *moving = std::get_if<KinematicState>(&state.own))
        moving->back_stress_ratio = turned(moving->back_stress_ratio, turn_angle, 1);
      if (const auto *library = std::get_if<LibraryLaw>(&law))
        library->turn_variables(state, turn_angle);
      return state;
    }

    std::string text_of(const char *name, const Strain &values, const unsigned int n)
    {
      std::ostringstream text;
      text << name;
      for (unsigned int k = 0; k < n; ++k)
        text << ' ' << values[k];
      return text.str();
    }

    LawCheck check(const char *name, const double allowed, const char *unit)
    {
      LawCheck made;
      made.name    = name;
      made.allowed = allowed;
      made.unit    = unit;
      return made;
    }

    class Checks
    {
    public:
      Checks(const Law &law, const Units &units)
          : law(law),
            units(units),
            stiffness(stiffness_of(law)),
            n(stiffness[curvature_x][curvature_x] > 0 ? n_components : n_classical)
      {}

      std::vector<LawCheck> made()
      {
        constexpr int paths = 60, steps = 16;
        const double  sizes[] = {1e-5, 1e-4, 5e-4, 3e-3};
        for (int k = 0; k < paths; ++k)
          drive(k, steps, sizes[k % 4]);
        if (tangent.n_judged < tangent.n_not_judged)
          tangent.trouble = "most answers are not smooth enough for differences";
        // Only a library gives plastic strain and dissipation independently. A Cosserat law dissipates in more components.
        if (std::holds_alternative<LibraryLaw>(law) && dissipated > 0 && of_plastic_strain < -0.5 * dissipated)
          {
            dissipation.deviation = -of_plastic_strain / units.stress;
            dissipation.trouble   = "plastic_strain has a turned sign: its work on the stress is " +
                                  std::to_string(of_plastic_strain) + " in all paths, the dissipation " +
                                  std::to_string(dissipated) + "; tension is positive, in stress and in strain";
          }
        return {answers, repeatability, tangent, objectivity, dissipation};
      }

    private:
      // Loads, turns back after two thirds and loads on in the first direction, with a part of every step at random.
      void drive(const int path, const int steps, const double size)
      {
        MaterialState state;
        state.stress[xx] = state.stress[yy] = state.stress_zz = -units.stress;
        std::visit([&](const auto &one) { start(one, state); }, law);
        const std::vector<Strain> directions = random_strains((path + 1) * (steps + 1), 1);
        const Strain             &main       = directions[std::size_t(path * (steps + 1))];
        for (int k = 0; k < steps; ++k)
          {
            const double back = k > steps / 2 && k < 2 * steps / 3 ? -1 : 1;
            Strain       e    = back * main + 0.4 * directions[std::size_t(path * (steps + 1) + k + 1)];
            for (unsigned int i = n; i < n_components; ++i)
              e[i] = 0;
            for (const Component i : {curvature_x, curvature_y})
              e[i] /= units.length;
            e *= size;
            const double low = 0.1 * units.stress;
            if (-(state.stress[xx] + state.stress[yy]) / 2 < low || !judge(path, k, e, state))
              return;
          }
      }

      // Makes the step. Returns whether the path goes on.
      bool judge(const int path, const int step, const Strain &e, MaterialState &state)
      {
        place = "path " + std::to_string(path + 1) + ", step " + std::to_string(step + 1) + ", " +
                text_of("strain increment", e, n) + ", " + text_of("stress before", state.stress, n) + ", zz " +
                std::to_string(state.stress_zz);
        MaterialUpdate answer = answer_of(law, state, e);
        const bool     failed = answer.verdict == Verdict::failed, is_small = e.norm() < 2e-4;
        if (is_small)
          note(answers, failed ? 1 : 0);
        if (const auto *library = std::get_if<LibraryLaw>(&law); failed && library != nullptr)
          {
            // An answer that is not finite is a fault even in a step that the law may refuse.
            const LibraryLaw::Failure why = library->failure(state, e, d_time);
            if ((is_small || why.is_not_finite) && answers.trouble.empty())
              answers.trouble = why.text;
          }
        if (failed)
          return false;
        note(repeatability, same_bits(answer, answer_of(law, state, e)) ? 0 : 1);
        const DifferenceRule rule{1e-4, 1e-6};
        if (const auto error = tangent_error(law, state, e, rule))
          note(tangent, *error,
               *error > std::max(tangent.deviation, tangent.allowed)
                 ? text_of_error(answer.tangent, central_difference(law, state, e, rule.step * e.norm()), stiffness)
                 : "");
        else
          ++tangent.n_not_judged;
        judge_objectivity(state, e, answer);
        const MaterialState s0 = state;
        std::visit([&](const auto &one) { add_plastic_flow(one.moduli(), s0, e, answer.state); }, law);
        state = answer.state;
        if (largest_in_tension(state) < 0)
          note(dissipation, std::max(0., s0.dissipation - state.dissipation) / units.stress);
        add_plastic_work(s0, state);
        return true;
      }

      void add_plastic_work(const MaterialState &s0, const MaterialState &s1)
      {
        const PlasticStrain &a = s0.plastic_strain, &b = s1.plastic_strain;
        of_plastic_strain += s1.stress[xx] * (b.xx - a.xx) + s1.stress[yy] * (b.yy - a.yy) + s1.stress_zz * (b.zz - a.zz) +
                             s1.stress[xy] * (b.xy - a.xy);
        dissipated += s1.dissipation - s0.dissipation;
      }

      void judge_objectivity(const MaterialState &s0, const Strain &e, const MaterialUpdate &answer)
      {
        const MaterialUpdate other = answer_of(law, turned_state(law, s0), turned(e, turn_angle, 2));
        if (other.verdict == Verdict::failed || other.regime != answer.regime)
          {
            ++objectivity.n_not_judged;
            return;
          }
        const Stress difference = turned(answer.state.stress, turn_angle, 1) - other.state.stress;
        double       largest    = std::abs(answer.state.stress_zz - other.state.stress_zz);
        for (unsigned int i = 0; i < n; ++i)
          largest = std::max(largest, std::abs(difference[i]) * unit_of(stiffness, xx) / unit_of(stiffness, i));
        note(objectivity, largest / units.stress);
      }

      void note(LawCheck &check, const double deviation, const std::string &more = "")
      {
        ++check.n_judged;
        if (deviation > check.deviation || check.where.empty())
          {
            check.deviation = std::max(check.deviation, deviation);
            check.where     = place + more;
          }
      }

      const Law   &law;
      Units        units;
      Tangent      stiffness;
      unsigned int n;
      std::string  place;
      double       of_plastic_strain = 0, dissipated = 0; // work of all steps [pressure]
      LawCheck     answers       = check("answers", 0, "steps without one");
      LawCheck     repeatability = check("repeatability", 0, "other answers");
      LawCheck     tangent       = check("tangent", 1e-5, "of the stiffness at rest");
      LawCheck     objectivity   = check("objectivity", 1e-8, "of the pressure");
      LawCheck     dissipation   = check("dissipation", 1e-10, "of the pressure, negative plastic work");
    };
  } // namespace

  std::vector<LawCheck> check_law(const Law &law, const Units &units)
  {
    return Checks(law, units).made();
  }

  double largest_in_tension(const MaterialState &state)
  {
    const Stress &s        = state.stress;
    const double  in_plane = s[xx] + s[yy], radius = shear_radius(s);
    const double  major = std::max(in_plane / 2 + radius, state.stress_zz),
                 minor  = std::min(in_plane / 2 - radius, state.stress_zz);
    return std::max(in_plane, major + minor);
  }

  std::vector<Strain> random_strains(const int n, const double size)
  {
    std::mt19937        random(11);
    std::vector<Strain> strains(static_cast<std::size_t>(n));
    for (Strain &e : strains)
      {
        for (unsigned int k = 0; k < n_components; ++k)
          e[k] = 2. * double(random()) / double(random.max()) - 1;
        e *= size / e.norm();
      }
    return strains;
  }

  Stress turned(const Stress &a, const double angle, const double shear_factor)
  {
    Stress b = a;
    b[xy] /= shear_factor;
    turn(b, angle);
    b[xy] *= shear_factor;
    return b;
  }

  std::optional<double> tangent_error(const Law &law, const MaterialState &s0, const Strain &e, const DifferenceRule &rule)
  {
    const double  step = rule.step * e.norm();
    const Tangent unit = stiffness_of(law);
    if (!same_regime_around(law, s0, e, step))
      return {};
    const Tangent difference = central_difference(law, s0, e, step);
    if (rule.kink < 1 && largest_entry(central_difference(law, s0, e, step / 2) - difference, unit).size > rule.kink)
      return {};
    return largest_entry(answer_of(law, s0, e).tangent - difference, unit).size;
  }
} // namespace diptych::continuum
