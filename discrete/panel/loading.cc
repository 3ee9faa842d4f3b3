// diptych: loading of a prepared sample
// SPDX-License-Identifier: LGPL-2.1-or-later
#include "discrete/panel/loading.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "discrete/contacts/lattice_motion.h"
#include "discrete/files/out_of_memory.h"
#include "discrete/files/wrong_keys.h"
#include "discrete/samples/placed_grains.h"
#include "discrete/samples/sample_file.h"
#include "discrete/samples/sample_preparation.h"
#include "discrete/samples/settling.h"

namespace diptych::discrete
{
  namespace
  {
    std::optional<double> number_of(const std::string &text)
    {
      char        *end    = nullptr;
      const double number = std::strtod(text.c_str(), &end);
      return end != text.c_str() && *end == '\0' && std::isfinite(number) ? std::optional<double>(number) : std::nullopt;
    }

    // The number, or the table in the CSV file of that name.
    TimeTable table_of(const std::string &key, const std::string &text, const std::string &column)
    {
      if (const std::optional<double> number = number_of(text))
        return {{0.}, {*number}};
      try
        {
          return read_time_table(text, column);
        }
      catch (const std::exception &error)
        {
          throw_wrong_input(key, text, error);
        }
    }

    Eigen::Vector2d platen_velocity(const Loading &loading, const double speed)
    {
      switch (loading.mode)
        {
        case LoadingMode::descent:
          return {loading.horizontal_over_vertical * speed, -speed};
        case LoadingMode::shear:
        case LoadingMode::plane_shear:
          return {speed, 0};
        case LoadingMode::time:
        case LoadingMode::path:
          break;
        }
      return {0, 0};
    }

    // Largest change of a control between two rows, as a strain.
    double strain_between(const CellPath &path, const std::size_t row, const double pressure)
    {
      constexpr double of_pressure = 0.01; // strain of a stress that changes by the pressure
      double           largest     = 0;
      for (int k = 0; k < 3; ++k)
        {
          const double change = std::abs(path.values[row][k] - path.values[row - 1][k]);
          largest = std::max(largest, change / (path.is_stress[k] ? pressure / of_pressure : path.form.row(k).maxCoeff()));
        }
      return largest;
    }

    void set_lateral_drives(State &state, const LoadingStart &start)
    {
      const LateralCondition lateral = lateral_condition(start.lateral);
      const double           mass    = start.lateral.wall_mass > 0 ? start.lateral.wall_mass : default_wall_mass(state.grains);
      for (Wall &wall : state.walls)
        wall.mass = mass;
      if (const auto *sides = std::get_if<RigidSides>(&lateral))
        {
          if (sides->velocity)
            state.walls[3].velocity.x() = *sides->velocity;
          else
            state.walls[3].drive_x = AppliedPressure{start.loading.pressure};
        }
      else if (const auto *periodic = std::get_if<PeriodicSides>(&lateral))
        {
          PeriodicWidth &width = *state.width();
          width.mass           = mass;
          if (periodic->free_width)
            width.pressure = start.loading.pressure;
          else
            width.velocity = periodic->velocity;
        }
    }

    void set_wall_drives(State &state, const WallDriveOptions &o)
    {
      for_each_drive(o, [&](const std::size_t w, const int axis, const std::string &name, const DriveOption &option) {
        if (option.is_auto())
          return;
        const std::string key = "discrete/" + name;
        if (w >= state.walls.size())
          throw std::invalid_argument(key + " = '" + text_of(option) + "': there is no such wall unless lateral = rigid_walls");
        (axis == 0 ? state.walls[w].drive_x : state.walls[w].drive_y) = read_drive(key, option);
      });
    }

    LatticeDrive lattice_drive(const State &state, const LoadingStart &start)
    {
      const CellPath &path = start.loading.path;
      return {path.form,
              path.is_stress,
              {times_of(path, start.loading.pressure, start.rate), path.values},
              lattice_inertia(state.grains)};
    }

    // Prescribed strains start at their rate; the others as if the grains were elastic.
    void start_lattice(State &state, const LoadingStart &start)
    {
      Lattice &lattice = *state.lattice();
      state.time       = 0;
      stop(state);
      std::fill(state.grains.rotation.begin(), state.grains.rotation.end(), 0.);
      set_drives(state, start);
      if (start.loading.affine_start)
        lattice.rate = start_rate(lattice.drive);
    }
  } // namespace

  bool has_no_pressure(const Loading &loading)
  {
    const CellPath &path = loading.path;
    for (int k = 0; k < 3; ++k)
      if (path.is_stress[k] && !path.form.row(k).head<2>().isZero(0))
        return false;
    return loading.mode == LoadingMode::path;
  }

  void validate(const CellPath &path)
  {
    if (path.values.size() < 2 || path.progress.size() != path.values.size())
      throw WrongKeys({"loading/path"}, "loading/path: the path of a cell needs at least two rows, each with its progress");
    for (std::size_t row = 1; row < path.values.size(); ++row)
      if (!(path.progress[row] > path.progress[row - 1]) || !(strain_between(path, row, 1) > 0))
        throw WrongKeys({"loading/path"},
                        "loading/path: row " + std::to_string(row + 1) +
                          " of the numbers repeats the row before it. Grains take no holds, because they do not "
                          "creep; leave it out (`diptych material-point` lets a law relax there)");
  }

  std::vector<double> times_of(const CellPath &path, const double pressure, const double strain_rate)
  {
    std::vector<double> times(path.values.size(), 0.);
    for (std::size_t row = 1; row < times.size(); ++row)
      times[row] = times[row - 1] + strain_between(path, row, pressure) / strain_rate;
    return times;
  }

  DriveOption::DriveOption(const std::string &text)
  {
    const std::size_t blank = text.find(' '), begin = text.find_first_not_of(' ', blank);
    const std::string word = text.substr(0, blank);
    value                  = begin == std::string::npos ? "" : text.substr(begin);
    if (word == "auto" && value.empty())
      return;
    if ((word != "velocity" && word != "force") || value.empty())
      throw std::invalid_argument("'" + text +
                                  "' is not allowed: give auto, velocity V or force F, where V and F are a number or a CSV file");
    kind = word == "velocity" ? Kind::velocity : Kind::force;
  }

  bool DriveOption::names_a_file() const
  {
    return !is_auto() && !number_of(value);
  }

  std::string text_of(const DriveOption &option)
  {
    if (option.is_auto())
      return "auto";
    return (option.kind == DriveOption::Kind::velocity ? "velocity " : "force ") + option.value;
  }

  Drive read_drive(const std::string &key, const DriveOption &option)
  {
    switch (option.kind)
      {
      case DriveOption::Kind::velocity:
        return PrescribedVelocity{table_of(key, option.value, "velocity")};
      case DriveOption::Kind::force:
        return AppliedForce{table_of(key, option.value, "force")};
      case DriveOption::Kind::automatic:
        break;
      }
    return KeptVelocity{};
  }

  void validate(const WallDriveOptions &options)
  {
    for_each_drive(
      options, [](int, int, const std::string &key, const DriveOption &option) { (void)read_drive("discrete/" + key, option); });
  }

  double strain_rate(const Loading &loading, const double mean_diameter, const double density)
  {
    if (loading.mode == LoadingMode::time)
      return 1;
    if (loading.strain_rate > 0)
      return loading.strain_rate;
    return loading.inertial_number / mean_diameter * std::sqrt(loading.pressure / density);
  }

  void set_drives(State &state, const LoadingStart &start)
  {
    if (Lattice *lattice = state.lattice())
      {
        lattice->drive = lattice_drive(state, start);
        return;
      }
    for (Wall &wall : state.walls)
      wall.drive_x = wall.drive_y = KeptVelocity{};
    if (PeriodicWidth *width = state.width())
      width->pressure.reset();
    set_lateral_drives(state, start);
    if (start.loading.mode == LoadingMode::plane_shear)
      state.walls[1].drive_y = AppliedPressure{start.loading.normal_pressure};
    set_wall_drives(state, start.drives);
    validate_walls(state);
  }

  void start_loading(State &state, const LoadingStart &start)
  {
    if (start.loading.mode == LoadingMode::path)
      return start_lattice(state, start);
    const Loading        &loading = start.loading;
    const double          bottom = state.walls[0].point.y(), height = sample_height(state);
    const Eigen::Vector2d velocity = platen_velocity(loading, start.rate * height);
    Grains               &g        = state.grains;
    state.time                     = 0;
    for (std::size_t i = 0; i < g.size(); ++i)
      {
        g.rotation[i] = 0;
        if (loading.mode == LoadingMode::time || g.fixed[i])
          continue; // velocities stay as read or prepared
        g.velocity[i] = loading.affine_start ? Eigen::Vector2d(velocity * (g.position[i].y() - bottom) / height)
                                             : Eigen::Vector2d::Zero();
        g.spin[i]     = loading.affine_start ? -0.5 * velocity.x() / height : 0.; // spin of the affine field
      }
    for (Wall &wall : state.walls)
      wall.velocity.setZero();
    state.walls[1].velocity = velocity;
    std::visit([](auto &kind) { kind.stop(); }, state.periodicity);
    set_drives(state, start);
    for (Wall &wall : state.walls)
      wall.velocity = prescribed_wall_velocity(wall, 0.);
    carry_platen_grains(state);
  }

  double loading_progress(const State           &state,
                          const Loading         &loading,
                          const Eigen::Vector2d &initial_platen,
                          const double           initial_height)
  {
    if (loading.mode == LoadingMode::time)
      return state.time;
    if (loading.mode == LoadingMode::path)
      return TimeTable{state.lattice()->drive.values.time, loading.path.progress}.at(state.time);
    const Eigen::Vector2d travel = state.walls[1].point - initial_platen;
    return (loading.mode == LoadingMode::descent ? -travel.y() : travel.x()) / initial_height;
  }

  double duration_between(const State &state, const Loading &loading, const double rate, const double from, const double to)
  {
    if (loading.mode != LoadingMode::path)
      return (to - from) / rate;
    const TimeTable times{loading.path.progress, state.lattice()->drive.values.time};
    return times.at(to) - times.at(from);
  }
} // namespace diptych::discrete
