// diptych: state of an unfinished loading in a file, for a later restart
// SPDX-License-Identifier: LGPL-2.1-or-later
#include "discrete/panel/checkpoint.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <type_traits>

#include "discrete/files/hdf5_file.h"

namespace diptych::discrete
{
  namespace
  {
    // The only list of scalars, for reading and writing: visit(name, member). The entries of the report are in its own list.
    template <class Visit> void visit_scalars(Checkpoint &p, Visit &&visit)
    {
      Report &r = p.report;
      visit("scalars/time", p.state.time);
      visit("scalars/stage", p.stage);
      visit("scalars/steps_left", p.steps_left);
      visit("scalars/step", p.step);
      visit("scalars/interval", p.interval);
      visit("scalars/window_time", p.window.time);
      visit("scalars/reference_height", p.reference.height);
      visit("scalars/reference_area", p.reference.area);
      visit("scalars/reference_grain_area", p.reference.grain_area);
      visit("scalars/reference_kinetic_energy", p.reference.kinetic_energy);
      visit("scalars/reference_platen_kinetic_energy", p.reference.platen_kinetic_energy);
      visit("scalars/reference_strain_rate", p.reference.strain_rate);
      visit("scalars/reference_mean_density", p.reference.mean_density);
      visit("scalars/reference_platen_x", p.reference.platen.x());
      visit("scalars/reference_platen_y", p.reference.platen.y());
      visit("scalars/steps", r.steps);
      visit("scalars/sweeps", r.sweeps);
      visit("scalars/updates", r.updates);
      visit("scalars/preparation_cpu_s", r.preparation_cpu_s);
      visit("scalars/preparation_wall_s", r.preparation_wall_s);
      visit("scalars/loading_cpu_s", r.loading_cpu_s);
      visit("scalars/solver_cpu_s", r.solver_cpu_s);
      visit("scalars/preparation_quiet", r.preparation.quiet);
      visit("scalars/preparation_overlap", r.preparation.soft_overlap);
      visit("scalars/expected_dilation_loss", r.expected.dilation_loss);
      visit_facts(r, [&](const std::string &name, auto &value, const char *, const char *) { visit("report/" + name, value); });
    }

    std::vector<double> numbers(HistoryRow row)
    {
      std::vector<double> values;
      visit_columns(row, [&](const char *, const auto &value, const char *, const char *) { values.push_back(double(value)); });
      return values;
    }

    HistoryRow row_of(const double *values)
    {
      HistoryRow row;
      visit_columns(
        row, [&](const char *, auto &value, const char *, const char *) { value = std::decay_t<decltype(value)>(*values++); });
      return row;
    }

    void write_grains(Hdf5Writer &file, const Grains &g)
    {
      file.write("grains/position", g.position);
      file.write("grains/velocity", g.velocity);
      file.write("grains/rotation", g.rotation);
      file.write("grains/spin", g.spin);
      file.write("grains/radius", g.radius);
      file.write("grains/mass", g.mass);
      file.write("grains/fixed", std::vector<int>(g.fixed.begin(), g.fixed.end()));
    }

    Grains read_grains(const Hdf5Reader &file)
    {
      Grains                 g;
      const std::vector<int> fixed = file.read_int("grains/fixed");
      g.position                   = file.read_vectors("grains/position");
      g.velocity                   = file.read_vectors("grains/velocity");
      g.rotation                   = file.read("grains/rotation");
      g.spin                       = file.read("grains/spin");
      g.radius                     = file.read("grains/radius");
      g.mass                       = file.read("grains/mass");
      g.fixed.assign(fixed.begin(), fixed.end());
      return g;
    }

    // One row per wall: point, normal, velocity, mass, kind.
    std::vector<double> wall_numbers(const std::vector<Wall> &walls)
    {
      std::vector<double> values;
      for (const Wall &w : walls)
        values.insert(values.end(), {w.point.x(), w.point.y(), w.normal.x(), w.normal.y(), w.velocity.x(), w.velocity.y(), w.mass,
                                     w.kind == WallKind::platen ? 0. : 1.});
      return values;
    }
    constexpr std::size_t numbers_a_wall = 8;

    std::vector<Wall> walls_of(const Hdf5Reader &file)
    {
      const std::vector<double> v = file.read("walls");
      if (v.size() % numbers_a_wall != 0 || !std::all_of(v.begin(), v.end(), [](const double x) { return std::isfinite(x); }))
        throw std::invalid_argument(file.path() + ": 'walls' does not hold rows of " + std::to_string(numbers_a_wall) +
                                    " finite numbers");
      std::vector<Wall> walls;
      for (std::size_t k = 0; k < v.size(); k += numbers_a_wall)
        {
          Wall wall{{v[k], v[k + 1]}, {v[k + 2], v[k + 3]}, {v[k + 4], v[k + 5]}, {}, {}, v[k + 6], WallKind::platen};
          wall.kind = v[k + 7] == 0 ? WallKind::platen : WallKind::side;
          if (!(std::abs(wall.normal.norm() - 1) < 1e-9 && wall.mass >= 0))
            throw std::invalid_argument(file.path() + ": 'walls' holds a normal that is not of length 1 or a mass below 0");
          walls.push_back(wall);
        }
      return walls;
    }

    std::vector<double> numbers(const PeriodicWidth &periodic)
    {
      return {periodic.width, periodic.velocity, periodic.mass};
    }

    std::vector<double> numbers(const Lattice &lattice)
    {
      std::vector<double> values(lattice.vectors.data(), lattice.vectors.data() + 4);
      values.insert(values.end(), lattice.strain.data(), lattice.strain.data() + 3);
      values.insert(values.end(), lattice.rate.data(), lattice.rate.data() + 3);
      return values;
    }

    Lattice lattice_of(const std::vector<double> &values, const std::string &path)
    {
      const bool finite = std::all_of(values.begin(), values.end(), [](const double x) { return std::isfinite(x); });
      if (values.size() != 10 || !finite || !(values[0] * values[3] - values[1] * values[2] > 0))
        throw std::invalid_argument(path + ": 'lattice' does not hold vectors, strain and rate of a cell");
      return {Eigen::Matrix2d::Map(values.data()),
              Eigen::Vector3d::Map(values.data() + 4),
              Eigen::Vector3d::Map(values.data() + 7),
              {}};
    }

    void write_pairs(Hdf5Writer &file, const Checkpoint &p)
    {
      std::vector<int>    body, window_body;
      std::vector<double> impulse, change, rolling, window_impulse, window_dissipation, window_impact, window_rolling;
      for (const PairImpulse &r : p.state.impulses)
        {
          body.insert(body.end(), {r.i, r.j});
          impulse.insert(impulse.end(), {r.normal, r.tangential});
          change.insert(change.end(), {r.normal_change, r.tangential_change});
          rolling.insert(rolling.end(), {r.rolling, r.rolling_change});
        }
      for (const WindowForces::PairSum &s : p.window.sums)
        {
          window_body.insert(window_body.end(), {s.i, s.j});
          window_dissipation.push_back(s.dissipation);
          window_impact.push_back(s.impact);
          window_rolling.push_back(s.rolling);
          window_impulse.insert(window_impulse.end(), {s.impulse.x(), s.impulse.y()});
        }
      file.write("impulses/body", body);
      file.write("impulses/impulse", impulse);
      file.write("impulses/change", change);
      file.write("impulses/rolling", rolling);
      file.write("window/body", window_body);
      file.write("window/impulse", window_impulse);
      file.write("window/dissipation", window_dissipation);
      file.write("window/impact", window_impact);
      file.write("window/rolling", window_rolling);
      file.write("window/spin", p.window.spin);
    }

    void read_pairs(const Hdf5Reader &file, Checkpoint &p)
    {
      const std::vector<int>    body = file.read_int("impulses/body"), window_body = file.read_int("window/body");
      const std::vector<double> impulse = file.read("impulses/impulse"), change = file.read("impulses/change"),
                                rolling = file.read("impulses/rolling"), window_impulse = file.read("window/impulse"),
                                window_dissipation = file.read("window/dissipation"), window_impact = file.read("window/impact"),
                                window_rolling = file.read("window/rolling");
      const std::size_t n = body.size(), n_window = window_body.size();
      if (n % 2 != 0 || impulse.size() != n || change.size() != n || rolling.size() != n || n_window % 2 != 0 ||
          window_impulse.size() != n_window || window_dissipation.size() != n_window / 2 ||
          window_impact.size() != n_window / 2 || window_rolling.size() != n_window / 2)
        throw std::invalid_argument(file.path() + ": the lengths of the lists in 'impulses' or 'window' do not match");
      for (std::size_t k = 0; k < n; k += 2)
        {
          PairImpulse pair{body[k], body[k + 1], impulse[k], impulse[k + 1]};
          pair.normal_change     = change[k];
          pair.tangential_change = change[k + 1];
          pair.rolling           = rolling[k];
          pair.rolling_change    = rolling[k + 1];
          p.state.impulses.push_back(pair);
        }
      for (std::size_t k = 0; k < n_window; k += 2)
        p.window.sums.push_back({window_body[k],
                                 window_body[k + 1],
                                 window_dissipation[k / 2],
                                 window_impact[k / 2],
                                 {window_impulse[k], window_impulse[k + 1]},
                                 window_rolling[k / 2]});
      p.window.spin = file.read("window/spin");
    }

    template <class Number> Number read_number(const Hdf5Reader &file, const std::string &name)
    {
      constexpr double          most   = 9007199254740992.; // 2^53: whole numbers are exact up to here
      const std::vector<double> number = file.read(name);
      const bool is_whole              = number.size() == 1 && number[0] == std::floor(number[0]) && std::abs(number[0]) <= most;
      if (number.size() != 1 || (std::is_integral_v<Number> && !is_whole))
        throw std::invalid_argument(file.path() + ": '" + name + "' is not a single " +
                                    (std::is_integral_v<Number> ? "whole number" : "number"));
      return Number(number[0]);
    }

    bool are_finite(const Grains &g)
    {
      const auto number = [](const double x) { return std::isfinite(x); };
      const auto vector = [](const Eigen::Vector2d &x) { return x.allFinite(); };
      const auto size   = [](const double x) { return std::isfinite(x) && x > 0; };
      return std::all_of(g.position.begin(), g.position.end(), vector) &&
             std::all_of(g.velocity.begin(), g.velocity.end(), vector) &&
             std::all_of(g.rotation.begin(), g.rotation.end(), number) && std::all_of(g.spin.begin(), g.spin.end(), number) &&
             std::all_of(g.radius.begin(), g.radius.end(), size) && std::all_of(g.mass.begin(), g.mass.end(), size);
    }

    void check_sizes(const std::string &path, const Checkpoint &p, const bool row_is_whole)
    {
      const Grains     &g = p.state.grains;
      const std::size_t n = g.size(), n_bodies = n + p.state.walls.size();
      const auto        both = [&](const auto &pair) {
        return pair.i >= 0 && std::size_t(pair.i) < n && pair.j >= 0 && std::size_t(pair.j) < n_bodies;
      };
      const bool whole = row_is_whole && (p.state.walls.size() >= 2 || p.state.lattice()) && g.position.size() == n &&
                         g.velocity.size() == n && g.rotation.size() == n && g.spin.size() == n && g.mass.size() == n &&
                         g.fixed.size() == n && p.reference.position.size() == n &&
                         (p.window.spin.empty() || p.window.spin.size() == n) &&
                         std::all_of(p.state.impulses.begin(), p.state.impulses.end(), both) &&
                         std::all_of(p.window.sums.begin(), p.window.sums.end(), both);
      if (!whole)
        throw std::invalid_argument(path + " is not a checkpoint of this version: the lengths of its lists do not match");
      if (!are_finite(g))
        throw std::invalid_argument(path +
                                    ": 'grains' contains a number that is not finite, or a radius or mass that is not positive");
    }

    void check_scalars(const std::string &path, const StoredCheckpoint &checkpoint)
    {
      const Checkpoint &p      = checkpoint.panel;
      const auto        demand = [&](const bool holds, const char *what) {
        if (!holds)
          throw std::invalid_argument(path + ": " + what);
      };
      const std::vector<Wall> &walls = p.state.walls;
      demand(checkpoint.n_rows >= 0 && p.stage >= 0, "'n_rows' or 'scalars/stage' is negative");
      demand(std::isfinite(p.step) && (p.step > 0 || (p.step == 0 && p.steps_left == 0)), "'scalars/step' is not above 0");
      demand(p.state.time >= 0 && std::isfinite(p.state.time), "'scalars/time' is negative or not finite");
      demand(p.steps_left >= 0 && p.report.steps >= 0, "'scalars/steps_left' or 'scalars/steps' is negative");
      demand(p.interval > 0, "'scalars/interval' is not above 0");
      demand(p.reference.height > 0 && p.reference.area > 0, "'scalars/reference_height' or 'reference_area' is not above 0");
      demand(walls.empty() || walls[1].point.y() > walls[0].point.y(), "'walls' has the upper platen below the lower one");
    }
  } // namespace

  void write_checkpoint(const std::string &path, const StoredCheckpoint &checkpoint)
  {
    Checkpoint p = checkpoint.panel;
    Hdf5Writer file(path);
    write_grains(file, p.state.grains);
    file.write("walls", wall_numbers(p.state.walls));
    file.write("lattice", p.state.lattice() ? numbers(*p.state.lattice()) : std::vector<double>{});
    file.write("cell", p.state.width() ? numbers(*p.state.width()) : std::vector<double>{});
    write_pairs(file, p);
    file.write("reference/position", p.reference.position);
    file.write("row", numbers(p.row));
    file.write("n_rows", std::vector<double>{double(checkpoint.n_rows)});
    visit_scalars(p, [&](const std::string &name, const auto &value) {
      if constexpr (std::is_same_v<std::decay_t<decltype(value)>, std::string>)
        file.write_string(name, value);
      else
        file.write(name, std::vector<double>{double(value)});
    });
    file.write_string("scene", checkpoint.scene);
    file.finish();
  }

  StoredCheckpoint read_checkpoint(const std::string &path)
  try
    {
      const Hdf5Reader file(path, Hdf5Reader::From::this_program);
      StoredCheckpoint checkpoint;
      Checkpoint      &p = checkpoint.panel;
      p.state.grains     = read_grains(file);
      p.state.walls      = walls_of(file);
      if (const std::vector<double> cell = file.read("cell"); cell.size() == 3 && cell[0] > 0)
        p.state.periodicity = PeriodicWidth{cell[0], cell[1], {}, cell[2]};
      else if (!cell.empty())
        throw std::invalid_argument(path + ": 'cell' does not hold width, velocity and mass");
      if (const std::vector<double> lattice = file.read("lattice"); !lattice.empty())
        p.state.periodicity = lattice_of(lattice, path);
      read_pairs(file, p);
      p.reference.position            = file.read_vectors("reference/position");
      const std::vector<double> row   = file.read("row");
      const std::size_t         width = numbers(HistoryRow()).size();
      check_sizes(path, p, row.size() == width);
      p.row             = row_of(row.data());
      checkpoint.n_rows = read_number<long>(file, "n_rows");
      visit_scalars(p, [&](const std::string &name, auto &value) {
        using Value = std::decay_t<decltype(value)>;
        if constexpr (std::is_same_v<Value, std::string>)
          value = file.read_string(name);
        else
          value = read_number<Value>(file, name);
      });
      check_scalars(path, checkpoint);
      checkpoint.scene = file.read_string("scene");
      return checkpoint;
    }
  catch (const std::out_of_range &)
    {
      throw std::invalid_argument(path + " is not a checkpoint of this version: an array is too short");
    }
} // namespace diptych::discrete
