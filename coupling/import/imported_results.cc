// diptych: converts another code's sample to results of the discrete panel
// SPDX-License-Identifier: LGPL-2.1-or-later
#include "coupling/import/imported_results.h"

#include <algorithm>
#include <cmath>

#include "coupling/scene/scene_error.h"
#include "discrete/bodies/outline.h"
#include "discrete/contacts/internal_moment.h"
#include "discrete/files/csv_file.h"

namespace diptych::coupling
{
  namespace
  {
    using discrete::HistoryRow;
    using discrete::LoadingVariable;
    using discrete::Snapshot;

    bool has_sides(const ArrivedFrame &f)
    {
      return std::isfinite(f.wall[int(Side::left)]) && std::isfinite(f.wall[int(Side::right)]);
    }

    discrete::State state_of(const ArrivedFrame &f)
    {
      discrete::State state;
      state.grains.position = f.position;
      state.grains.radius   = f.radius;
      state.walls.resize(has_sides(f) ? 4 : 2);
      for (std::size_t side = 0; side < state.walls.size(); ++side)
        {
          state.walls[side].point                   = Eigen::Vector2d::Zero();
          state.walls[side].point[side < 2 ? 1 : 0] = f.wall[side];
        }
      return state;
    }

    // (1/2) omega^2 I of discs; 0 if spin or mass is unknown.
    std::vector<double> spin_terms(const ArrivedFrame &f)
    {
      std::vector<double> terms;
      for (std::size_t i = 0; i < f.spin.size(); ++i)
        {
          const double term = 0.25 * f.mass[i] * f.radius[i] * f.radius[i] * f.spin[i] * f.spin[i];
          terms.push_back(std::isfinite(term) ? term : 0);
        }
      return terms;
    }

    void add_kinematics(const ArrivedFrame &f, const ArrivedFrame &first, const double diameter, Snapshot &s)
    {
      const double height         = first.wall[int(Side::upper)] - first.wall[int(Side::lower)];
      s.upper_platen_displacement = {f.upper_travel - first.upper_travel,
                                     f.wall[int(Side::upper)] - first.wall[int(Side::upper)]};
      s.axial_strain              = 1 - (f.wall[int(Side::upper)] - f.wall[int(Side::lower)]) / height;
      s.shear_strain              = s.upper_platen_displacement.x() / height;
      s.time                      = f.time - (std::isfinite(first.time) ? first.time : 0);
      s.step                      = not_told;
      s.residual                  = not_told;
      s.mean_diameter             = diameter;
      s.position                  = f.position;
      s.velocity                  = f.velocity;
      s.spin                      = f.spin;
      s.radius                    = f.radius;
      s.mass                      = f.mass;
      for (std::size_t i = 0; i < f.position.size(); ++i)
        {
          s.displacement.push_back(f.position[i] - first.position[i]);
          s.rotation.push_back(f.rotation[i] - first.rotation[i]);
        }
      s.fixed.assign(f.position.size(), 0);
      s.applied_force                 = f.weight;
      s.lower_y                       = f.wall[int(Side::lower)];
      s.upper_y                       = f.wall[int(Side::upper)];
      s.left_x                        = f.wall[int(Side::left)];
      s.right_x                       = f.wall[int(Side::right)];
      s.lower_platen_force            = f.wall_force[int(Side::lower)];
      s.upper_platen_force            = f.wall_force[int(Side::upper)];
      constexpr double most_diameters = 1e5;
      if (const double n = (s.upper_y - s.lower_y) / diameter; !(n >= 1 && n <= most_diameters))
        throw SceneError(f.wall_file + ": frame " + f.name + ": the lower and the upper wall are " + discrete::exact_text(n) +
                         " mean diameters apart; 1 to 100000 are allowed");
      const discrete::State state = state_of(f);
      s.outline                   = discrete::make_outline(state, diameter);
      s.area                      = discrete::outline_area(s.outline);
    }

    // One instant replaces the mean over the stage, because files contain no more.
    void add_contacts(const ArrivedFrame &f, Snapshot &s)
    {
      const std::size_t n = f.position.size();
      s.contacts          = f.contacts;
      s.status            = f.status;
      s.rattler.assign(n, 1);
      for (const discrete::ContactForce &c : f.contacts)
        {
          const Eigen::Vector2d &x    = f.position[std::size_t(c.i)];
          s.rattler[std::size_t(c.i)] = 0;
          if (std::size_t(c.j) < n)
            s.rattler[std::size_t(c.j)] = 0;
          const double distance = std::size_t(c.j) < n
                                    ? (x - f.position[std::size_t(c.j)]).norm() - f.radius[std::size_t(c.j)]
                                    : std::abs(x[std::size_t(c.j) - n < 2 ? 1 : 0] - f.wall[std::size_t(c.j) - n]);
          s.gap.push_back(distance - f.radius[std::size_t(c.i)]);
        }
      s.mean_spin_term       = spin_terms(f);
      s.internal_moment      = discrete::internal_moments(s.position, s.contacts, s.mean_spin_term);
      s.window_forces        = s.contacts;
      s.mean_internal_moment = s.internal_moment;
      if (!f.has_contacts)
        {
          s.internal_moment.assign(n, Eigen::Matrix2d::Constant(not_told));
          s.mean_internal_moment = s.internal_moment;
        }
    }

    double kinetic_energy(const ArrivedFrame &f)
    {
      double energy = 0;
      for (std::size_t i = 0; i < f.mass.size(); ++i)
        energy += 0.5 * f.mass[i] * (f.velocity[i].squaredNorm() + 0.5 * f.radius[i] * f.radius[i] * f.spin[i] * f.spin[i]);
      return energy;
    }

    // Mean over grains of the sum of forces on each / mean normal contact force.
    double unbalanced_force(const ArrivedFrame &f)
    {
      std::vector<Eigen::Vector2d> sum    = f.weight;
      double                       normal = 0, total = 0;
      for (const discrete::ContactForce &c : f.contacts)
        {
          sum[std::size_t(c.i)] += c.force;
          if (std::size_t(c.j) < sum.size())
            sum[std::size_t(c.j)] -= c.force;
          normal += c.force.dot(c.normal) / double(f.contacts.size());
        }
      for (const Eigen::Vector2d &force : sum)
        total += force.norm() / double(sum.size());
      return total / normal;
    }

    double sliding_share(const ArrivedFrame &f)
    {
      int closed = 0, sliding = 0;
      for (std::size_t k = 0; k < f.contacts.size(); ++k)
        if (const int wall = f.contacts[k].j - int(f.position.size()); wall == 0 || wall == 1)
          {
            ++closed;
            sliding += f.status[k] == discrete::ContactStatus::slipping;
          }
      const bool told = std::none_of(f.status.begin(), f.status.end(),
                                     [](const auto s) { return s == discrete::ContactStatus::unknown; });
      return told && closed > 0 ? double(sliding) / closed : not_told;
    }

    HistoryRow row_of(const Arrival &arrival, const std::size_t k, const Snapshot &s, const double first_area)
    {
      const ArrivedFrame &f = arrival.frames[k];
      HistoryRow          row;
      row.step             = int(k);
      row.time             = s.time;
      row.axial_strain     = s.axial_strain;
      row.shear_strain     = s.shear_strain;
      row.progress         = s.progress;
      row.loading_variable = s.loading_variable;
      row.stress.setZero();
      double discs = 0;
      for (std::size_t i = 0; i < s.internal_moment.size(); ++i)
        {
          row.stress += s.internal_moment[i] / s.area;
          discs += M_PI * s.radius[i] * s.radius[i];
        }
      row.stress_ratio         = row.stress.allFinite() ? discrete::stress_ratio(row.stress) : not_told;
      row.volumetric_strain    = 1 - s.area / first_area;
      row.solid_fraction       = discs / s.area;
      row.lower_force          = f.wall_force[0];
      row.upper_force          = f.wall_force[1];
      row.left_force           = f.wall_force[2];
      row.right_force          = f.wall_force[3];
      row.contacts             = int(f.contacts.size());
      row.rattlers             = int(std::count(s.rattler.begin(), s.rattler.end(), 1));
      row.kinetic_energy       = kinetic_energy(f);
      row.kinetic_energy_ratio = row.friction_dissipation = row.impact_dissipation = row.external_work = not_told;
      row.correction_work = row.rolling_dissipation = row.energy_residual = row.momentum_residual = row.residual =
        row.skew_moment                                                                           = not_told;
      row.inertial_number = row.spin_term_share = not_told;
      row.max_penetration                       = arrival.checks[k].largest_overlap;
      row.unbalanced_force                      = f.contacts.empty() ? not_told : unbalanced_force(f);
      row.platen_sliding                        = sliding_share(f);
      const double mean                         = 0.5 * row.stress.trace();
      double       spin                         = 0;
      for (const double term : s.mean_spin_term)
        spin += term;
      if (std::isfinite(f.spin[0]) && std::isfinite(f.mass[0]))
        row.spin_term_share = spin / s.area / mean;
      return row;
    }

    // The strain that grows from frame to frame.
    LoadingVariable loading_variable_of(const std::vector<Snapshot> &snapshots, const Arrival &arrival)
    {
      const auto ascends = [&](const auto &strain) {
        for (std::size_t k = 1; k < snapshots.size(); ++k)
          if (!(strain(snapshots[k]) > strain(snapshots[k - 1]) + 1e-9))
            return false;
        return true;
      };
      const bool axial = ascends([](const Snapshot &s) { return s.axial_strain; }),
                 shear = ascends([](const Snapshot &s) { return s.shear_strain; });
      if (!axial && !shear)
        throw SceneError(arrival.frames.back().wall_file + ": frame " + arrival.frames.front().name + " to frame " +
                         arrival.frames.back().name +
                         ": the frames are not a monotonic loading: neither the descent of the upper wall nor its motion to the "
                         "right grows from "
                         "frame to frame; import frames of one monotonic path, each once");
      return axial && std::abs(snapshots.back().axial_strain) >= std::abs(snapshots.back().shear_strain)
               ? LoadingVariable::axial_strain
             : axial && !shear ? LoadingVariable::axial_strain
                               : LoadingVariable::shear_strain;
    }

    void add_inertial_numbers(const Arrival &arrival, std::vector<HistoryRow> &rows)
    {
      for (std::size_t k = 1; k < rows.size(); ++k)
        {
          const double rate       = (rows[k].progress - rows[k - 1].progress) / (rows[k].time - rows[k - 1].time);
          rows[k].inertial_number = rate * arrival.mean_diameter * std::sqrt(arrival.density / (0.5 * rows[k].stress.trace()));
        }
    }
  } // namespace

  DiscreteResults imported_results(const Arrival &arrival)
  {
    for (const ArrivedFrame &f : arrival.frames)
      if (!std::isfinite(f.wall[int(Side::lower)]) || !std::isfinite(f.wall[int(Side::upper)]))
        throw SceneError(f.grain_file + ": frame " + f.name +
                         ": the places of the lower and the upper wall are in none of the files; give a table with "
                         "frame, lower_y and upper_y (or width and height), or use --walls-touch");
    DiscreteResults results;
    for (const ArrivedFrame &f : arrival.frames)
      {
        Snapshot s;
        add_kinematics(f, arrival.frames.front(), arrival.mean_diameter, s);
        add_contacts(f, s);
        results.snapshots.push_back(std::move(s));
      }
    if (results.snapshots.size() > 1)
      {
        const LoadingVariable loading_variable = loading_variable_of(results.snapshots, arrival);
        for (Snapshot &s : results.snapshots)
          {
            s.loading_variable = loading_variable;
            s.progress         = loading_variable == LoadingVariable::axial_strain ? s.axial_strain : s.shear_strain;
          }
      }
    for (std::size_t k = 0; k < arrival.frames.size(); ++k)
      results.rows.push_back(row_of(arrival, k, results.snapshots[k], results.snapshots.front().area));
    add_inertial_numbers(arrival, results.rows);
    DiscreteFacts  &facts = results.facts;
    const Snapshot &first = results.snapshots.front(), &last = results.snapshots.back();
    facts.preparation_solid_fraction = results.rows.front().solid_fraction;
    facts.initial_height             = first.upper_y - first.lower_y;
    facts.finished                   = true;
    facts.reached_progress           = last.progress;
    facts.reached_axial_strain       = last.axial_strain;
    facts.reached_shear_strain       = last.shear_strain;
    facts.message                    = "imported: " + arrival.format;
    return results;
  }
} // namespace diptych::coupling
