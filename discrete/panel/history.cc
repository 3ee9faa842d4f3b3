// diptych: history of a loading, one row per step
// SPDX-License-Identifier: LGPL-2.1-or-later
#include "discrete/panel/history.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "discrete/contacts/contact_law.h"
#include "discrete/contacts/internal_moment.h"
#include "discrete/bodies/outline.h"
#include "discrete/stepping/step_problem.h"

namespace diptych::discrete
{
  namespace
  {
    // Sum of all grains' moments about their centres, and the norms that give the skew share. A force on a grain of a platen
    // contributes (height above the platen's surface) x force, like the forces on the platens. Forces along a rigid platen are
    // unknown.
    struct MomentSums
    {
      Eigen::Matrix2d total       = Eigen::Matrix2d::Zero();
      Eigen::Matrix2d core        = Eigen::Matrix2d::Zero(); // of the branches' parts in the middle half of the height
      double          skew_square = 0, square = 0;
      double          platens_xx = 0; // moment of the forces along the platens about a vertical line
    };

    struct Range
    {
      double low, high;

      // Share of a line between two heights that lies in the range.
      double share_of(const double from, const double to) const
      {
        const auto [least, most] = std::minmax(from, to);
        if (most - least < 1e-6 * (high - low))
          return to > low && to < high ? 1 : 0;
        return (std::clamp(most, low, high) - std::clamp(least, low, high)) / (most - least);
      }
    };
    Range core_of(const State &state) // empty without platens
    {
      if (state.walls.size() < 2)
        return {0, 0};
      const double low = state.walls[0].point.y(), high = state.walls[1].point.y();
      return {low + 0.25 * (high - low), high - 0.25 * (high - low)};
    }

    MomentSums sum_moments(const State &state, const StepResult &result, const double step, const Range &core)
    {
      const Grains                &g = state.grains;
      MomentSums                   sums;
      std::vector<Eigen::Matrix2d> moment(g.size(), Eigen::Matrix2d::Zero());
      std::vector<double>          couple(g.size(), 0.); // of rolling resistance; it balances the skew part
      Eigen::RowVector2d           on_platens = Eigen::RowVector2d::Zero();
      for (std::size_t k = 0; k < result.contacts.size(); ++k)
        {
          if (result.impulses[k].normal == 0)
            continue;
          const Contact         c     = make_contact(state, result.contacts[k].i, result.contacts[k].j);
          const Eigen::Vector2d force = impulse_vector(result.contacts[k], result.impulses[k]) / step;
          const double          turn  = couple_impulse(g, c, result.impulses[k]) / step;
          const auto            add   = [&](const int body, const double sign) {
            if (const int platen = g.platen(body); platen >= 0)
              on_platens += sign * (c.point.y() - state.walls[platen].point.y()) * force.transpose();
            else
              {
                const double          reach = g.radius[body] + 0.5 * c.gap, end = c.point.y();
                const Eigen::Matrix2d one = reach * c.normal * force.transpose();
                moment[body] += one;
                sums.core += core.share_of(end - sign * reach * c.normal.y(), end) * one;
              }
            couple[body] += sign * turn;
          };
          add(c.i, -1);
          if (std::size_t(c.j) < g.size())
            add(c.j, 1);
          const auto is_platen = [&](const int body) {
            return std::size_t(body) < g.size() ? g.platen(body) >= 0
                                                : state.walls[std::size_t(body) - g.size()].kind == WallKind::platen;
          };
          sums.platens_xx += (is_platen(c.i) - is_platen(c.j)) * c.point.x() * force.x();
        }
      for (std::size_t i = 0; i < g.size(); ++i)
        {
          const Eigen::Matrix2d &m = moment[i];
          sums.total += m;
          const double skew = g.platen(i) < 0 ? 0.5 * (m(0, 1) - m(1, 0) + couple[i]) : 0, mean = 0.5 * (m(0, 1) + m(1, 0));
          sums.skew_square += 2 * skew * skew;
          sums.square += m(0, 0) * m(0, 0) + m(1, 1) * m(1, 1) + 2 * mean * mean;
        }
      if (std::any_of(g.fixed.begin(), g.fixed.end(), [](const std::uint8_t fixed) { return fixed >= lower_platen_grain; }))
        {
          sums.total.row(1) += on_platens;
          sums.total(0, 1) = sums.total(1, 0); // platens resist rotation
        }
      for (Eigen::Matrix2d *sum : {&sums.total, &sums.core})
        *sum = (0.5 * (*sum + sum->transpose())).eval();
      return sums;
    }

    // End grains and side walls. Where they carry the pressure P at the outline, it is P.
    double side_sxx(const State &state, const StepResult &result, const StepSetting &setting, const double area)
    {
      const Grains &g      = state.grains;
      double        moment = 0; // outwards
      if (std::holds_alternative<EndGrains>(setting.lateral))
        for (std::size_t i = 0; i < g.size(); ++i)
          moment += g.position[i].x() * (result.applied_force[i].x() - !g.fixed[i] * g.mass[i] * setting.stepping.gravity_x);
      for (std::size_t w = 2; w < result.wall_force.size(); ++w)
        moment += state.walls[w].point.x() * result.wall_force[w].x();
      return (0. - moment) / area;
    }

    double sliding_share(const StepResult &result, const State &state, const StepSetting &setting)
    {
      int       closed = 0, sliding = 0;
      const int n = int(state.grains.size());
      for (std::size_t k = 0; k < result.contacts.size(); ++k)
        {
          const int wall = result.contacts[k].j - n;
          if (wall < 0 || state.walls[wall].kind != WallKind::platen || result.impulses[k].normal <= 0)
            continue;
          ++closed;
          sliding += is_slipping(setting.law.platen_friction, result.impulses[k]);
        }
      return closed > 0 ? double(sliding) / closed : 0;
    }

    void describe_lattice(const Lattice &lattice, const LatticeStress &stress, HistoryRow &row)
    {
      row.strain       = {lattice.strain[0], lattice.strain[1], 0.5 * lattice.strain[2]};
      row.drive_stress = stress.drive;
      row.stress << stress.contacts[0], stress.contacts[2], stress.contacts[2], stress.contacts[1];
    }

    // Coordination and fabric. Needs row.contacts and row.rattlers.
    void describe_contacts(const StepResult &result, const std::size_t n_grains, HistoryRow &row)
    {
      int             ends = 0, pairs = 0;
      Eigen::Matrix2d fabric = Eigen::Matrix2d::Zero();
      for (std::size_t k = 0; k < result.contacts.size(); ++k)
        {
          const Contact &c = result.contacts[k];
          if (!(result.impulses[k].normal > 0))
            continue;
          const bool pair = std::size_t(c.j) < n_grains;
          ends += pair ? 2 : 1;
          pairs += pair;
          if (pair)
            fabric += c.normal * c.normal.transpose();
        }
      const int carrying = int(n_grains) - row.rattlers;
      row.coordination   = carrying > 0 ? double(ends) / carrying : 0;
      fabric /= std::max(pairs, 1);
      const double d = fabric(0, 0) - fabric(1, 1), s = 2 * fabric(0, 1);
      row.fabric_anisotropy = 2 * std::hypot(d, s);
      row.fabric_angle      = 0.5 * std::atan2(s, d) * 180 / M_PI;
    }
  } // namespace

  Strains strains_of(const State &state, const Reference &reference)
  {
    if (const Lattice *lattice = state.lattice())
      return {1 - std::exp(-lattice->strain[1]), lattice->strain[2]};
    const Eigen::Vector2d travel = state.walls[1].point - reference.platen;
    return {(0. - travel.y()) / reference.height, travel.x() / reference.height};
  }

  Reference make_reference(const State &state, const double mean_diameter, const double strain_rate)
  {
    Reference reference;
    reference.position       = state.grains.position;
    reference.height         = sample_height(state);
    reference.area           = outline_area(make_outline(state, mean_diameter));
    reference.kinetic_energy = kinetic_energy(state);
    for (const double r : state.grains.radius)
      reference.grain_area += M_PI * r * r;
    const double mass               = std::accumulate(state.grains.mass.begin(), state.grains.mass.end(), 0.);
    reference.mean_density          = mass / reference.grain_area;
    reference.platen_kinetic_energy = 0.25 * mass * std::pow(strain_rate * reference.height, 2);
    reference.strain_rate           = strain_rate;
    if (!state.walls.empty())
      {
        reference.platen                = state.walls[1].point;
        reference.platen_kinetic_energy = 0.25 * mass * state.walls[1].velocity.squaredNorm();
      }
    return reference;
  }

  std::vector<std::uint8_t> rattlers(const StepResult &result, const Grains &grains)
  {
    const std::size_t         n_grains = grains.size();
    std::vector<std::uint8_t> free(n_grains);
    for (std::size_t i = 0; i < n_grains; ++i)
      free[i] = !grains.fixed[i];
    for (std::size_t k = 0; k < result.contacts.size(); ++k)
      if (result.impulses[k].normal > 0)
        {
          free[result.contacts[k].i] = 0;
          if (std::size_t(result.contacts[k].j) < n_grains)
            free[result.contacts[k].j] = 0;
        }
    return free;
  }

  void add_step(const StepResult &result, const StepSetting &setting, HistoryRow &row)
  {
    ++row.step;
    row.sweeps += result.solve.sweeps;
    row.residual          = result.solve.residual;
    row.max_penetration   = std::max(row.max_penetration, result.largest_penetration / setting.mean_diameter);
    row.momentum_residual = std::max(row.momentum_residual, result.momentum_residual);
    row.friction_dissipation += result.energies.friction_dissipation;
    row.impact_dissipation += result.energies.impact_dissipation;
    row.rolling_dissipation += result.energies.rolling_dissipation;
    row.external_work += result.energies.external_work;
    row.correction_work += result.energies.correction_work;
  }

  void describe_state(const State       &state,
                      const StepResult  &result,
                      const Reference   &reference,
                      const StepSetting &setting,
                      HistoryRow        &row)
  {
    const Outline    outline = make_outline(state, setting.mean_diameter);
    const Range      core    = core_of(state);
    const double     area    = outline_area(outline);
    const auto       spins   = spin_terms(state.grains);
    const double     spin    = std::accumulate(spins.begin(), spins.end(), 0.);
    const MomentSums sums    = sum_moments(state, result, setting.step, core);
    const Strains    strains = strains_of(state, reference);

    row.time         = state.time;
    row.axial_strain = strains.axial;
    row.shear_strain = strains.shear;
    row.stress       = (sums.total - spin * Eigen::Matrix2d::Identity()) / area;
    if (const Lattice *lattice = state.lattice())
      describe_lattice(*lattice, result.lattice, row);
    row.stress_ratio = stress_ratio(row.stress);
    row.core_stress  = row.stress; // a cell is alike everywhere
    if (core.low < core.high)
      row.core_stress = sums.core / outline_area(outline, core.low, core.high);
    row.width             = area / sample_height(state);
    row.side_sxx          = side_sxx(state, result, setting, area);
    row.platen_sxx        = sums.platens_xx / area;
    row.volumetric_strain = 1 - area / reference.area;
    row.solid_fraction    = reference.grain_area / area;
    if (!state.walls.empty())
      {
        row.lower_force = result.wall_force[0];
        row.upper_force = result.wall_force[1];
      }
    if (result.wall_force.size() >= 4)
      {
        row.left_force  = result.wall_force[2];
        row.right_force = result.wall_force[3];
      }
    row.contacts = int(
      std::count_if(result.impulses.begin(), result.impulses.end(), [](const Impulse &r) { return r.normal > 0; }));
    row.kinetic_energy       = result.energies.kinetic;
    row.kinetic_energy_ratio = reference.platen_kinetic_energy > 0 ? row.kinetic_energy / reference.platen_kinetic_energy : 0;
    const double change      = row.kinetic_energy - reference.kinetic_energy;
    const double scale       = std::max({std::abs(row.external_work), std::abs(row.friction_dissipation),
                                         std::abs(row.rolling_dissipation), std::abs(row.impact_dissipation), row.kinetic_energy,
                                         reference.kinetic_energy});
    const double excess      = change - row.external_work + row.friction_dissipation + row.impact_dissipation +
                          row.rolling_dissipation;
    row.energy_residual = scale > 0 ? excess / scale : 0;
    const double s      = 0.5 * row.stress.trace();
    row.inertial_number = s > 0 ? reference.strain_rate * setting.mean_diameter * std::sqrt(reference.mean_density / s) : 0;
    const std::vector<std::uint8_t> free = rattlers(result, state.grains);
    row.rattlers                         = int(std::count(free.begin(), free.end(), 1));
    row.spin_term_share                  = s > 0 ? spin / area / s : 0;
    row.unbalanced_force                 = result.unbalanced_force;
    row.platen_sliding                   = sliding_share(result, state, setting);
    describe_contacts(result, state.grains.size(), row);
    row.skew_moment = sums.square > 0 ? std::sqrt(sums.skew_square / sums.square) : 0;
  }
} // namespace diptych::discrete
