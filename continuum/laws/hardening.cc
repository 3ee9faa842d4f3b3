// diptych: friction, dilatancy and cohesion as functions of plastic strain
// SPDX-License-Identifier: LGPL-2.1-or-later
#include "continuum/laws/hardening.h"

#include <algorithm>
#include <cmath>

namespace diptych::continuum
{
  namespace
  {
    HardeningForm form_of(const LawOptions &options, const bool is_nonlocal)
    {
      std::optional<HardeningForm> form;
      Hardenings::with_type(options.hardening, [&](auto *chosen) { form = TypeOf<decltype(chosen)>(options, is_nonlocal); });
      return *form;
    }

    // A square root gives the cosine faster than std::cos. All angles lie between -90 and 90 degrees.
    StrengthBySines by_sines(const Strength &s)
    {
      const double sin_phi = std::sin(s.friction.value), sin_psi = std::sin(s.dilatancy.value), cos_phi = cosine(sin_phi);
      return {{sin_phi, cos_phi * s.friction.rate}, {sin_psi, cosine(sin_psi) * s.dilatancy.rate}, s.cohesion, cos_phi};
    }
  } // namespace

  Hardening::Hardening(const LawOptions &options, const double nonlocal_weight)
      : form_(form_of(options, nonlocal_weight > 0)),
        nonlocal_weight(nonlocal_weight)
  {}

  Strength Hardening::angles(const HardeningState &state, double falls, const double rises) const
  {
    const double kappa    = state.equivalent_plastic_strain;
    double       softened = kappa;
    if (nonlocal_weight > 0)
      {
        softened = std::max((1 - nonlocal_weight) * kappa + nonlocal_weight * state.nonlocal_plastic_strain, 0.);
        if (softened == 0)
          falls = 0;
      }
    return std::visit(
      [&](const auto &one) {
        Strength s;
        if constexpr (!std::is_base_of_v<CriticalStateHardening, std::decay_t<decltype(one)>>)
          {
            const Strength f = one.falling(softened), r = one.rising(kappa);
            const auto     sum = [&](const Rated &a, const Rated &b) {
              return Rated{a.value + b.value, a.rate * falls + b.rate * rises};
            };
            s = {sum(f.friction, r.friction), sum(f.dilatancy, r.dilatancy), sum(f.cohesion, r.cohesion)};
          }
        return s;
      },
      form_);
  }

  Strength Hardening::at(const HardeningState &state) const
  {
    if (!critical())
      return angles(state, 1 - nonlocal_weight, 1);
    const StrengthBySines s = critical()->sines(state);
    return {{std::asin(s.friction.value), s.friction.rate / s.friction_cosine},
            {std::asin(s.dilatancy.value), s.dilatancy.rate / cosine(s.dilatancy.value)},
            s.cohesion};
  }

  StrengthBySines Hardening::sines_at(const HardeningState &state) const
  {
    return critical() ? critical()->sines(state) : by_sines(angles(state, 1 - nonlocal_weight, 1));
  }

  StrengthBySines Hardening::sines_by_nonlocal(const HardeningState &state) const
  {
    return by_sines(angles(state, nonlocal_weight, 0));
  }

  HardeningState Hardening::after(const HardeningState &state, const double multiplier) const
  {
    if (critical())
      return critical()->after(state, multiplier);
    HardeningState end = state;
    end.equivalent_plastic_strain += multiplier;
    return end;
  }

  void Hardening::write(const HardeningState &from, MaterialState &state) const
  {
    state.equivalent_plastic_strain = from.equivalent_plastic_strain;
    if (!critical())
      return;
    const bool     moves = std::holds_alternative<KinematicHardening>(form_);
    CriticalState &own   = moves ? own_part<KinematicState>(state) : own_part<CriticalState>(state);
    own                  = {from.stress_ratio_gain, from.densification};
  }

  std::optional<Rated> Hardening::mean_dilation(const HardeningState &start,
                                                const HardeningState &end,
                                                const double          multiplier) const
  {
    if (!critical())
      return {};
    return critical()->mean_dilation(start, end, multiplier);
  }
} // namespace diptych::continuum
